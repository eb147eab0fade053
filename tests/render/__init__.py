"""Tests of the formats: a zoo of things to show, one inherited suite per kind, and geometry."""
