"""Scenarios that tell the readings apart."""
