"""Charts with flags for the arrows, boundaries and pairs that a tick reaches; they behave as before."""
