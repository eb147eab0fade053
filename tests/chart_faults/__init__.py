"""Faults put into charts by hand; each must be caught by a property of the catalogue."""
