"""Hypothesis strategies for whole systems of charts and for their inputs.

``systems()`` draws systems that have a meaning: one to three charts and blocks in order, some in an
enabled subsystem.  ``input_blocks(system)`` draws inputs that are held for some ticks, because
timers are seldom met by inputs that change in every tick.
"""

from hypothesis import strategies as st
from hypothesis.strategies import DrawFn

from spec_model.lang.chart import Block, Chart, Component, Enabled
from spec_model.lang.domain import boolean, fixed, integer
from spec_model.lang.expr import Expr, Var, flag, var
from spec_model.lang.system import System, in_order
from tests.random_charts import charts
from tests.random_formulas import DOMAINS, MODE, Source

INPUTS = (
    flag("in_flag"), flag("in_button"), var("in_mode", MODE), var("in_count", integer(-2, 4)),
    var("in_ratio", fixed(0, 2, 0.5)),
)  # fmt: skip
FROZEN = (var("reading", integer(0, 2)), Var("choice", boolean, 1))


@st.composite
def systems(draw: DrawFn) -> System:
    """A random system that passes ``check_system``."""
    count = 1 + draw(st.integers(0, 2))
    data = [[_datum(draw, f"d{c}{i}") for i in range(1 + draw(st.integers(0, 2)))] for c in range(count)]
    places: list[Expr] = []
    made: list[Component] = []
    for number in range(count):
        others = [v for other, owned in enumerate(data) if other != number for v in owned]
        steady = [*INPUTS, *others, *FROZEN]
        source = Source(draw, [*data[number], *data[number], *steady], steady, places)
        part = _part(source, number, data[number])
        if isinstance(part, Chart):
            places += [part.active_path(p) for p in part.states if p]
        made.append(part)
    return in_order("Random", *_some_enabled(draw, made, data), frozen=FROZEN)


def _datum(draw: DrawFn, name: str) -> Var:
    domain = DOMAINS[draw(st.integers(0, len(DOMAINS) - 1))]
    return Var(name, domain, domain.values[draw(st.integers(0, len(domain) - 1))])


def _part(source: Source, number: int, data: list[Var]) -> Component:
    if number and source.chance(4):
        return Block(f"Block{number}", [source.assignment(data, words=False), *source.actions(data, 3, words=False)])
    return charts(source, f"Chart{number}", data, [_datum(source.draw, f"local{number}")])


def _some_enabled(draw: DrawFn, made: list[Component], data: list[list[Var]]) -> list[Component]:
    """The last components, perhaps, inside an enabled subsystem, or in two nested ones."""
    first = draw(st.integers(0, len(made) + 1))
    if first >= len(made):
        return made
    scope = [*INPUTS, *(v for owned in data for v in owned)]
    source = Source(draw, scope, scope, [])
    inner: list[Component] = made[first:]
    if len(inner) > 1 and source.chance(3):
        inner = [inner[0], Enabled(source.condition(scope, 0), *inner[1:])]
    return [*made[:first], Enabled(source.condition(scope, 1), *inner)]


@st.composite
def input_blocks(draw: DrawFn, system: System, least: int = 30, most: int = 60) -> list[dict[str, int]]:
    """The inputs of each tick: values that stay for 1 to 8 ticks, some changing alone."""
    length = draw(st.integers(least, most))
    names = list(system.inputs)
    ticks: list[dict[str, int]] = []
    now = {n: draw(_raw(v)) for n, v in system.inputs.items()}
    while len(ticks) < length:
        ticks += [dict(now)] * draw(st.integers(1, 8))
        for name in names:
            if draw(st.booleans()):
                now[name] = draw(_raw(system.inputs[name]))
    return ticks[:length]


def _raw(v: Var) -> st.SearchStrategy[int]:
    return st.sampled_from(v.domain.values)


def frozen_values(system: System) -> st.SearchStrategy[dict[str, int]]:
    """A value for each frozen variable."""
    return st.fixed_dictionaries({v.name: _raw(v) for v in system.frozen})
