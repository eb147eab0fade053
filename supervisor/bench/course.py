"""What a condition of a scenario is at each time: constant, set, or running evenly to another value."""

from bisect import bisect_right
from dataclasses import dataclass

Setting = bool | float | str
"""A value that a scenario can give a condition."""


@dataclass(frozen=True)
class Piece:
    """From ``start_us`` on: evenly from ``first`` to ``last`` until ``end_us``, then ``last``."""

    start_us: int
    last: Setting
    first: Setting | None = None
    end_us: int = 0

    def at(self, time_us: int) -> Setting:
        """The value at a time not before the start."""
        first, last = self.first, self.last
        if time_us >= self.end_us or isinstance(first, str) or isinstance(last, str) or first is None:
            return last
        part = (time_us - self.start_us) / (self.end_us - self.start_us)
        return first + (last - first) * part


@dataclass(frozen=True)
class Course:
    """Pieces in the order of their start, the first one at 0."""

    pieces: tuple[Piece, ...]

    def at(self, time_us: int) -> Setting:
        """The value at a time of the run."""
        if len(self.pieces) == 1:
            return self.pieces[0].last
        return self.pieces[bisect_right(self.pieces, time_us, key=_start) - 1].at(time_us)

    @property
    def changes(self) -> tuple[int, ...]:
        """The times at which it is set anew."""
        return tuple(piece.start_us for piece in self.pieces[1:])


def _start(piece: Piece) -> int:
    return piece.start_us
