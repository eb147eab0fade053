"""Cells without meaning: each is a finding of its own, its value unknown, the rest of the log judged."""

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, replace

from rovercheck.checker.io.printable import one_line
from rovercheck.checker.logs.errors import shortened

MOST_VALUES = 20
"""Different values of a column that are told each on its own; cells with others are only counted."""


@dataclass(frozen=True)
class InvalidCell:
    """A text in a column that stands for no value of its signal, and why.

    ``line`` and ``tick`` are where it was first met; the tick is ``None`` in a row that belongs to no step,
    because its time is what has no meaning.  ``count`` are the rows that hold it, ``last_line`` the last.
    """

    column: str
    signal: str
    text: str
    because: str
    line: int
    tick: int | None = None
    count: int = 1
    last_line: int = 0

    @property
    def name(self) -> str:
        """The column, with its signal if that is called otherwise."""
        shown = shortened(one_line(self.column))
        return shown if self.column == self.signal else f"{shown} ({self.signal})"


class Invalid:
    """The cells of one log that have no meaning, those with the same text of a column together."""

    def __init__(self) -> None:
        self._found: dict[tuple[str, str], InvalidCell] = {}
        self._distinct: Counter[str] = Counter()
        self._others: Counter[str] = Counter()

    def __bool__(self) -> bool:
        return bool(self._found)

    def add(self, cell: InvalidCell) -> None:
        """One more; they come in the order of the lines."""
        key = cell.column, cell.text
        before = self._found.get(key)
        if before is not None:
            self._found[key] = replace(before, count=before.count + 1, last_line=cell.line)
        elif self._distinct[cell.column] < MOST_VALUES:
            self._distinct[cell.column] += 1
            self._found[key] = replace(cell, last_line=cell.line)
        else:
            self._others[cell.column] += 1

    @property
    def cells(self) -> tuple[InvalidCell, ...]:
        """Those that are told, in the order in which they were met."""
        return tuple(sorted(self._found.values(), key=lambda c: c.line))

    @property
    def others(self) -> Mapping[str, int]:
        """How many cells of a column hold further values, of columns with more than ``MOST_VALUES``."""
        return dict(self._others)

    @property
    def count(self) -> int:
        """All of them."""
        return sum(c.count for c in self._found.values()) + self._others.total()
