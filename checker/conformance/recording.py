"""Rows of a recorded run, whoever recorded it: a log, or an implementation beside the charts."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction

Raw = int | Fraction
"""A raw value, as in the charts; a fraction lies between two values of a domain."""

Cells = list[Raw | None]
"""The values of one signal, row by row; ``None`` where it was not recorded."""


@dataclass(frozen=True)
class LogBlock:
    """Successive rows: the line and the step of each, from 1, and its values by signal.

    ``missing[i]`` steps lie between row i and the one before it.  ``meaningless``: by output, the rows in
    which it was given but is no value, with its text; its cell there is ``None``.
    """

    lines: Sequence[int]
    ticks: Sequence[int]
    missing: Sequence[int]
    values: Mapping[str, Cells]
    meaningless: Mapping[str, Mapping[int, str]] = field(default_factory=dict)

    def __len__(self) -> int:
        return len(self.lines)


@dataclass(frozen=True)
class Recording:
    """A recorded run of a board, whoever recorded it.

    ``signals``: what it holds, inputs and outputs, by name.  ``blocks`` gives its rows from the first, each
    time that it is called.  ``tolerance``: how far an output may lie from what is required.
    """

    name: str
    signals: frozenset[str]
    from_power_up: bool
    blocks: Callable[[], Iterable[LogBlock]]
    tolerance: Mapping[str, float] = field(default_factory=dict)
