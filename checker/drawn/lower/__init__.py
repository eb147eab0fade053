"""Lowering of what is drawn: from charts and blocks to the transition system that engines decide."""
