"""Where the elements of a chart are drawn: states in rows, regions below each other, transitions between."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field

from rovercheck.checker.simulink.writer.charts import (
    WrittenChart,
    WrittenElement,
    WrittenJunction,
    WrittenState,
    WrittenTransition,
)

Point = tuple[float, float]
Frame = tuple[float, float, float, float]
"""Left, top, width and height."""
ACROSS, DOWN, COLUMNS = 230, 110, 2
LETTER, LINE = 7, 16


@dataclass
class ChartLayout:
    """Frames of states and junctions by SSID; of each transition its points, and the place of its label."""

    frames: dict[int, Frame] = field(default_factory=dict)
    points: dict[int, tuple[Point, Point, Point]] = field(default_factory=dict)
    labels: dict[int, Point] = field(default_factory=dict)

    @staticmethod
    def of(chart: WrittenChart) -> "ChartLayout":
        """That of a chart."""
        found = ChartLayout()
        for ssid, (x, y, across, down) in _placed(chart.children, chart.parallel)[0].items():
            found.frames[ssid] = chart.frames.get(ssid, (x + 40, y + 60, across, down))
        pairs: dict[frozenset[int], int] = {}
        for one in _transitions(chart.children):
            if any(end is not None and end.ssid not in found.frames for end in (one.source, one.target)):
                continue  # an end that is drawn nowhere
            ends = frozenset(end.ssid for end in (one.source, one.target) if end is not None)
            turn = pairs[ends] = pairs.get(ends, -1) + 1
            found.points[one.ssid] = found._way(one, turn)
            (x, y), lines = found.points[one.ssid][1], one.label.split("\n")
            wide = max(map(len, lines)) * 6
            level = abs(found.points[one.ssid][0][1] - found.points[one.ssid][2][1]) < LINE
            beside = (x + 8, y - 8 + LINE * turn)
            found.labels[one.ssid] = (x - wide // 2, y - 4 - LINE * len(lines)) if level else beside
        return found

    def _way(self, one: WrittenTransition, turn: int) -> tuple[Point, Point, Point]:
        assert one.target is not None
        x, y, across, down = self.frames[one.target.ssid]
        if one.source is None:
            return (x + 20, y - 30), (x + 20, y - 15), (x + 20, y)
        left, top, wide, high = self.frames[one.source.ssid]
        if one.source is one.target:
            right = left + wide
            return (right - 30, top), (right - 15, top - 26), (right, top + 14)
        shift = 12 + (26 if wide == 14 or across == 14 else 34) * turn
        if one.inner:
            start, end = (left, top + high - 12), (x, y + down / 2)
        elif x > left + wide:
            start, end = (left + wide, top + min(shift, high)), (x, y + min(shift, down))
        elif x + across < left:
            start, end = (left, top + min(shift, high)), (x + across, y + min(shift, down))
        else:
            narrow, room = (x, across) if across < wide else (left, wide)
            at = narrow + room / 2 - 20 + 44 * turn
            leaves, enters = (top + high, y) if y > top else (top, y + down)
            start, end = (_between(left, at, left + wide), leaves), (_between(x, at, x + across), enters)
        return start, ((start[0] + end[0]) / 2, (start[1] + end[1]) / 2), end


def _between(low: float, value: float, high: float) -> float:
    return min(max(value, low), high)


def _transitions(children: Sequence[WrittenElement]) -> Iterator[WrittenTransition]:
    for one in children:
        if isinstance(one, WrittenTransition) and one.target is not None:
            yield one
        elif isinstance(one, WrittenState):
            yield from _transitions(one.children)


def _placed(children: Sequence[WrittenElement], stacked: bool) -> tuple[Mapping[int, Frame], float, float]:
    """The frames of all in a level, from its upper left corner, and how wide and high it is."""
    frames: dict[int, Frame] = {}
    x = y = row = widest = 0.0
    nodes = [one for one in children if isinstance(one, WrittenState | WrittenJunction)]
    for number, one in enumerate(nodes):
        inner, across, down = _one(one)
        if number and (stacked or number % COLUMNS == 0):
            x, y, row = 0.0, y + row + (20 if stacked else DOWN), 0.0
        frames |= {ssid: (a + x, b + y, c, d) for ssid, (a, b, c, d) in inner.items()}
        widest, row = max(widest, x + across), max(row, down)
        x += across + ACROSS
    return frames, widest, y + row


def _one(one: WrittenState | WrittenJunction) -> tuple[Mapping[int, Frame], float, float]:
    if isinstance(one, WrittenJunction):
        return {one.ssid: (0, 0, 14, 14)}, 14, 14
    lines = one.label.split("\n")
    wide, high = max(map(len, lines)) * LETTER + 30.0, LINE * len(lines) + 34.0
    inner, across, down = _placed(one.children, one.parallel)
    frames = {ssid: (a + 60, b + high + 34, c, d) for ssid, (a, b, c, d) in inner.items()}
    wide, high = max(wide, across + 120, 90) if inner else max(wide, 90), high + down + 60 if inner else high
    return {one.ssid: (0, 0, wide, high), **frames}, wide, high


__all__ = ["ChartLayout"]
