"""Hypothesis strategies for whole systems of charts and for their inputs.

``systems()`` draws systems that have a meaning: one to three charts and blocks in order, some in an
enabled subsystem.  ``input_blocks(system)`` draws inputs that are held for some ticks, because
timers are seldom met by inputs that change in every tick.
"""

from hypothesis import strategies as st
from hypothesis.strategies import DrawFn

from rovercheck.spec_model.lang.chart import Block, Chart, Component, Enabled
from rovercheck.spec_model.lang.domain import boolean, fixed, integer
from rovercheck.spec_model.lang.expr import Expr, Var, flag, var
from rovercheck.spec_model.lang.system import System, in_order
from tests.random_charts import charts
from tests.random_formulas import DOMAINS, MODE, Choices, Source

INPUTS = (
    flag("in_flag"), flag("in_button"), var("in_mode", MODE), var("in_count", integer(-2, 4)),
    var("in_ratio", fixed(0, 2, 0.5)),
)  # fmt: skip
FROZEN = (var("reading", integer(0, 2)), Var("choice", boolean, 1))


@st.composite
def systems(draw: DrawFn) -> System:
    """A random system that passes ``check_system``."""
    choices = Choices(draw)
    count = 1 + choices.below(3)
    data = [[a_datum(choices, f"d{c}{i}") for i in range(1 + choices.below(3))] for c in range(count)]
    places: list[Expr] = []
    made: list[Component] = []
    for number in range(count):
        others = [v for other, owned in enumerate(data) if other != number for v in owned]
        steady = [*INPUTS, *others, *FROZEN]
        source = Source(choices, [*data[number], *data[number], *steady], steady, places)
        part = a_part(source, number, data[number])
        if isinstance(part, Chart):
            places += [part.active_path(p) for p in part.states if p]
        made.append(part)
    return in_order("Random", *_some_enabled(choices, made, data), frozen=FROZEN)


def a_datum(choices: Choices, name: str) -> Var:
    """A variable of some domain."""
    domain = choices.pick(DOMAINS)
    return Var(name, domain, choices.pick(domain.values))


def a_part(source: Source, number: int, data: list[Var]) -> Component:
    """A chart, or a block, that writes the data."""
    if number and source.chance(4):
        return Block(
            f"Block{number}", [source.assignment(data, words=False), *source.actions(data, 3, words=False)]
        )
    return charts(source, f"Chart{number}", data, [a_datum(source.choices, f"local{number}")])


def _some_enabled(choices: Choices, made: list[Component], data: list[list[Var]]) -> list[Component]:
    """The last components, perhaps, inside an enabled subsystem, or in two nested ones."""
    first = choices.below(len(made) + 2)
    if first >= len(made):
        return made
    scope = [*INPUTS, *(v for owned in data for v in owned)]
    source = Source(choices, scope, scope)
    inner: list[Component] = made[first:]
    if len(inner) > 1 and source.chance(3):
        inner = [inner[0], Enabled(source.condition(scope, 0), *inner[1:])]
    return [*made[:first], Enabled(source.condition(scope, 1), *inner)]


@st.composite
def input_blocks(draw: DrawFn, system: System, least: int = 30, most: int = 60) -> list[dict[str, int]]:
    """The inputs of each tick: values that stay for 1 to 8 ticks, some changing alone."""
    choices = Choices(draw)
    length = least + choices.below(most - least + 1)
    now = {n: choices.pick(v.domain.values) for n, v in system.inputs.items()}
    ticks: list[dict[str, int]] = []
    while len(ticks) < length:
        ticks += [dict(now)] * (1 + choices.below(8))
        changed = [v for v in system.inputs.values() if choices.chance(2)]
        now |= {v.name: choices.pick(v.domain.values) for v in changed}
    return ticks[:length]


def frozen_values(system: System) -> st.SearchStrategy[dict[str, int]]:
    """A value for each frozen variable."""
    return st.fixed_dictionaries({v.name: st.sampled_from(v.domain.values) for v in system.frozen})
