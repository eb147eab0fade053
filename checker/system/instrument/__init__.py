"""Charts with flags for the transitions, pairs and conditions that a tick reaches; they behave as before."""
