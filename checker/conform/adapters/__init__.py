"""Adapters: one file for each kind of implementation under test, found by being in this folder."""
