"""Both boards together: the link between them, the relay and the motor driver, and what may fail."""
