"""What the pytest plugin loads when a model is to be checked."""
