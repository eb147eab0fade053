"""The verbs of the command line: what may be written after ``rovercheck``, found by being in this folder."""
