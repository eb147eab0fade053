"""Two forms of a chart in one: with the condition fixed, each behaves as if the other were not there."""

import pytest
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st

from rovercheck.spec_model.lang.action import assign, send, when
from rovercheck.spec_model.lang.change import (
    ENTERED,
    assigned,
    at_once,
    doing,
    formula,
    formula_of,
    guard_of,
    guards,
    in_state,
    inside,
    lasting,
    then,
    without,
)
from rovercheck.spec_model.lang.chart import Block, Chart, Component, Enabled, Junction, State, Transition, to
from rovercheck.spec_model.lang.domain import integer
from rovercheck.spec_model.lang.edit import in_expressions
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.expr import FALSE, TRUE, Expr, all_of, any_of, const, flag, ite, var
from rovercheck.spec_model.lang.interpret import Interpreter
from rovercheck.spec_model.lang.merge import Merge
from rovercheck.spec_model.lang.specialise import Specialiser
from rovercheck.spec_model.lang.system import System, in_order
from rovercheck.spec_model.lang.time import sec
from rovercheck.spec_model.lang.walk import structure
from rovercheck.spec_model.lang.words import duration, held, named
from tests.profiles import examples
from tests.strategies import input_blocks, systems

switch, a, b, c = flag("switch"), flag("a"), flag("b"), flag("c")
x = var("x", integer(0, 9))
merge = Merge(switch)


def fixing(value: bool) -> Specialiser:
    return Specialiser({"switch": TRUE if value else FALSE})


def same(one: Component, other: Component) -> bool:
    """Nothing in them differs but places and the names of formulas."""
    return Merge(TRUE).components(one, other) == (other,)


# --- any change of any chart -----------------------------------------------------------------------------


def scrambled(data: st.DataObject, chart: Chart) -> Chart:
    """The chart with transitions turned round, dropped and negated, and actions moved, as they come."""

    def arrows(found: tuple[Transition, ...]) -> tuple[Transition, ...]:
        kept = [arrow for arrow in found if data.draw(st.integers(0, 3))]
        return tuple(kept[::-1] if data.draw(st.booleans()) else kept)

    def state(drawn: State) -> State:
        return State(
            drawn.name,
            entry=drawn.entry[::-1] if data.draw(st.booleans()) else drawn.entry,
            during=drawn.during[1:] if data.draw(st.booleans()) else drawn.during,
            exit=(*drawn.exit, *drawn.entry) if data.draw(st.booleans()) else drawn.exit,
            states=[*map(state, drawn.states)],
            transitions=arrows(drawn.transitions),
            junctions=drawn.junctions,
            default=drawn.default,
            parallel=drawn.parallel,
        )

    changed = chart.with_root(state(chart.root))
    if data.draw(st.booleans()):
        return in_expressions(changed, lambda e: ~e if data.draw(st.booleans()) and e.sort == a.sort else e)
    return changed


def runs_alike(one: System, other: System, ticks: list[dict[str, int]]) -> None:
    try:
        second = Interpreter(other)
    except ModelError:
        assume(False)  # the change has taken the meaning from the chart
    first = Interpreter(one)
    for inputs in ticks:
        for run in (first, second):
            run.step({name: inputs[name] for name in run.system.inputs})
        at, expected = first.valuation(), second.valuation()
        assert {n: at[n] for n in at.keys() & expected.keys()} == {
            n: expected[n] for n in at.keys() & expected.keys()
        }


@settings(examples(150), suppress_health_check=list(HealthCheck))
@given(st.data())
def test_each_form_behaves_as_if_it_were_alone(data: st.DataObject) -> None:
    system = data.draw(systems())
    chart = next(iter(system.charts))
    drawn = in_order("drawn", chart)
    changed = in_order("changed", scrambled(data, chart))
    both = in_order("both", *merge.components(changed.charts[0], chart), frozen=[switch])
    idle = dict.fromkeys(drawn.inputs | changed.inputs, 0)
    ticks = [idle | block for block in data.draw(input_blocks(drawn))]
    for value, alone in ((True, changed), (False, drawn)):
        runs_alike(fixing(value).system(both), alone, ticks)


# --- where forms differ ----------------------------------------------------------------------------------

FORMULAS: list[tuple[Expr, Expr, Expr]] = [
    (a & b, a & c, a & ite(switch, b, c)),
    (a | b, a, any_of(a, all_of(switch, b))),
    (a, a & b, all_of(a, any_of(switch, b))),
    (TRUE, a & b, ite(switch, TRUE, a & b)),
    (~(x > 3), ~(x > 4), ~ite(switch, x > 3, x > 4)),
    (named("n", a), named("n", b), named("n", ite(switch, a, b))),
    (named("n", a), named("m", b), ite(switch, named("n", a), named("m", b))),
    (held(a & b, for_=1 * sec), held(a, for_=1 * sec), held(all_of(a, any_of(~switch, b)), for_=1 * sec)),
    (held(a, for_=2 * sec), held(a, for_=1 * sec), ite(switch, held(a, for_=2 * sec), held(a, for_=1 * sec))),
]


@pytest.mark.parametrize(("changed", "drawn", "both"), FORMULAS, ids=[str(f[2]) for f in FORMULAS])
def test_formulas_are_told_apart_at_the_difference(changed: Expr, drawn: Expr, both: Expr) -> None:
    assert structure(merge.formula(changed, drawn)) == structure(both)
    assert merge.formula(drawn, drawn) is drawn


def test_what_is_alike_stays_the_object_that_it_is() -> None:
    chart = Chart("C", [State("S", entry=[assign(x, 1)], transitions=[to("S", when=a)])])
    again = Chart("C", [State("S", entry=[assign(x, 1)], transitions=[to("S", when=named("n", a))])])
    assert merge.components(again, chart) == (chart,)


def test_a_subsystem_and_a_block_beside_a_part() -> None:
    chart, block = Chart("C", [State("S")]), Block("B", [assign(x, 1)])
    [enabled] = merge.components(Enabled(a, chart), chart)
    assert isinstance(enabled, Enabled) and structure(enabled.by) == structure(~switch | a)
    beside, part = merge.components((block, chart), chart)
    assert part is chart and same(beside, Block("B", [when(switch, [assign(x, 1)])]))


def test_a_form_with_other_states_is_refused() -> None:
    with pytest.raises(ModelError, match="would have other states"):
        merge.components(Chart("C", [State("T")]), Chart("C", [State("S")]))
    with pytest.raises(ModelError, match="would become"):
        merge.components(Chart("D", [State("S")]), Block("B", []))


# --- changes that say what they replace --------------------------------------------------------------------

CHART = Chart(
    "C",
    [
        State("S", entry=[assign(x, x + 1)], transitions=[
            to("T", when=named("late", duration(a & b) > 3 * sec)), to("J", do=[send("e", "T")]),
        ]),
        State("T", transitions=[to("S", when=duration(b) > 2 * sec)]),
    ],
    default=[to("J"), to("T")],
    junctions=[Junction("J", [to("S", when=x > 3)])],
)  # fmt: skip


def test_changes_meet_what_they_name() -> None:
    assert str(guard_of(formula(b, c)(CHART), "T", "S")) == "duration(c) > 2 s"
    assert str(guard_of(formula("late", a)(CHART), "S", "T")) == "a"
    assert str(guard_of(guards("J", "S", inside(x > 3, x > 4))(CHART), "J", "S")) == "x > 4"
    assert str(guard_of(guards("T", "S", at_once)(CHART), "T", "S")) == "b"
    both = guards("T", "S", lasting(lambda condition: condition & c))(CHART)
    assert str(guard_of(both, "T", "S")) == "duration(b && c) > 2 s"
    assert guard_of(CHART, "S", "J") is TRUE
    assert [t.target for t in without("S", "J")(CHART).states["S",].transitions] == ["T"]
    assert [str(t.guard) for t in guards(ENTERED, "J", lambda _: a)(CHART).root.default] == ["a", "None"]
    assert str(formula_of(CHART, "late").body) == "duration(a && b) > 3 s"
    later = doing("S", "J", then(assign(x, 0)))(CHART)
    assert [*map(str, later.states["S",].transitions[1].do)] == ["send(e, T)", "x := 0"]
    longer = in_state("T", exit=then(assign(x, 0)))(assigned(x, lambda value: value + 1)(CHART))
    assert [*map(str, longer.states["T",].exit)] == ["x := 0"]
    assert [*map(str, longer.states["S",].entry)] == ["x := x + 1 + 1"]


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (formula(x > 7, a), "C has no formula `x > 7` any more."),
        (formula("early", a), "C has no formula `early` any more."),
        (guards("S", "S", lambda g: g), "No transition leads from S to S any more."),
        (without("J", "T"), "No transition leads from J to T any more."),
        (doing("T", "J", then()), "No transition leads from T to J any more."),
        (guards("J", "S", at_once), "`x > 3` is no duration."),
        (guards("J", "S", inside(a, b)), "`x > 3` has no formula `a` any more."),
        (guards("U", "S", lambda g: g), "C has no state 'U'."),
        (assigned(var("y", integer(0, 1)), lambda v: v), "C does not assign y any more."),
        (lambda chart: formula_of(chart, "early"), "C has no formula `early` any more."),
        (formula(x, const(3) * x * const("0.5")), "is counted in other steps"),
    ],
)
def test_a_change_that_does_not_fit_is_refused(change: object, message: str) -> None:
    with pytest.raises(ModelError) as refused:
        change(CHART)  # type: ignore[operator]
    assert message in str(refused.value)
