"""Scenarios that tell the interpretations apart."""
