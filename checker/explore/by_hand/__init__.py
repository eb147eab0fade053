"""Step by step through a system: the simulator behind ``rovercheck explore``, which prints nothing itself."""
