"""Verdicts that are kept: what was decided before of the same question is not decided again."""
