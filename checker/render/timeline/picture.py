"""The timeline as one SVG picture, for reading and for print: title, lanes, legend, what is false."""

from collections.abc import Iterator

from rovercheck.checker.render.drawing.svg import document, lines, tag, text
from rovercheck.checker.render.drawing.text import LINE, width, wrap
from rovercheck.checker.render.lanes import Tone
from rovercheck.checker.render.timeline.axis import SMALL, fit, shortened
from rovercheck.checker.render.timeline.drawing import PlacedLane, TimelineRow, place, plot
from rovercheck.checker.render.timeline.model import Lane, LaneKind, Timeline
from rovercheck.checker.render.timeline.shapes import hatch, reach, visible
from rovercheck.checker.render.timeline.style import MEANINGS, PRINTED, sheet

LEFT = 240
"""Pixels left of the lanes."""
RIGHT = 80
LEAST = 1000
"""Pixels of the whole picture."""
OWN = (
    ".title{font-size:15px;font-weight:bold}.sentence{font-size:13px}.soft{fill:#4f5768}"
    ".wrong{fill:#a3122b;font-weight:bold}text{fill:#1d2433}"
)


def picture(timeline: Timeline) -> str:
    """The SVG document."""
    placed = place(timeline, fit(timeline))
    wide = max(LEAST, round(LEFT + placed.axis.width + RIGHT))
    head = _head(timeline, wide)
    top = 12 + sum(size + 5 for _, _, size in head)
    y = top + placed.height + 14
    key = list(_legend(placed, wide - 24))
    legend = tag("g", "".join(text for text, _ in key), transform=f"translate(12 {y})")
    y += max((bottom for _, bottom in key), default=0) + 12
    foot = []
    for shown, class_ in _below(timeline, placed, round((wide - 24) / 6.3)):
        foot += lines(12, y, shown, class_)
        y += LINE * len(shown) + 4
    body = [
        *_titles(head),
        tag("g", "".join(_names(placed)), transform=f"translate(0 {top})"),
        tag("g", "".join(plot(placed)), transform=f"translate({LEFT} {top})"),
        legend,
        *foot,
    ]
    return document(
        wide, y + 8, sheet(PRINTED, bool(placed.axis.folds)) + OWN, timeline.property or "A run", body
    )


def _head(timeline: Timeline, wide: int) -> list[tuple[str, str, int]]:
    """Lines above the lanes: text, class, height of the letters."""
    found = [(timeline.property, "title", 15)] if timeline.property else []
    found += [(line, "sentence", 13) for line in wrap(timeline.text, wide // 9)]
    return [*found, (timeline.heading, "soft" if found else "title", 12 if found else 15)]


def _titles(head: list[tuple[str, str, int]]) -> Iterator[str]:
    y = 8
    for shown, class_, size in head:
        y += size + 4
        yield text(12, y, shown, class_)


def _names(placed: PlacedLane) -> Iterator[str]:
    yield text(LEFT - 8, 32, "tick", "tl-tick", text_anchor="end")
    yield text(LEFT - 8, 45, "ms", "tl-ms", text_anchor="end")
    for row in placed.rows:
        if row.lane is None:
            yield text(12, row.top + 15, row.name[0], "tl-group")
            yield tag("path", d=f"M12 {row.top + 19}H{LEFT - 8}", class_="tl-base")
        else:
            yield from _name(row, row.lane)


def _name(row: TimelineRow, lane: Lane) -> Iterator[str]:
    y = row.top + (row.tall - LINE * len(row.name)) // 2
    if lane.needed:
        yield text(12, y + 11, "●", "tl-mark")
    yield from (text(26, y + 11 + LINE * i, line, "tl-name") for i, line in enumerate(row.name))
    if lane.kind is LaneKind.LINE:
        low, high = (f"{float(v):g}" for v in reach(lane))
        yield text(LEFT - 5, row.top + 20, high, "tl-range", text_anchor="end")
        yield text(LEFT - 5, row.top + row.tall - 3, low, "tl-range", text_anchor="end")


def _legend(placed: PlacedLane, wide: int) -> Iterator[tuple[str, int]]:
    """What the fillings and marks mean, of those that occur, side by side; each with its bottom."""
    x = y = 0
    for sign, meaning in signs(placed.timeline, bool(placed.axis.folds)):
        room = 30 + width(meaning, SMALL) + 18
        if x and x + room > wide:
            x, y = 0, y + 18
        told = text(30, 11, meaning, "tl-ms")
        yield tag("g", sign + told, transform=f"translate({x} {y})"), y + 16
        x += room


def signs(timeline: Timeline, folds: bool = True) -> Iterator[tuple[str, str]]:
    """Every sign that occurs, 24 pixels wide, and its meaning; ``folds``: repetitions are boxes."""
    bands = {
        run.tone
        for lane in timeline.lanes
        for run in lane.runs
        if lane.kind in (LaneKind.BAND, LaneKind.TRUTH)
    }
    for tone, meaning in MEANINGS.items():
        if tone in bands:
            box = tag("rect", y=2, width=24, height=11, class_=f"tl-is-{tone.value}")
            yield box + (hatch(0, 2, 24, 13) if tone is Tone.DEGRADED else ""), meaning
    if any(visible(lane) for lane in timeline.lanes):
        yield tag("path", d="M0 8H24", class_="tl-limit"), "limit with which it is compared"
    if any(lane.shots for lane in timeline.lanes):
        yield tag("path", d="M8 4h8l-4 7z", class_="tl-shot"), "a transition of the chart fired"
    if any(lane.needed for lane in timeline.lanes):
        box = tag("rect", x=1, y=2, width=22, height=11, class_="tl-needed")
        yield box, "input that determines the end, whatever the others are"
    if folds and timeline.repeated:
        box = tag("rect", x=1, y=2, width=22, height=11, rx=3, class_="tl-fold")
        yield box, "the ticks under the bracket again, so often"
    if timeline.loop is not None:
        yield tag("rect", y=2, width=24, height=11, class_="tl-loop"), "repeats for ever"


def _below(timeline: Timeline, placed: PlacedLane, letters: int) -> Iterator[tuple[tuple[str, ...], str]]:
    """Texts below the lanes with their class: what is false, what repeats, what never changes."""
    for wrong in timeline.wrong:
        yield wrap(f"✗ {wrong}", letters * 9 // 10, "    "), "wrong"
    if timeline.because:
        yield wrap(f"Why: {timeline.because}", letters, "    "), ""
    if timeline.cause:
        yield wrap(f"● {timeline.cause}", letters, "    "), ""
    if timeline.ending:
        yield wrap(timeline.ending, letters), ""
    for fold in placed.axis.folds:
        yield wrap(f"{fold.what[:1].upper()}{fold.what[1:]}.", letters, "    "), ""
    if timeline.constant:
        told = (f"{name} = {shown}".replace(" ", "\N{NO-BREAK SPACE}") for name, shown in timeline.constant)
        same = ", ".join(told)
        yield wrap(f"The same in every tick: {same}", letters, "    "), "soft"
    yield wrap(scale(timeline, placed), letters), "soft"


def scale(timeline: Timeline, placed: PlacedLane) -> str:
    """Whether the picture is to scale, and what is left out."""
    if not (placed.axis.breaks or placed.axis.folds):
        if isinstance(timeline.clock, int):
            return f"To scale: every tick is {timeline.clock} ms; the time is that at its end."
        return "Ticks of unlike lengths are drawn alike; the time is that at the end of a tick."
    left_out = shortened(placed.axis.breaks)
    again = sum(fold.count for fold in placed.axis.folds)
    told = [
        f"{left_out} of {timeline.ticks} ticks, in which only running counters change, are shortened at the "
        "zigzag lines" if left_out else "",
        f"{again} of {timeline.ticks} ticks, which repeat others, are drawn as boxes" if again else "",
    ]  # fmt: skip
    return f"Not to scale: {'; '.join(filter(None, told))}."
