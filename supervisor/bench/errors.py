"""The one error of a scenario: where it is written, what is wrong, what to write."""

from collections.abc import Iterable
from datetime import date, time
from difflib import get_close_matches

LONGEST = 60
"""Letters of what is quoted from a scenario."""
SHOWN = 12
"""Names that are listed at most."""


class ScenarioError(Exception):
    """A scenario that has no meaning as written; the message begins with the path of the key."""

    def __init__(self, path: str, problem: str) -> None:
        message = f"{path}: {problem}" if path else problem
        super().__init__("".join(letter if letter.isprintable() else "?" for letter in message))


def quoted(written: object) -> str:
    """What is written, as a TOML file has it, but not all of it if it is long."""
    if isinstance(written, bool):
        return str(written).lower()
    try:
        text = str(written) if isinstance(written, date | time) else repr(written)
    except ValueError:  # Python writes no number of more than 4300 digits
        return "a number of thousands of digits"
    return text if len(text) <= LONGEST else f"{text[:LONGEST]}..."


def nearest(name: str, known: Iterable[str]) -> str:
    """A sentence that offers the names nearest to ``name``, or all of them when none is near."""
    names = list(known)
    near = get_close_matches(name, names, n=3, cutoff=0.6)
    if near:
        return f"Did you mean {' or '.join(map(repr, near))}?"
    return f"Known: {', '.join(names[:SHOWN])}{', ...' if len(names) > SHOWN else ''}."
