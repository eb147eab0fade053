"""Charts with flags for the transitions, boundaries and pairs that a tick reaches; they behave as before."""
