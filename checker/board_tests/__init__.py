"""Tests of boards as files that others run: one writer for each language, whoever made the tests."""
