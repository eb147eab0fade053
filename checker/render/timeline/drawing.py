"""The lanes of a timeline in their places: what both the picture and the page show."""

import re
from collections.abc import Iterator
from dataclasses import dataclass
from xml.sax.saxutils import escape

from rovercheck.checker.render.drawing.svg import tag, text
from rovercheck.checker.render.drawing.text import LINE, SIZE, width, wrap
from rovercheck.checker.render.periods import RepeatedTicks
from rovercheck.checker.render.timeline.axis import Axis, labelled
from rovercheck.checker.render.timeline.model import Lane, LaneGroup, LaneKind, Timeline
from rovercheck.checker.render.timeline.runs import outside
from rovercheck.checker.render.timeline.shapes import HEIGHT, shapes

NAMES = 190
"""Pixels for the name of a lane."""
HEAD = 50
"""Pixels above the lanes: marks, tick numbers, milliseconds."""
TITLE = 22
"""Pixels of the title of a group."""
FALSE, SHOWN = "✗ false here", "shown here"
PIECES = re.compile(r"[^._ ]*[._ ]?")


@dataclass(frozen=True)
class TimelineRow:
    """A lane, or the title of a group, in its place; ``name`` in lines that have room."""

    top: int
    tall: int
    name: tuple[str, ...]
    lane: Lane | None = None


@dataclass(frozen=True)
class PlacedLane:
    """All rows of a timeline, below each other, and the height of all."""

    timeline: Timeline
    axis: Axis
    rows: tuple[TimelineRow, ...]
    height: int


def place(timeline: Timeline, axis: Axis) -> PlacedLane:
    """Every lane below the others, groups under their titles."""
    rows: list[TimelineRow] = []
    top = HEAD
    for group in LaneGroup:
        lanes = timeline.of(group)
        if lanes:
            rows.append(TimelineRow(top, TITLE, (group.value,)))
            top += TITLE
        for lane in lanes:
            name = name_lines(lane)
            tall = max(HEIGHT[lane.kind], LINE * len(name) + 4)
            rows.append(TimelineRow(top, tall, name, lane))
            top += tall + 4
    return PlacedLane(timeline, axis, tuple(rows), top + 4)


def name_lines(lane: Lane) -> tuple[str, ...]:
    """The name of a lane in lines that fit: broken after dots and underscores, a formula at its spaces."""
    if lane.kind is LaneKind.TRUTH and " " in lane.name:
        return wrap(lane.name, NAMES // 7)
    lines = [""]
    for piece in PIECES.findall(lane.name):
        if lines[-1] and width(lines[-1] + piece, SIZE) > NAMES:
            lines.append("")
        lines[-1] += piece
    return tuple(lines)


def plot(placed: PlacedLane, *, tips: bool = True) -> Iterator[str]:
    """Everything right of the names: axis, shading, lanes, breaks and marks; ``tips`` at values."""
    timeline, axis = placed.timeline, placed.axis
    yield from _loop(placed)
    yield from _axis(placed)
    for row in placed.rows:
        if row.lane is not None:
            yield from shapes(outside(row.lane, axis.folds), axis, row.top, row.tall, tips=tips)
    for first, last in axis.breaks:
        yield from _break(placed, first, last)
    for fold in axis.folds:
        yield from _fold(placed, fold)
    if timeline.ticks and timeline.loop is None:
        yield from _end(placed)


def _axis(placed: PlacedLane) -> Iterator[str]:
    timeline, axis = placed.timeline, placed.axis
    for tick in labelled(timeline, axis):
        x = axis.middle(tick)
        yield text(x, HEAD - 18, str(tick), "tl-tick", text_anchor="middle")
        yield text(x, HEAD - 5, str(timeline.ms(tick)), "tl-ms", text_anchor="middle")
        yield tag("path", d=f"M{axis.left(tick)} {HEAD}V{placed.height}", class_="tl-grid")
    yield tag("path", d=f"M0 {HEAD}H{axis.width}", class_="tl-base")


def _loop(placed: PlacedLane) -> Iterator[str]:
    """The part that repeats, shaded."""
    timeline, axis = placed.timeline, placed.axis
    if timeline.loop is None or not timeline.ticks:
        return
    x = axis.left(timeline.loop + 1)
    wide = round(axis.width - x, 2)
    yield tag("rect", x=x, y=0, width=wide, height=placed.height, class_="tl-loop")
    yield tag("path", d=f"M{x} 0V{placed.height}", class_="tl-loop-edge")
    told = "↻ repeats for ever"
    if width(told) + 8 <= wide:
        yield text(x + 4, 13, told, "tl-loop-text")
    else:
        yield text(x - 4, 13, "repeats for ever ↻", "tl-loop-text", text_anchor="end")


def _break(placed: PlacedLane, first: int, last: int) -> Iterator[str]:
    """A visible cut through all lanes, and what is left out."""
    axis = placed.axis
    x = round((axis.left(first) + axis.right(last)) / 2, 1)
    zigzag = f"M{x} {HEAD}" + "".join(f"l{4 if k % 2 else -4} 6" for k in range((placed.height - HEAD) // 6))
    yield tag("path", d=zigzag, class_="tl-gap")
    yield tag("path", d=zigzag, class_="tl-cut", transform="translate(-3 0)")
    yield tag("path", d=zigzag, class_="tl-cut", transform="translate(3 0)")
    yield text(x, HEAD - 18, f"{last - first + 1} ticks", "tl-ms", text_anchor="middle")
    yield text(x, HEAD - 5, "≈", "tl-ms", text_anchor="middle")


def _fold(placed: PlacedLane, fold: RepeatedTicks) -> Iterator[str]:
    """A box instead of the ticks that repeat those before them, and a bracket over the first time."""
    axis, start = placed.axis, fold.first - fold.period
    left, right = axis.left(fold.first), axis.right(fold.last)
    box = {
        "x": left + 3,
        "y": HEAD + 1,
        "width": round(right - left - 6, 2),
        "height": placed.height - HEAD - 2,
    }
    yield tag("rect", tag("title", escape(fold.what)), **box, rx=4, class_="tl-fold")
    middle, low = round((left + right) / 2, 1), round((HEAD + placed.height) / 2, 1)
    if width(again := f"{fold.told} again") < box["height"]:
        yield text(middle + 4, low, again, "tl-fold-text", text_anchor="middle",
                   transform=f"rotate(-90 {middle + 4} {low})")  # fmt: skip
    yield tag("path", d=f"M{axis.left(start)} 20v-4H{left - 2}v4", class_="tl-bracket")
    yield text(middle, 13, f"× {fold.times} more", "tl-loop-text", text_anchor="middle")
    yield text(middle, HEAD - 18, f"{fold.first}–{fold.last}", "tl-tick", text_anchor="middle")
    yield text(middle, HEAD - 5, "–".join(map(str, fold.ms)), "tl-ms", text_anchor="middle")


def _end(placed: PlacedLane) -> Iterator[str]:
    """The tick in which a part of the property is false, or which shows what the run is to show."""
    told, class_ = (FALSE, "tl-fail") if placed.timeline.wrong else (SHOWN, "tl-end")
    axis, last = placed.axis, placed.timeline.ticks
    x, wide = axis.left(last), round(axis.width - axis.left(last), 2)
    yield tag("rect", x=x, y=HEAD, width=wide, height=placed.height - HEAD, class_=class_)
    inside = wide > width(told)
    at, anchor = (axis.middle(last), "middle") if inside else (axis.width, "end")
    yield text(at, 13, told, f"{class_}-text", text_anchor=anchor)
