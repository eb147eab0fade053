"""Fourth step of a layered layout: the tracks of upright line pieces between two ranks."""

from collections.abc import Sequence
from dataclasses import dataclass

TRACK = 10
"""Distance between two tracks, in pixels."""

MARGIN = 16
"""Room for an arrow head, or for a number at the start of an arrow, in pixels."""


@dataclass(frozen=True)
class Jog:
    """A line that enters a channel on the left at height ``start`` and leaves on the right at ``end``."""

    edge: str
    start: int
    end: int

    def spans(self, y: int, slack: int = 0) -> bool:
        return min(self.start, self.end) - slack <= y <= max(self.start, self.end) + slack

    def meets(self, other: "Jog") -> bool:
        """Whether the upright pieces would touch on one track."""
        low, high = sorted((self.start, self.end))
        other_low, other_high = sorted((other.start, other.end))
        return low <= other_high + 6 and other_low <= high + 6


def tracks(jogs: Sequence[Jog]) -> dict[str, int]:
    """A track number from 0 for each line that is not straight; lines of one source may share one."""
    bent = _ordered([j for j in jogs if j.start != j.end])
    found: dict[str, int] = {}
    for i, jog in enumerate(bent):
        before = [found[other.edge] for other in bent[:i] if other.meets(jog)]
        found[jog.edge] = max(before, default=-1) + 1
    return found


def _cost(left: Jog, right: Jog) -> int:
    """Crossings, and a thousand for lines on top of each other, when ``left`` has the lower track."""
    cost = int(right.spans(left.end)) + int(left.spans(right.start))
    return cost + 1000 * (abs(left.end - right.start) < 5)


def _ordered(jogs: list[Jog]) -> list[Jog]:
    """An order of least cost under exchanges of neighbours and moves of one line to any place."""
    order: list[Jog] = []
    for jog in jogs:
        order.insert(_seat(jog, order), jog)
    for _ in range(3):
        for jog in list(order):
            order.remove(jog)
            order.insert(_seat(jog, order), jog)
    return order


def _seat(jog: Jog, order: Sequence[Jog]) -> int:
    cost = sum(_cost(jog, other) for other in order)
    best, seat = cost, 0
    for i, other in enumerate(order):
        cost += _cost(other, jog) - _cost(jog, other)
        if cost < best:
            best, seat = cost, i + 1
    return seat


def channel(used: dict[str, int], least: int = 2 * MARGIN) -> int:
    """The width of a channel with these tracks, in pixels."""
    count = max(used.values(), default=-1) + 1
    return max(least, 2 * MARGIN + TRACK * (count - 1))
