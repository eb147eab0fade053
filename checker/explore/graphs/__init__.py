"""State graphs: reachable states with every tick between them, seen through a few variables."""
