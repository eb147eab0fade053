"""The timeline as a part of a page: lanes that zoom and fold, cursors, and every value beside its name."""

from collections.abc import Iterator
from dataclasses import replace
from importlib.resources import files
from typing import Any

from markupsafe import Markup, escape

from rovercheck.checker.render.page import Part, data, templates
from rovercheck.checker.render.page import own as of_page
from rovercheck.checker.render.timeline.axis import without_loop_start
from rovercheck.checker.render.timeline.build import timeline
from rovercheck.checker.render.timeline.model import Lane, LaneGroup, LaneKind, Timeline, TimelineRun
from rovercheck.checker.render.timeline.picture import picture, signs
from rovercheck.checker.render.timeline.shapes import HEIGHT, reach, visible
from rovercheck.checker.render.timeline.style import THEMED, sheet
from rovercheck.checker.results.trace import Trace

TEMPLATES = templates("timeline")
TALLEST = 30
"""Pixels of a lane at least: a name in two lines."""


def part(trace: Trace, *, everything: bool = False, still: bool = True) -> Part:
    """The timeline of a trace: what the property depends on, or ``everything``.

    Several may be on one page.  Without scripts it is a ``still`` picture; not where only a script can show
    it anyway.
    """
    shown = timeline(trace, everything=everything)
    ordered = replace(shown, lanes=tuple(lane for group in LaneGroup for lane in shown.of(group)))
    body = TEMPLATES.get_template("timeline.html").render(
        heading=shown.heading,
        groups=[(group.value, members) for group in LaneGroup if (members := shown.of(group))],
        lanes=ordered.lanes,
        folds=shown.repeated,
        constant=shown.constant,
        signs=[(Markup(sign), meaning) for sign, meaning in signs(shown)],
        wrongs=shown.wrong,
        ending=shown.ending,
        broken=broken,
        number=lambda lane, end: f"{float(reach(lane)[end]):g}",
        still=Markup(picture(shown)) if still else "",
        data=data(_data(ordered), "tl-data"),
    )
    styles = (own("timeline.css"), sheet(THEMED))
    return Part(
        Markup(body), styles, (of_page("zoom.js"), own("lanes.js"), own("marks.js"), own("timeline.js"))
    )


def own(name: str) -> str:
    """The text of a file beside this one: a style sheet or a script."""
    return files(__name__.rpartition(".")[0]).joinpath(name).read_text(encoding="utf-8")


def broken(name: str) -> Markup:
    """A name that may be broken after dots and underscores."""
    return Markup(str(escape(name)).replace("_", "_<wbr>").replace(".", ".<wbr>"))


def _data(shown: Timeline) -> dict[str, Any]:
    """What the script needs: the clock, what can be shortened, and what each lane shows."""
    return {
        "count": shown.ticks,
        "ms": shown.clock,
        "loop": shown.loop,
        "wrong": bool(shown.wrong),
        "stretches": sorted([*_quiet(shown), *_repeated(shown)], key=lambda one: int(one["first"])),
        "lanes": [_lane(lane) for lane in shown.lanes],
    }


def _quiet(shown: Timeline) -> Iterator[dict[str, Any]]:
    for first, last in without_loop_start(shown):
        what = f"Ticks {first}–{last}: only running counters change"
        yield {"kind": "quiet", "first": first, "last": last, "what": what}


def _repeated(shown: Timeline) -> Iterator[dict[str, Any]]:
    for number, row in enumerate(shown.repeated):
        yield {
            "kind": "fold",
            "first": row.first,
            "last": row.last,
            "what": row.what,
            "fold": number,
            "told": f"{row.told} again",
            "period": row.period,
            "times": row.times,
        }


def _lane(lane: Lane) -> dict[str, Any]:
    return {
        "kind": lane.kind,
        "group": lane.group.value,
        "tall": max(HEIGHT[lane.kind], TALLEST),
        "reach": [float(end) for end in reach(lane)],
        "runs": [_run(lane, run) for run in lane.runs],
        "limits": [[float(limit.value), limit.label] for limit in visible(lane)],
        "needed": [[n.first, n.last, f"{n.condition} is needed"] for n in lane.needed],
        "shots": [[shot.tick, shot.text] for shot in lane.shots],
    }


def _run(lane: Lane, run: TimelineRun) -> list[int | float | str]:
    """Ticks, label, meaning, the numbers at both ends; and the label of the last tick where it differs."""
    ends = (float(run.low), float(run.high)) if lane.kind in (LaneKind.LINE, LaneKind.RAMP) else (0, 0)
    return [run.first, run.last, run.label, run.tone.value, *ends, *([run.until] if run.until else [])]
