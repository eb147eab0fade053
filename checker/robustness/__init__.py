"""Gives an implementation what no model admits, and sees whether what must hold still holds."""
