"""The constants with which charts, blocks and the property compare a number: thresholds and time limits."""

from collections.abc import Iterable, Iterator, Mapping
from fractions import Fraction

from rovercheck.checker.render.limits import timer
from rovercheck.checker.render.timeline.model import Limit
from rovercheck.checker.results.trace import Trace
from rovercheck.spec_model.lang.chart import Chart, Path
from rovercheck.spec_model.lang.domain import Num, show
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.expr import Apply, Const, Expr, Temporal, Var, When
from rovercheck.spec_model.lang.lower.timers import ChartTimers
from rovercheck.spec_model.lang.operators import COMPARISONS, Op
from rovercheck.spec_model.lang.walk import nodes, plain

Limits = Mapping[str, tuple[Limit, ...]]


def thresholds(exprs: Iterable[Expr]) -> Limits:
    """By the name of a variable, the constants with which these formulas compare it, in its own unit."""
    found: dict[str, set[Fraction]] = {}
    units: dict[str, str] = {}
    for expr in nodes(*exprs):
        if isinstance(expr, Apply) and expr.op in COMPARISONS:
            for variable, value in _compared(*expr.args):
                found.setdefault(variable.name, set()).add(value)
                units[variable.name] = _unit(variable)
    return {
        name: tuple(Limit(value, f"{show(value)} {units[name]}".rstrip()) for value in sorted(values))
        for name, values in found.items()
    }


def _unit(variable: Var) -> str:
    return str(variable.sort.unit) if isinstance(variable.sort, Num) else ""


def _compared(left: Expr, right: Expr) -> Iterator[tuple[Var, Fraction]]:
    """The variable and the constant that are compared; an absolute value has two limits."""
    for term, bound in ((plain(left), plain(right)), (plain(right), plain(left))):
        if not (isinstance(bound, Const) and isinstance(bound.sort, Num)):
            continue
        value = bound.value * bound.sort.resolution
        term, both = _inside(term)
        if isinstance(term, Var):
            yield term, value
            if both:
                yield term, -value


def _inside(term: Expr) -> tuple[Expr, bool]:
    """What is compared under a change of resolution and ``abs``; whether ``abs`` was there."""
    both = False
    while isinstance(term, Apply) and term.op in (Op.SCALE, Op.ABS):
        both |= term.op is Op.ABS
        term = plain(term.args[0])
    return term, both


def time_limits(trace: Trace) -> Limits:
    """By the name of a counter, the spans of ``after``, ``duration`` and ``held``, in its own steps."""
    steps = {
        name.partition(".")[0]: known.step_ms
        for name in trace.system.variables
        if (known := timer(trace, name))
    }
    found: dict[str, set[tuple[Fraction, str]]] = {}
    for chart, step_ms in steps.items():
        for counter, word in _timed(trace.system.statecharts[chart], step_ms):
            mine = trace.system.variables.get(counter.name)
            if word.span is not None and mine is not None and mine.domain == counter.domain:
                limit = (Fraction(word.span.ticks(step_ms)), str(word.span))
                found.setdefault(counter.name, set()).add(limit)
    return {n: tuple(Limit(v, text) for v, text in sorted(pairs)) for n, pairs in found.items()}


def _timed(chart: Chart, step_ms: int) -> Iterator[tuple[Var, Temporal]]:
    """Every counter of the chart with each temporal word that reads it."""
    try:
        timers = ChartTimers(chart, step_ms)
    except ModelError:  # a span is no whole number of these steps: the chart executes in others
        return
    for word, counter in timers.helds.values():
        yield counter, word
    for durations in timers.durations.values():
        yield from ((counter, word) for word, counter in durations.values())
    for path, counter in timers.after.items():
        for asked in nodes(*_leaving(chart, path)):
            if isinstance(asked, Temporal) and asked.when is When.AFTER:
                yield counter, asked


def _leaving(chart: Chart, path: Path) -> Iterator[Expr]:
    """The guards on the transitions that leave a state, and on those of the junctions they lead to."""
    seen: set[Path] = set()
    stack = [(path[:-1], transition) for transition in chart.states[path].transitions]
    while stack:
        level, transition = stack.pop()
        if transition.guard is not None:
            yield transition.guard
        target = chart.resolve(level, transition.target)
        if target in chart.junctions and target not in seen:
            seen.add(target)
            stack += [(target[:-1], onward) for onward in chart.junctions[target].transitions]
