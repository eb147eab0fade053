"""Board 2: the sensors, the joystick, the decision about obstacles, and the motors when Board 1 cannot."""
