"""The timeline as a part of a page: lanes that scroll, a cursor, and every value in the tick under it."""

from importlib.resources import files
from typing import Any

from markupsafe import Markup, escape

from rovercheck.checker.render.page import Part, data, templates
from rovercheck.checker.render.timeline.axis import Axis, fit
from rovercheck.checker.render.timeline.build import timeline
from rovercheck.checker.render.timeline.drawing import HEAD, place, plot
from rovercheck.checker.render.timeline.model import Lane, Timeline
from rovercheck.checker.render.timeline.picture import RIGHT, scale, signs
from rovercheck.checker.render.timeline.shapes import reach
from rovercheck.checker.render.timeline.style import THEMED, sheet
from rovercheck.checker.results.trace import Trace

TEMPLATES = templates("timeline")
PAPER = 690
"""Pixels across a printed page."""
BESIDE = 580
"""Pixels of the lanes beside the table of values."""
NAMES = 226


def part(trace: Trace, *, everything: bool = False) -> Part:
    """The timeline of a trace: what the property depends on, or ``everything``.

    Several may be on one page.
    """
    shown = timeline(trace, everything=everything)
    axis = fit(shown, BESIDE)
    placed = place(shown, axis)
    wide = round(axis.width + RIGHT)
    body = TEMPLATES.get_template("timeline.html").render(
        scale=scale(shown, placed),
        heading=shown.heading,
        zoom=round(min(1, PAPER / (wide + NAMES)), 3),
        wide=wide,
        height=placed.height,
        head=HEAD,
        rows=placed.rows,
        lanes=shown.lanes,
        constant=shown.constant,
        plot=Markup("".join(plot(placed, tips=False))),
        signs=[(Markup(sign), meaning) for sign, meaning in signs(shown)],
        wrongs=shown.wrong,
        ending=shown.ending,
        broken=broken,
        number=lambda lane, end: f"{float(reach(lane)[end]):g}",
        data=data(_data(shown, axis), "tl-data"),
    )
    return Part(Markup(body), (own("timeline.css"), sheet(THEMED)), (own("timeline.js"),))


def own(name: str) -> str:
    """The text of a file beside this one: a style sheet or a script."""
    return files(__name__.rpartition(".")[0]).joinpath(name).read_text(encoding="utf-8")


def broken(name: str) -> Markup:
    """A name that may be broken after dots and underscores."""
    return Markup(str(escape(name)).replace("_", "_<wbr>").replace(".", ".<wbr>"))


def _data(shown: Timeline, axis: Axis) -> dict[str, Any]:
    """What the script needs: the edges of ticks, and the runs of each lane."""
    edges = axis.edges if shown.ticks else (0,)
    return {"edges": edges, "ms": shown.clock, "lanes": [_runs(lane) for lane in shown.lanes]}


def _runs(lane: Lane) -> list[list[int | str]]:
    return [[r.first, r.last, r.label, *([r.until] if r.until else [])] for r in lane.runs]
