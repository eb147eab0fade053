"""What a count is waiting for: the time that a guard compares a timer with, the bound of a counted number."""

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from rovercheck.checker.render.durations import duration
from rovercheck.checker.results.trace import Trace
from rovercheck.spec_model.lang.chart import Chart, State
from rovercheck.spec_model.lang.domain import Num, show
from rovercheck.spec_model.lang.expr import Apply, Const, Expr, Temporal, Var, When
from rovercheck.spec_model.lang.operators import Op
from rovercheck.spec_model.lang.walk import nodes, plain, structure

_COUNTER = re.compile(r"(?P<place>.+)\.(?P<word>after|duration|held)(?P<number>\d*)")
_MIRRORED = {Op.LT: Op.GT, Op.LE: Op.GE, Op.GT: Op.LT, Op.GE: Op.LE}


@dataclass(frozen=True)
class Timer:
    """The time that a counter of steps stands for, and what it is compared with (``> 3 s``)."""

    step_ms: int
    limit: str

    def shown(self, raw: int) -> str:
        """So many steps as a time."""
        return duration(raw * self.step_ms)


def timer(trace: Trace, name: str) -> Timer | None:
    """What the counter of that name, made by lowering, is for; None if no chart of the trace says."""
    found = _COUNTER.fullmatch(name)
    if found is None:
        return None
    chart_name, *path = found["place"].split(".")
    chart = trace.system.statecharts.get(chart_name)
    words = list(_words(chart, tuple(path), When(found["word"]))) if chart else []
    if not words:
        return None
    if found["number"]:
        words = words[int(found["number"]) - 1 :][:1]
    return _timer(words, trace.system.variables[name].domain.high)


def _timer(words: list[Temporal], top: int) -> Timer | None:
    """The longest of some words; ``top`` is where its counter stops."""
    spans = [w.span for w in words if w.span is not None and w.span.unit == "ms"]
    if not spans:
        return None
    longest = max(spans, key=lambda span: span.amount)
    word = next(w for w in words if w.span is longest)
    steps = top - (word.strict or word.when is When.HELD)
    if steps <= 0 or longest.amount % steps:
        return None
    return Timer(int(longest.amount / steps), f"{'> ' if word.strict else ''}{longest}")


def _words(chart: Chart, path: tuple[str, ...], when: When) -> Iterator[Temporal]:
    """The temporal words of a state, or of the chart, each once, in the order in which they are numbered."""
    seen = set[tuple[object, ...]]()
    for expr in chart.expressions if when is When.HELD else _guards(chart, path):
        for node in nodes(expr):
            if isinstance(node, Temporal) and node.when is when and structure(node) not in seen:
                seen.add(structure(node))
                yield node


def _guards(chart: Chart, path: tuple[str, ...]) -> Iterator[Expr]:
    """The guards on transitions that leave a state, and further on behind junctions."""
    state: State | None = chart.states.get(path)
    transitions = [(path[:-1], t) for t in state.transitions] if state else []
    seen = set[tuple[str, ...]]()
    while transitions:
        level, transition = transitions.pop()
        if transition.guard is not None:
            yield transition.guard
        target = chart.resolve(level, transition.target)
        if target in chart.junctions and target not in seen:
            seen.add(target)
            transitions += [(target[:-1], t) for t in chart.junctions[target].transitions]


def bounds(trace: Trace) -> Mapping[str, tuple[tuple[int, str], ...]]:
    """What guards compare numbers with: for each variable values, ascending, and how it is written."""
    found: dict[str, dict[int, str]] = {}
    for chart in trace.system.statecharts.values():
        for node in nodes(*chart.expressions):
            for name, raw, shown in _compared(node):
                if name in trace.system.variables:
                    found.setdefault(name, {}).setdefault(raw, shown)
    return {name: tuple(sorted(of.items())) for name, of in found.items()}


def _compared(node: Expr) -> Iterator[tuple[str, int, str]]:
    """The variable, the bound and the text of a comparison of a number with a constant."""
    if not isinstance(node, Apply) or node.op not in _MIRRORED:
        return
    left, right = (plain(a) for a in node.args)
    for variable, bound, op in ((left, right, node.op), (right, left, _MIRRORED[node.op])):
        if not isinstance(variable, Var) or not isinstance(bound, Const):
            continue
        own, other = variable.sort, bound.sort
        if isinstance(own, Num) and isinstance(other, Num) and own.resolution == other.resolution:
            unit = f" {own.unit}".rstrip()
            yield variable.name, bound.value, f"{op.value} {show(bound.value * own.resolution)}{unit}"
