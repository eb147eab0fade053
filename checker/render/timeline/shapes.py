"""The shapes of one lane: bands with labels, step lines with limits, ramps of timers."""

from collections.abc import Callable, Iterator
from fractions import Fraction
from xml.sax.saxutils import escape

from rovercheck.checker.render.drawing.svg import tag, text
from rovercheck.checker.render.drawing.text import width
from rovercheck.checker.render.lanes import Tone
from rovercheck.checker.render.timeline.axis import SMALL, Axis
from rovercheck.checker.render.timeline.model import Lane, LaneKind, Limit, TimelineRun

HEIGHT = {LaneKind.BAND: 20, LaneKind.TRUTH: 20, LaneKind.LINE: 62, LaneKind.RAMP: 40}
STAIR = 5.0
"""Pixels of a tick from which on a steady count is drawn as stairs."""
HATCHED = 6
"""Pixels between two strokes of a hatch."""

SHORTEST = 4
"""Letters of a label that is cut."""

Height = Callable[[Fraction], float]
"""How far down a number is drawn."""


def shapes(lane: Lane, axis: Axis, top: int, tall: int, *, tips: bool = True) -> Iterator[str]:
    """The lane drawn between y = ``top`` and ``top + tall``; ``tips``: values are told where one points."""
    if lane.kind in (LaneKind.BAND, LaneKind.TRUTH):
        for run in lane.runs:
            yield from _band(run, axis, top + 2, tall - 4, tips)
    else:
        yield from _graph(lane, axis, top, tall, tips)
    for need in lane.needed:
        x, wide = axis.left(need.first), axis.right(need.last) - axis.left(need.first)
        told = tag("title", escape(f"{_span(need.first, need.last)}: {need.condition} is needed"))
        yield tag("rect", told, x=x, y=top + 1, width=round(wide, 2), height=tall - 2, class_="tl-needed")
    for shot in lane.shots:
        yield _transition(axis.left(shot.tick), top, f"tick {shot.tick}: {shot.text}")


def _transition(x: float, top: int, told: str) -> str:
    """A small mark where a transition fired."""
    mark = f"M{x - 4} {top - 2}h8l-4 7z"
    return tag("path", tag("title", escape(told)), d=mark, class_="tl-shot")


def _span(first: int, last: int) -> str:
    return f"tick {first}" if first == last else f"ticks {first}–{last}"


def _title(run: TimelineRun) -> str:
    span = _span(run.first, run.last)
    values = f"{run.label} → {run.until}" if run.until else run.label
    return tag("title", escape(f"{span}: {values}"))


def _band(run: TimelineRun, axis: Axis, y: int, tall: int, tips: bool) -> Iterator[str]:
    x, right = axis.left(run.first), axis.right(run.last)
    wide = round(right - x, 2)
    told = _title(run) if tips else ""
    yield tag("rect", told, x=x, y=y, width=wide, height=tall, class_=f"tl-is-{run.tone.value}")
    label = fitting(run.label, wide - 8)
    if run.tone is Tone.DEGRADED:
        yield hatch(x + (width(label, SMALL) + 8 if label else 0), y, right, y + tall)
    if label:
        yield text(x + 4, y + tall // 2 + 4, label, f"tl-label tl-on-{run.tone.value}")


def fitting(label: str, room: float) -> str:
    """The label, or its beginning that has room; nothing if that would be too little to tell it."""
    if width(label, SMALL) <= room:
        return label
    cut = next((n for n in range(len(label), 0, -1) if width(label[:n] + "…", SMALL) <= room), 0)
    return f"{label[:cut]}…" if cut >= SHORTEST else ""


def hatch(x: float, y: int, right: float, bottom: int) -> str:
    """Slanted strokes within a box, each cut at its sides."""
    tall = bottom - y
    strokes = []
    for start in range(int(x) - tall, int(right), HATCHED):
        a, b = max(start, x), min(start + tall, right)
        if b - a > 1:
            low, high = bottom - (a - start), bottom - (b - start)
            strokes.append(f"M{round(a, 1)} {round(low, 1)}L{round(b, 1)} {round(high, 1)}")
    return tag("path", d="".join(strokes), class_="tl-hatch") if strokes else ""


def reach(lane: Lane) -> tuple[Fraction, Fraction]:
    """The range that a graph shows: all values, and the limits inside and next to them."""
    low, high = lane.extent
    if lane.kind is LaneKind.RAMP:
        return Fraction(0), max(high, *(limit.value for limit in lane.limits), Fraction(1))
    values = [limit.value for limit in lane.limits]
    low = max((v for v in values if v <= low), default=low)
    high = min((v for v in values if v >= high), default=high)
    return (low, high) if low < high else (low - 1, high + 1)


def visible(lane: Lane) -> list[Limit]:
    """The limits within the range that is shown."""
    low, high = reach(lane)
    return [limit for limit in lane.limits if low <= limit.value <= high]


def _graph(lane: Lane, axis: Axis, top: int, tall: int, tips: bool) -> Iterator[str]:
    low, high = reach(lane)
    head, foot = top + (16 if lane.kind is LaneKind.LINE else 8), top + tall - 6

    def y(value: Fraction) -> float:
        return round(float(foot - (value - low) / (high - low) * (foot - head)), 1)

    yield tag("path", d=f"M0 {foot + 2}H{axis.width}", class_="tl-base")
    yield from _limits(lane, axis, y)
    line = _steps(lane, axis, y)
    if lane.kind is LaneKind.RAMP:
        yield from (_filled(run, axis, y, foot) for run in lane.runs if run.high)
    yield tag("path", d=line, class_="tl-curve")
    for run in lane.runs if tips else ():
        x, wide = axis.left(run.first), round(axis.right(run.last) - axis.left(run.first), 2)
        yield tag("rect", _title(run), x=x, y=top, width=wide, height=tall, class_="tl-hover")
    yield from _values(lane, axis, y, top)


def _limits(lane: Lane, axis: Axis, y: Height) -> Iterator[str]:
    """Dashed lines across, named at the right; a name that would meet the one below is moved up."""
    lowest = float("inf")
    for limit in visible(lane):
        at = y(limit.value)
        yield tag("path", d=f"M0 {at}H{axis.width}", class_="tl-limit")
        lowest = min(at + 4, lowest - 11)
        yield text(axis.width + 6, round(lowest, 1), limit.label, "tl-bound")


def _steps(lane: Lane, axis: Axis, y: Height) -> str:
    """The line: a value for its whole tick; a steady count as stairs, or slanted where ticks are narrow."""
    d, last = "", 0
    for run in lane.runs:
        points = "L".join(f"{x} {height}" for x, height in _points(run, axis, y))
        d += f"{'L' if run.first == last + 1 and d else 'M'}{points}"
        last = run.last
    return d


def _points(run: TimelineRun, axis: Axis, y: Height) -> Iterator[tuple[float, float]]:
    count = run.last - run.first
    narrow = axis.right(run.last) - axis.left(run.first) < STAIR * (count + 1)
    if run.low == run.high or narrow:
        yield axis.left(run.first), y(run.low)
        yield axis.right(run.last), y(run.high)
        return
    for tick in range(run.first, run.last + 1):
        height = y(run.low + (run.high - run.low) * (tick - run.first) / count)
        yield axis.left(tick), height
        yield axis.right(tick), height


def _filled(run: TimelineRun, axis: Axis, y: Height, foot: int) -> str:
    """The area below a timer."""
    points = "L".join(f"{x} {height}" for x, height in _points(run, axis, y))
    d = f"M{axis.left(run.first)} {foot}L{points}L{axis.right(run.last)} {foot}Z"
    return tag("path", d=d, class_="tl-ramp")


def _values(lane: Lane, axis: Axis, y: Height, top: int) -> Iterator[str]:
    """The number at the start of each run that has room for it, and at the end of a count."""
    free = 0.0
    for run in lane.runs:
        shown = f"{run.label} → {run.until}" if run.until else run.label
        start, end = axis.left(run.first) + 3, axis.right(run.last)
        room = width(shown, SMALL)
        if lane.kind is LaneKind.RAMP and not run.high:
            continue
        if start >= free and (start + room <= end or run is lane.runs[-1]):
            x = min(start, axis.width - room)
            at = min(y(run.low), y(run.high)) if lane.kind is LaneKind.LINE else top + HEIGHT[lane.kind] / 2
            yield text(round(x, 1), round(max(at - 4, top + 9), 1), shown, "tl-value")
            free = x + room + 4
