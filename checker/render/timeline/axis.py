"""Where ticks are across the picture: to scale, or with quiet stretches and repeated periods shortened."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from rovercheck.checker.render.drawing.text import width
from rovercheck.checker.render.periods import RepeatedTicks
from rovercheck.checker.render.timeline.model import Timeline

WIDTH = 960
"""Pixels of the lanes, unless there are too many ticks."""
WIDEST, NARROWEST = 240.0, 3.0
"""Pixels of a tick."""
TO_SCALE = 6.0
"""Pixels that a tick has at least in a picture to scale."""
SHORTENED, FOLDED = 60.0, 90.0
"""Pixels of a shortened stretch, and of ticks that repeat those before them."""
SMALL = 10


@dataclass(frozen=True)
class Axis:
    """``edges`` has the left edge of every tick and the right edge of the last.

    ``breaks`` are shortened, and ``folds`` are ticks of which it is only said what they repeat.
    """

    edges: tuple[float, ...]
    breaks: tuple[tuple[int, int], ...]
    folds: tuple[RepeatedTicks, ...] = ()

    @property
    def width(self) -> float:
        return self.edges[-1]

    def left(self, tick: int) -> float:
        return self.edges[tick - 1]

    def right(self, tick: int) -> float:
        return self.edges[tick]

    def middle(self, tick: int) -> float:
        return _short((self.left(tick) + self.right(tick)) / 2)


def fit(timeline: Timeline, wide: int = WIDTH) -> Axis:
    """Ticks to scale where they have room; else what is longer than a mark for it is shortened.

    That are quiet stretches, and repeated periods.
    """
    count = max(timeline.ticks, 1)
    tick = min(WIDEST, wide / count)
    marks: Marks = {}
    if tick < TO_SCALE:
        marks, tick = _shortened(timeline, wide)
    inside = {
        k: room / (last - first + 1) for (first, last), room in marks.items() for k in range(first, last + 1)
    }
    edges = [0.0]
    for k in range(1, count + 1):
        edges.append(edges[-1] + inside.get(k, tick))
    folds = tuple(row for row in timeline.repeated if (row.first, row.last) in marks)
    whole = {(row.first, row.last) for row in folds}
    return Axis(tuple(map(_short, edges)), tuple(sorted(marks.keys() - whole)), folds)


Marks = dict[tuple[int, int], float]
"""Stretches that are shortened, with the pixels of each."""


def _short(x: float) -> float:
    """To a hundredth of a pixel, and without a fraction that is none."""
    rounded = round(x, 2)
    return int(rounded) if rounded == int(rounded) else rounded


def _shortened(timeline: Timeline, wide: int) -> tuple[Marks, float]:
    """The stretches to shorten, and the width of the other ticks."""
    marks = dict.fromkeys(without_loop_start(timeline), SHORTENED)
    marks |= {(row.first, row.last): FOLDED for row in timeline.repeated}
    while True:
        rest = timeline.ticks - shortened(marks)
        tick = max(NARROWEST, min(WIDEST / 2, (wide - sum(marks.values())) / max(rest, 1)))
        worth = {b: room for b, room in marks.items() if (b[1] - b[0] + 1) * tick > room}
        if worth == marks:
            return marks, tick
        marks = worth


def without_loop_start(timeline: Timeline) -> Iterator[tuple[int, int]]:
    """Quiet stretches of two ticks or more, cut where the part that repeats starts."""
    for first, last in timeline.quiet:
        start = timeline.loop
        pieces = [(first, start), (start + 1, last)] if start and first <= start < last else [(first, last)]
        yield from (piece for piece in pieces if piece[1] > piece[0])


def labelled(timeline: Timeline, axis: Axis) -> list[int]:
    """Ticks whose number and time are written: the ends, those beside a break, and others with room."""
    spans = [*axis.breaks, *((row.first, row.last) for row in axis.folds)]
    wanted = [1, timeline.ticks, *(t for first, last in spans for t in (last + 1, first - 1))]
    if timeline.loop:
        wanted.insert(2, timeline.loop + 1)
    for step in (1000, 500, 200, 100, 50, 20, 10, 5, 2, 1):
        wanted += range(step, timeline.ticks + 1, step)
    taken: list[tuple[float, float]] = [_middle(axis, first, last) for first, last in spans]
    found: set[int] = set()
    for tick in dict.fromkeys(t for t in wanted if 1 <= t <= timeline.ticks):
        half = width(f"{timeline.ms(tick)}", SMALL) / 2 + 3
        left, right = axis.middle(tick) - half, axis.middle(tick) + half
        if not any(first <= tick <= last for first, last in spans) and all(
            right <= a or left >= b for a, b in taken
        ):
            taken.append((left, right))
            found.add(tick)
    return sorted(found)


def _middle(axis: Axis, first: int, last: int) -> tuple[float, float]:
    return axis.left(first), axis.right(last)


def shortened(breaks: Iterable[tuple[int, int]]) -> int:
    """How many ticks are in shortened stretches."""
    return sum(last - first + 1 for first, last in breaks)
