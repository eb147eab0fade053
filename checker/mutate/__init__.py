"""Mutants: first-order faults of charts, blocks and wiring, and what notices them."""
