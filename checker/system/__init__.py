"""Transition systems, and what makes others of them: slices, cells of inputs, the way to formulas."""
