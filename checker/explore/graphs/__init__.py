"""State graphs: reachable valuations with every tick between them, seen through a few variables."""
