"""A counterexample played on its charts: what is active and which transition is taken, step by step."""

from collections.abc import Iterable, Iterator
from hashlib import sha256
from importlib.resources import files
from typing import Any

from markupsafe import Markup

from rovercheck.checker.render.drawing.emphasis import segments
from rovercheck.checker.render.drawing.labels import arrows
from rovercheck.checker.render.page import Part, data, templates
from rovercheck.checker.render.page import own as of_page
from rovercheck.checker.render.player.steps import PlayerStep, Script, States, script, shown_charts
from rovercheck.checker.render.statechart_svg import LEGEND, PAGE_STYLE, inline, size
from rovercheck.checker.render.story import StoryEvent, ending, false_parts, heading, start_of, value
from rovercheck.checker.results.trace import TakenTransition, Trace
from rovercheck.spec_model.lang.chart import Chart

TEMPLATES = templates("player")

ROOM = 880
"""Pictures up to this width, in pixels, have what is said of a step beside them, others below it."""

PICTURES = (of_page("zoom.js"), of_page("picture.js"), of_page("unfold.js"))
"""The scripts of pictures: zoom, and lists of actions that unfold."""

AREA = 700_000
"""Charts that take no more than so many square pixels together are all shown at first."""


def part(trace: Trace, *, everything: bool = False, pictures: bool = True, printed: bool = True) -> Part:
    """The player of a trace: its charts, controls, and what happens in each step.

    What is shown is what the property depends on, or ``everything``.  Without ``pictures`` the page
    must hold ``gallery`` of the same traces, which keeps one copy of a chart for all players.  On paper
    it is a table of what happens; not ``printed`` where the page has such a table anyway.
    """
    charts = shown_charts(trace, everything=everything)
    played = script(trace, everything=everything)
    sizes = [size(chart) for chart in charts]
    body = TEMPLATES.get_template("player.html").render(
        trace=trace,
        heading=heading(trace),
        charts=[(chart.name, key(chart), Markup(inline(chart) if pictures else "")) for chart in charts],
        together=sum(wide * high for wide, high in sizes) <= AREA,
        beside=max((wide for wide, _ in sizes), default=0) <= ROOM,
        legend=LEGEND,
        events=[_event_data(event) for event in played.events] if printed else [],
        data=data(_played(trace, charts, played), "player-data"),
    )
    return Part(Markup(body), (PAGE_STYLE, own("player.css")), (*PICTURES, own("player.js")))


def gallery(traces: Iterable[Trace], *, everything: bool = False) -> Part:
    """The pictures of all charts of these traces, each once, for players that bring none."""
    found = {key(c): c for trace in traces for c in shown_charts(trace, everything=everything)}
    holder = Markup('<template class="player-picture" data-picture="{}">{}</template>')
    body = Markup("").join(holder.format(name, Markup(inline(chart))) for name, chart in found.items())
    return Part(body, (PAGE_STYLE,), PICTURES)


def key(chart: Chart) -> str:
    """A name for the picture of a chart: charts of one name that are drawn differently differ."""
    return f"{chart.name}-{sha256(inline(chart).encode()).hexdigest()[:8]}"


def own(name: str) -> str:
    """The text of a file beside this one: a style sheet or a script."""
    return files(__name__).joinpath(name).read_text(encoding="utf-8")


def _played(trace: Trace, charts: Iterable[Chart], played: Script) -> dict[str, Any]:
    """What the script of the page needs."""
    by_name = {chart.name: chart for chart in charts}
    return {
        "ticks": len(trace),
        "ms": trace.clock(),
        "loop": trace.loop,
        "events": [_event(trace, event, by_name) for event in played.events],
        "steps": list(_changing(played.steps)),
        "quiet": [[row.first, row.last, row.what] for row in played.quiet],
        "again": [played.repeats.first, played.repeats.what] if played.repeats else None,
        "end": list(_end(trace)),
    }


def _event(trace: Trace, event: StoryEvent, charts: dict[str, Chart]) -> dict[str, Any]:
    return {
        "tick": event.number,
        "inputs": [str(c) for c in event.changes if c.is_input],
        "changes": [str(c) for c in event.changes if not c.is_input],
        "transitions": [
            _transition(transition, charts.get(transition.chart)) for transition in event.transitions
        ],
        "forced": list(_forced(trace, event.number)),
    }


def _transition(transition: TakenTransition, chart: Chart | None) -> dict[str, Any]:
    drawn = segments(chart, arrows(chart), transition) if chart else ()
    names = [segment.name for segment in drawn]
    return {"chart": transition.chart, "way": start_of(transition), "label": transition.label, "drawn": names}


def _forced(trace: Trace, tick: int) -> Iterator[str]:
    """The inputs that had to be so in a tick, as a person writes them."""
    for need in trace.needed():
        if need.number == tick:
            yield f"{need.name} = {' or '.join(value(trace, need.name, raw) for raw in sorted(need.values))}"


def _changing(steps: Iterable[PlayerStep]) -> Iterator[dict[str, Any]]:
    """Each step with the charts in which something else is active than in the step before."""
    before: States = {}
    for step in steps:
        news = {
            name: [".".join(path) for path in sorted(paths)]
            for name, paths in step.states.items()
            if before.get(name) != paths
        }
        yield {"event": step.event, "first": step.first, "last": step.last, "active": news}
        before = step.states


def _end(trace: Trace) -> Iterator[str]:
    """What there is to say after the last tick."""
    if last := ending(trace):
        yield last
    for falsified in false_parts(trace):
        values = ", ".join(f"{name} = {shown}" for name, shown in falsified.values)
        yield f"False now: {falsified.name or falsified.formula}" + (f" ({values})" if values else "")


def _event_data(event: StoryEvent) -> tuple[int, int, list[str]]:
    """A row of the printed table: tick, time and what happened."""
    lines = [f"in {c}" if c.is_input else str(c) for c in event.changes]
    lines += [f"▸ {a.chart}: {start_of(a)}" + (f" {a.label}" if a.label else "") for a in event.transitions]
    return event.number, event.ms, lines
