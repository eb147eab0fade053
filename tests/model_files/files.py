"""Models written for tests: the one that ``init`` writes, and variations of it."""

from pathlib import Path

from rovercheck.checker import model

START = Path(str(model.__file__)).parent / "start"
HEATER = (START / "heater.py").read_text(encoding="utf-8")
BASELINE = (START / "baseline.toml").read_text(encoding="utf-8")


def but(old: str, new: str) -> str:
    """The heater with another text in one place."""
    assert HEATER.count(old) >= 1, old
    return HEATER.replace(old, new, 1)


def line_of(words: str, text: str) -> int:
    """The line of a text, from 1, in which words stand first."""
    return next(n for n, line in enumerate(text.splitlines(), 1) if words in line)
