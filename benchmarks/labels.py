"""Where the names of lines go: beside their ends, never over each other, over a line only if need be."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import dist, inf

from rovercheck.checker.render.drawing.text import width

SIZE, HEIGHT = 12, 14
"""Pixels of the letters, and of the box around them."""
GAP = 8
"""From the end of a line to the name beside it."""
SLACK = 13
"""A name farther away gets a leader, a thin line from the end to it."""
STEP = 2
"""Pixels between the heights that are tried."""
ELSEWHERE = 20
"""How many pixels farther away a name goes rather than anywhere but to the right of its end."""
CROSSING = 40
"""How many pixels farther away a name goes rather than over a line or a leader."""

Point = tuple[float, float]
Segment = tuple[Point, Point]


@dataclass(frozen=True, order=True)
class Box:
    """A rectangle; y grows downwards."""

    left: float
    top: float
    right: float
    bottom: float

    def overlaps(self, other: "Box") -> bool:
        """Whether they share more than an edge."""
        across = self.left < other.right and other.left < self.right
        return across and self.top < other.bottom and other.top < self.bottom

    def contains(self, other: "Box") -> bool:
        """Whether no part of the other is outside."""
        across = self.left <= other.left and other.right <= self.right
        return across and self.top <= other.top and other.bottom <= self.bottom

    def meets(self, start: Point, end: Point) -> bool:
        """Whether a segment passes through the inside (Liang and Barsky, ACM ToG 1984)."""
        low, high = 0.0, 1.0
        for a, b, least, most in zip(
            start, end, (self.left, self.top), (self.right, self.bottom), strict=True
        ):
            if a == b:
                if not least < a < most:
                    return False
                continue
            enters, leaves = sorted(((least - a) / (b - a), (most - a) / (b - a)))
            low, high = max(low, enters), min(high, leaves)
        return low < high

    def nearest(self, to: Point) -> Point:
        """The point of the rectangle that is nearest to another."""
        return min(max(to[0], self.left), self.right), min(max(to[1], self.top), self.bottom)


@dataclass(frozen=True)
class Label:
    """The name of a line in its place, and the way to it from the end of the line."""

    name: str
    box: Box
    way: Segment

    @property
    def leader(self) -> Segment | None:
        """The way, if it is so long that it is drawn."""
        return self.way if dist(*self.way) > SLACK else None


def room(names: Sequence[str]) -> tuple[int, int]:
    """Pixels to leave beside the last points, and from top to bottom, so that every name finds a place.

    A name in its place keeps another from fewer heights than twice its own and a step.
    """
    return GAP + max(map(_width, names), default=0), (2 * HEIGHT + STEP) * len(names)


def labels(lines: Mapping[str, Sequence[Point]], area: Box) -> list[Label]:
    """A place inside ``area`` for the name of each line, which ends in its last point.

    Those that end farthest to the right choose first.  Raises ``ValueError`` where ``room`` was not left.
    """
    paths = [segment for points in lines.values() for segment in pairwise(points)]
    placed: list[Label] = []
    for name in sorted(lines, key=lambda n: (-lines[n][-1][0], lines[n][-1][1])):
        placed.append(_placed(name, lines[name][-1], area, paths, placed))
    return placed


def _placed(name: str, end: Point, area: Box, paths: Sequence[Segment], placed: Sequence[Label]) -> Label:
    """The cheapest place: near, on a free spot, and not across what is already there."""
    drawn = [*paths, *(label.way for label in placed)]
    best, least = None, inf
    for cost, box in sorted(_places(name, end, area)):
        if cost >= least:
            break
        if any(box.overlaps(label.box) for label in placed):
            continue
        way = end, box.nearest(end)
        crossed = sum(box.meets(*segment) or _cross(way, segment) for segment in drawn)
        crossed += sum(label.box.meets(*way) for label in placed)
        if cost + CROSSING * crossed < least:
            best, least = Label(name, box, way), cost + CROSSING * crossed
    if best is None:
        raise ValueError(f"no place is left for {name!r}; draw a plot at least as large as room() says.")
    return best


def _cross(one: Segment, other: Segment) -> bool:
    """Whether each has its ends on both sides of the other."""

    def side(segment: Segment, at: Point) -> float:
        (x, y), (to_x, to_y) = segment
        return (to_x - x) * (at[1] - y) - (to_y - y) * (at[0] - x)

    return side(one, other[0]) * side(one, other[1]) < 0 and side(other, one[0]) * side(other, one[1]) < 0


def _places(name: str, end: Point, area: Box) -> Iterator[tuple[float, Box]]:
    """Right of the end, above or below it, and left of it, at all heights, with what each costs in pixels."""
    x, y = end
    wide = _width(name)
    first = y - HEIGHT / 2
    for left, dearer in ((x + GAP, 0), (x - wide / 2, ELSEWHERE), (x - GAP - wide, ELSEWHERE)):
        for k in range(int((area.top - first) // STEP), int((area.bottom - first) // STEP) + 1):
            top = first + STEP * k
            box = Box(left, top, left + wide, top + HEIGHT)
            if area.contains(box) and (distance := dist(end, box.nearest(end))) >= GAP:
                yield distance + abs(STEP * k) / 4 + dearer, box


def _width(name: str) -> int:
    return width(name, SIZE)
