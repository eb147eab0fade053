"""What the rover does: signals, charts, environments and the named systems that are checked."""
