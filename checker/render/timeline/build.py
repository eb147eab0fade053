"""The timeline of a trace: which lanes it has, in which order, and what each shows in each tick."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace

from rovercheck.checker.render.lanes import Tone
from rovercheck.checker.render.periods import RepeatedTicks, folded
from rovercheck.checker.render.reasons import determined_by, reasons
from rovercheck.checker.render.story import TIMER, Quiet, ending, false_parts, heading, of_model, value
from rovercheck.checker.render.timeline.limits import Limits, thresholds, time_limits
from rovercheck.checker.render.timeline.model import (
    Lane,
    LaneGroup,
    LaneKind,
    Limit,
    NeededTicks,
    Shot,
    Timeline,
    TimelineRun,
)
from rovercheck.checker.render.timeline.runs import Values, runs, stretches
from rovercheck.checker.results.trace import NecessaryInputs, Trace
from rovercheck.spec_model.lang.action import expressions
from rovercheck.spec_model.lang.chart import NOWHERE, Block
from rovercheck.spec_model.lang.chart import parts as components
from rovercheck.spec_model.lang.domain import Enum, Num, show
from rovercheck.spec_model.lang.evaluate import evaluate
from rovercheck.spec_model.lang.expr import Expr, Named, Temporal
from rovercheck.spec_model.lang.label import text
from rovercheck.spec_model.lang.walk import nodes, variables

# --- the lanes of a property ---------------------------------------------------------------------------


def parts(trace: Trace) -> Iterator[Lane]:
    """The conjuncts of the property that are false in some tick, those false at the end first."""
    ended = {id(expr) for expr in trace.property.false_parts}
    others = [
        e
        for e, v in zip(trace.property.parts, trace.property.truths, strict=False)
        if id(e) not in ended and not all(v)
    ]
    for expr in (*trace.property.false_parts, *others):
        truths = _truths(trace, expr)
        runs = [
            TimelineRun(first + 1, last + 1, "true" if truths[first] else "false",
                tone=Tone.OK if truths[first] else Tone.CRITICAL)
            for first, last in stretches(truths, steady=False)
            if truths[first] is not None
        ]  # fmt: skip
        name = expr.name if isinstance(expr, Named) else text(expr)
        yield Lane(name, LaneKind.TRUTH, LaneGroup.PROPERTY, tuple(runs), doc=text(expr, unfold=True))


def _truths(trace: Trace, expr: Expr) -> Values:
    """Whether a conjunct is true after each tick.

    None where that is not known: where a variable has no value, or, in a trace without ``truths``, before
    the last tick if the conjunct speaks of the past.
    """
    for part, known in zip(trace.property.parts, trace.property.truths, strict=False):
        if part is expr:
            return [int(value) for value in known]
    if any(isinstance(node, Temporal) for node in nodes(expr)):
        return [*[None] * (len(trace) - 1), 0][: len(trace)]
    needs, found = variables(expr), list[int | None]()
    for tick in trace.ticks:
        at = {**trace.before, **tick.after, **tick.inputs}
        found.append(int(bool(evaluate(expr, at))) if needs.keys() <= at.keys() else None)
    return found


FEW, CODES = 4, 10
"""A number with at most so many values is shown in bands, not as a line: a measured one, one without unit."""
CONSTANTS = 10
"""So many inputs have a lane even if they never change."""


def timeline(trace: Trace, *, everything: bool = False) -> Timeline:
    """What to draw of a trace: what the property depends on where that is known, or ``everything``.

    Bookkeeping of the property and of charts is never drawn.
    """
    shown = trace if everything or not trace.property.relevant else trace.focused()
    values = {name: _values(shown, name) for name in _names(shown)}
    still = _constant(shown, values)
    limits, spans = thresholds(_compared(trace)), time_limits(trace)
    told = list(folded(shown))
    lanes = [_lane(shown, n, v, limits, spans) for n, v in values.items() if n not in still]
    return Timeline(
        property=trace.property.id,
        text=trace.property.text,
        heading=heading(trace),
        ticks=len(trace),
        clock=trace.clock(),
        lanes=(*sorted(lanes, key=_place(shown)), *parts(trace)),
        constant=tuple(_unchanging(trace, still)),
        quiet=tuple((row.first, row.last) for row in told if isinstance(row, Quiet)),
        repeated=tuple(row for row in told if isinstance(row, RepeatedTicks)),
        loop=trace.loop,
        wrong=tuple(_wrong(trace)),
        ending=ending(trace),
        cause=determined_by(trace),
        because=trace.property.because,
    )


def _names(trace: Trace) -> list[str]:
    """Variables a reader knows, inputs first, without the memory of a chart that it was entered."""
    found = dict.fromkeys((*trace.system.inputs, *trace.before, *(n for t in trace.ticks for n in t.after)))
    entered = {chart.entered.name for chart in trace.system.statecharts.values()}
    return [n for n in found if of_model(trace, n) and n not in entered]


def _values(trace: Trace, name: str) -> Values:
    """The value in each tick: that of the input, or that after the tick, or the frozen one."""
    frozen = trace.before.get(name)
    return [t.inputs[name] if name in t.inputs else t.after.get(name, frozen) for t in trace.ticks]


def _constant(trace: Trace, values: Mapping[str, Values]) -> dict[str, int]:
    """What is the same in every tick, with its value; what the end is about or needs is left out.

    Without knowing which inputs are needed, a few that never change are not left out either.
    """
    kept = {n for expr in trace.property.false_parts for n in variables(expr)}
    kept |= {needed.name for needed in trace.needed()}
    found: dict[str, int] = {}
    for name, raws in values.items():
        seen = set(raws if len(raws) > 1 else [trace.before.get(name), *raws]) - {None}
        if len(seen) == 1 and name not in kept:
            found[name] = next(raw for raw in raws if raw is not None)
    still = [name for name in trace.system.inputs if name in found]
    if trace.necessary is None and len(still) <= CONSTANTS:
        return {n: raw for n, raw in found.items() if n not in still}
    return found


def _unchanging(trace: Trace, still: Mapping[str, int]) -> Iterator[tuple[str, str]]:
    """What never changes, without timers that never start and levels that are never entered."""
    for name in sorted(still):
        shown = value(trace, name, still[name])
        if not (TIMER.search(name) and not still[name]) and shown != NOWHERE:
            yield name, shown


def _compared(trace: Trace) -> Iterator[Expr]:
    """Every formula of the charts, of the function blocks, and of what is false at the end."""
    for chart in trace.system.statecharts.values():
        yield from chart.expressions
    for block in components(trace.system.components):
        if isinstance(block, Block):
            yield from expressions(block.do)
    yield from trace.property.false_parts


def _lane(trace: Trace, name: str, values: Values, limits: Limits, spans: Limits) -> Lane:
    kind = _kind(trace, name)
    if kind is LaneKind.LINE and _flat(trace, name, values, limits.get(name, ())):
        kind = LaneKind.BAND
    bounds = (
        spans.get(name, ())
        if kind is LaneKind.RAMP
        else limits.get(name, ())
        if kind is LaneKind.LINE
        else ()
    )
    return Lane(
        name=name,
        kind=kind,
        group=_group(trace, name),
        runs=tuple(runs(trace, name, values, kind)),
        limits=bounds,
        needed=tuple(_needs(trace, name)),
        shots=tuple(_shots(trace, name)),
        doc=trace.system.variables[name].doc,
    )


def _flat(trace: Trace, name: str, values: Values, limits: Sequence[Limit]) -> bool:
    """Whether a number never changes and is compared with nothing else, so that a line would tell nothing."""
    seen = {*values} - {None}
    return len(seen) == 1 and {trace.show(name, raw) for raw in seen if raw is not None} >= {
        show(limit.value) for limit in limits
    }


def _needs(trace: Trace, name: str) -> Iterator[NeededTicks]:
    """Where an input had to be so, in the words of the story."""
    mine = tuple(needed for needed in trace.needed() if needed.name == name)
    for reason in reasons(replace(trace, necessary=NecessaryInputs(mine, minimal=False))):
        yield NeededTicks(reason.first, reason.last, reason.what)


def _kind(trace: Trace, name: str) -> LaneKind:
    domain = trace.system.variables[name].domain
    if not isinstance(domain.sort, Num):
        return LaneKind.BAND
    if TIMER.search(name):
        return LaneKind.RAMP
    code = not str(domain.sort.unit) and domain.sort.resolution == 1
    return LaneKind.LINE if len(domain) > (CODES if code else FEW) else LaneKind.BAND


def is_location(trace: Trace, name: str) -> bool:
    """Whether the variable holds the active state of a chart."""
    sort = trace.system.variables[name].sort
    return isinstance(sort, Enum) and sort.name.startswith("states of ")


def _group(trace: Trace, name: str) -> LaneGroup:
    if name in trace.system.inputs:
        return LaneGroup.INPUTS
    return LaneGroup.CHARTS if is_location(trace, name) or TIMER.search(name) else LaneGroup.VALUES


def _place(trace: Trace) -> Callable[[Lane], tuple[int, bool, int, bool, int]]:
    """Needed inputs first; charts as they execute, each above its timers; else as the trace names them."""
    order = {name: i for i, name in enumerate(_names(trace))}
    groups, charts = list(LaneGroup), {name: i for i, name in enumerate(trace.system.statecharts)}

    def place(lane: Lane) -> tuple[int, bool, int, bool, int]:
        chart = charts.get(lane.name.partition(".")[0], -1) if lane.group is LaneGroup.CHARTS else -1
        return groups.index(lane.group), not lane.needed, chart, lane.kind is LaneKind.RAMP, order[lane.name]

    return place


def _shots(trace: Trace, name: str) -> Iterator[Shot]:
    """The transitions of a chart, marked on its outermost location; those that keep their state left out."""
    if "." in name or not is_location(trace, name):
        return
    for tick in trace.ticks:
        fired = [a for a in tick.transitions if a.chart == name and a.source != a.target]
        if fired:
            yield Shot(tick.number, "; ".join(_fired(a.source, a.target, a.order, a.label) for a in fired))


def _fired(source: str, target: str, order: int, label: str) -> str:
    start = f"{source} → {target}" if order else f"default → {target}"
    number = f" (transition {order})" if order else ""
    return f"{start}{number} {label}".rstrip()


def _wrong(trace: Trace) -> Iterator[str]:
    """Each part that is false at the end, with the values that make it so."""
    for part in false_parts(trace):
        told = f"{part.name}: {part.formula}" if part.name and part.name != part.formula else part.formula
        values = ", ".join(f"{name} = {shown}" for name, shown in part.values)
        told = f"{part.verdict}: {told}"
        yield f"{told}   ({values})" if values else told
