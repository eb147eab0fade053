"""Errors of the chart language: what was written, why it has no meaning, what to write."""

from collections.abc import Iterable
from difflib import SequenceMatcher, get_close_matches


class ModelError(Exception):
    """A chart, system or property that has no meaning as written."""


def did_you_mean(name: str, options: Iterable[str]) -> str:
    """A sentence offering the nearest names, or listing what exists when none is near."""
    known = sorted(set(options))
    near = get_close_matches(name, known, n=3, cutoff=0.5)
    if near:
        best = [n for n in near if _likeness(name, n) > _likeness(name, near[0]) - 0.15]
        return "Did you mean " + " or ".join(repr(n) for n in best) + "?"
    if not known:
        return "There is none to choose from."
    shown = ", ".join(known[:12])
    return f"Known: {shown}{', ...' if len(known) > 12 else ''}."


def _likeness(one: str, other: str) -> float:
    return SequenceMatcher(None, other, one).ratio()
