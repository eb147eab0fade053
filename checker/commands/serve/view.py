"""A session, the charts and the verdicts as the live page is told of them."""

from collections.abc import Iterable, Iterator, Mapping
from time import perf_counter

from rovercheck.checker.commands.serve.document import (
    ChartPicture,
    NextRows,
    OverviewDocument,
    PastRow,
    PicturesDocument,
    SessionDocument,
    StepRow,
    SystemChoice,
    TimerRow,
    TransitionItem,
    ValueRow,
    VerdictRow,
)
from rovercheck.checker.commands.serve.workspace import Exploration, Workspace
from rovercheck.checker.explore.by_hand.next_steps import NextSteps, PossibleStep
from rovercheck.checker.explore.by_hand.session import Session
from rovercheck.checker.render.drawing.activity import active
from rovercheck.checker.render.drawing.emphasis import segments
from rovercheck.checker.render.drawing.labels import arrows
from rovercheck.checker.render.limits import timer
from rovercheck.checker.render.statechart_svg import LEGEND, inline, size
from rovercheck.checker.render.story import TIMER, of_model, value
from rovercheck.checker.render.verdict_text import evidence
from rovercheck.checker.results.trace import TakenTransition, Trace
from rovercheck.checker.results.verdict import Unknown
from rovercheck.checker.verify.result import Result
from rovercheck.checker.verify.runs.replay import transition_of
from rovercheck.properties.forms import Property, formulas
from rovercheck.spec_model.lang.chart import Chart
from rovercheck.spec_model.lang.expr import Var
from rovercheck.spec_model.lang.system import System, charts_of
from rovercheck.spec_model.lang.walk import variables

FEW = 12
"""Values up to which all are offered as a choice."""
PAST = 200
"""Rows of the past that are listed: the last ones."""


def overview(workspace: Workspace) -> OverviewDocument:
    """What there is: systems, charts, properties, sessions."""
    model, systems = workspace.variant.model, workspace.systems
    return {
        "model": {
            "name": " ".join(filter(None, [model.name, workspace.variant.name])),
            "version": workspace.version,
            "problem": workspace.problem,
            "watched": workspace.options.model is not None,
        },
        "systems": [_system(one) for one in systems.values()],
        "charts": [_chart_alone(one) for one in charts_of(systems).values() if one.name not in systems],
        "properties": [verdict(workspace, one) for one in model.properties.values() if one.on in systems],
        "sessions": [
            {"id": one.id, "system": one.name, "tick": one.session.simulation.at}
            for one in reversed(workspace.explorations.values())
        ],
    }


def _system(one: System) -> SystemChoice:
    return {"name": one.name, "text": one.text, "charts": [chart.name for chart in one.charts]}


def _chart_alone(one: Chart) -> SystemChoice:
    return {"name": one.name, "text": one.text, "charts": [one.name]}


def verdict(workspace: Workspace, prop: Property) -> VerdictRow:
    """A property with the verdict on record, and the one that was decided here."""
    on_record = workspace.variant.expected(prop.id)
    result: Result | None = workspace.decided.get(prop.id)
    return {
        "id": prop.id,
        "text": prop.text,
        "system": prop.on,
        "charts": _speaks_of(prop, workspace.systems[prop.on]),
        "expected": on_record.verdict,
        "because": on_record.because,
        "decided": result.verdict.word if result else "",
        "evidence": evidence(result) if result else "",
        "has_run": run_of(result) is not None,
    }


def _speaks_of(prop: Property, system: System) -> list[str]:
    """The charts whose states, or data that they write, occur in a property."""
    names = variables(*formulas(prop.form)).keys()
    of = {chart.name: {*chart.written, *(v.name for v in chart.locations)} for chart in system.charts}
    return [name for name, own in of.items() if not own.isdisjoint(names)]


def run_of(result: Result | None) -> Trace | None:
    """The run that a verdict rests on, if it rests on one."""
    if result is None or isinstance(result.verdict, Unknown):
        return None
    return result.verdict.because if isinstance(result.verdict.because, Trace) else None


def pictures(system: System) -> PicturesDocument:
    """The charts of a system as drawn."""
    return {"charts": [_picture(chart) for chart in system.charts], "legend": list(LEGEND)}


def _picture(chart: Chart) -> ChartPicture:
    wide, high = size(chart)
    return {
        "name": chart.name, "text": chart.text, "picture": inline(chart), "width": wide, "height": high,
    }  # fmt: skip


# --- a session ------------------------------------------------------------------------------------------


def session_document(one: Exploration, required: Iterable[str] = ()) -> SessionDocument:
    """A session at the tick that is looked at, and what can come together with ``required`` steps."""
    session, sim = one.session, one.session.simulation
    trace = sim.trace(max(sim.at, 1))
    charts = {chart.name: chart for chart in sim.system.charts}
    state, before = sim.state(), sim.state(max(sim.at - 1, 0))
    past, left = _past(session)
    return {
        "session": one.id,
        "system": one.name,
        "version": one.version,
        "tick": sim.at,
        "ticks": len(sim),
        "ms": sim.ms,
        "said": one.said,
        "active": {n: sorted(".".join(p) for p in active(chart, state)) for n, chart in charts.items()},
        "fired": [_transition(transition_of(fired), charts) for fired in sim.fired()],
        "inputs": list(_inputs(session, trace)),
        "frozen": [_value(trace, sim.variables[n], raw) for n, raw in sim.frozen.items()],
        "values": list(_values(session, trace, state, before)),
        "timers": list(_timers(trace, state)),
        "breaks": [text for text, _ in session.breaks],
        "past": past,
        "past_left": left,
        "next": next_rows(session, trace, charts, list(required)),
        "script": session.script(),
    }


def _transition(taken: TakenTransition, charts: Mapping[str, Chart]) -> TransitionItem:
    chart = charts.get(taken.chart)
    drawn = segments(chart, arrows(chart), taken) if chart else ()
    return {
        "chart": taken.chart,
        "way": f"{taken.source or 'default'} → {taken.target}",
        "label": taken.label,
        "drawn": [segment.name for segment in drawn],
        "moves": taken.source != taken.target,
    }


def _value(trace: Trace, var: Var, raw: int, *, changed: bool = False, free: bool = False) -> ValueRow:
    values = var.domain.values
    return {
        "name": var.name,
        "value": value(trace, var.name, raw),
        "doc": var.doc,
        "domain": str(var.domain),
        "choices": [var.domain.show(v) for v in values] if len(values) <= FEW else [],
        "changed": changed,
        "free": free,
    }


def _inputs(session: Session, trace: Trace) -> Iterator[ValueRow]:
    """The inputs as they stand for the next tick; changed are those that were others in this one."""
    given = session.simulation.given()
    for name, raw in session.standing.items():
        changed = bool(given) and given[name] != raw
        yield _value(trace, session.simulation.inputs[name], raw, changed=changed, free=name in session.free)


def _values(
    session: Session, trace: Trace, state: Mapping[str, int], before: Mapping[str, int]
) -> Iterator[ValueRow]:
    """Data that charts and blocks write, those first that have changed in this tick."""
    sim = session.simulation
    places = {v.name for c in sim.system.charts for v in (*c.locations, c.entered)}
    plain = [
        n
        for n in state
        if n not in places and n not in sim.frozen and of_model(trace, n) and not TIMER.search(n)
    ]
    for name in sorted(plain, key=lambda n: state[n] == before[n]):
        yield _value(trace, sim.variables[name], state[name], changed=state[name] != before[name])


def _timers(trace: Trace, state: Mapping[str, int]) -> Iterator[TimerRow]:
    for name, raw in state.items():
        known = timer(trace, name) if TIMER.search(name) and raw else None
        if known is not None:
            share = min(1.0, raw / max(1, trace.system.variables[name].domain.high))
            yield {"name": name, "value": known.shown(raw), "limit": known.limit, "share": share}


def _past(session: Session) -> tuple[list[PastRow], int]:
    """The ticks up to this one in which a state was left, the last ones, and how many are left out."""
    sim = session.simulation
    found: list[PastRow] = []
    for tick in range(1, len(sim) + 1):
        moved = [t for t in map(transition_of, sim.fired(tick)) if t.source != t.target]
        if moved:
            text = "; ".join(f"{t.chart}: {t.source or 'default'} → {t.target}" for t in moved[:3])
            more = f"; {len(moved) - 3} more" if len(moved) > 3 else ""
            found.append({"tick": tick, "ms": tick * sim.lowered.tick_ms, "text": f"{text}{more}"})
    return found[-PAST:], max(0, len(found) - PAST)


def next_rows(session: Session, trace: Trace, charts: Mapping[str, Chart], required: list[str]) -> NextRows:
    """What can happen in the next tick."""
    begun = perf_counter()
    steps: NextSteps = session.next_steps(required)
    took = round(1000 * (perf_counter() - begun))
    return {
        "steps": [_step(step, trace, charts) for step in steps.steps],
        "anyway": [_transition(one, charts) for one in steps.anyway],
        "bounded": list(steps.bounded),
        "problems": list(steps.problems),
        "ms": took,
    }


def _step(step: PossibleStep, trace: Trace, charts: Mapping[str, Chart]) -> StepRow:
    given = {n: step.inputs.get(n, step.frozen.get(n, 0)) for n in step.changed}
    return {
        "key": step.key,
        "of": step.of,
        "title": step.title,
        "moves": step.moves,
        "standing": step.standing,
        "transitions": [_transition(one, charts) for one in step.transitions],
        "by": [f"{n} = {value(trace, n, raw)}" for n, raw in given.items()],
        "also": [_transition(one, charts) for one in step.also],
    }
