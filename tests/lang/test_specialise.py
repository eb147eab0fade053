"""Fixing a variable: alternatives fold away, and what is left behaves as the model with that value."""

from hypothesis import given
from hypothesis import strategies as st

from rovercheck.spec_model.lang.action import assign, when
from rovercheck.spec_model.lang.chart import Block, Chart, Enabled, Junction, State, to
from rovercheck.spec_model.lang.domain import integer
from rovercheck.spec_model.lang.expr import Const, Expr, flag, ite, var
from rovercheck.spec_model.lang.interpret import Interpreter
from rovercheck.spec_model.lang.specialise import Specialiser
from rovercheck.spec_model.lang.system import in_order
from rovercheck.spec_model.lang.time import tick
from rovercheck.spec_model.lang.walk import variables
from rovercheck.spec_model.lang.words import after, held, named, once

switch, a, b = flag("switch"), flag("a"), flag("b")
n, log = var("n", integer(0, 3)), var("log", integer(0, 99))


def fixing(value: int) -> Specialiser:
    return Specialiser({"switch": Const(value, switch.sort)})


def folded(expr: Expr, value: int) -> str:
    return str(fixing(value).expr(expr))


def test_formulas_fold() -> None:
    assert folded(switch & a, 1) == "a"
    assert folded(switch & a, 0) == "false"
    assert folded(switch | a, 1) == "true"
    assert folded(~switch | b, 1) == "b"
    assert folded(ite(switch, n + 1, n), 1) == "n + 1"
    assert folded(named("which", ite(switch, a & b, a | b)), 0) == "which"
    assert folded(held(switch & a, for_=2 * tick), 0) == "false"
    assert folded(once(switch | a), 1) == "true"


def test_a_formula_without_the_variable_is_itself() -> None:
    formula = named("both", a & b) | held(a, for_=2 * tick)
    assert fixing(1).expr(formula) is formula


def swapped() -> Chart:
    """Two transitions whose order depends on the switch, and a junction that only one order needs."""
    return Chart(
        "C",
        [
            State(
                "A",
                transitions=[to("J", when=~switch & a), to("B", when=b), to("C", when=switch & a)],
                during=[when(switch, [assign(log, 1)], [assign(log, 2)])],
            ),
            State("B", transitions=[to("A", when=after(1 * tick))]),
            State("C"),
        ],
        default="A",
        junctions=[Junction("J", [to("C")])],
    )


def test_transitions_that_can_never_be_taken_disappear_and_states_stay() -> None:
    chart = fixing(1).chart(swapped())
    assert [t.target for t in chart.states[("A",)].transitions] == ["B", "C"]
    assert not chart.junctions
    assert list(chart.states) == list(swapped().states)
    other = fixing(0).chart(swapped())
    assert [t.target for t in other.states[("A",)].transitions] == ["J", "B"]
    assert list(other.junctions) == [("J",)]


def test_blocks_and_subsystems_with_nothing_left_disappear() -> None:
    block = Block("Only", [when(switch, [assign(log, 3)])])
    system = in_order("S", block, Enabled(switch & a, Block("Inside", [assign(log, 4)])))
    assert fixing(0).system(system).components == ()
    kept = fixing(1).system(system).components
    assert [type(part).__name__ for part in kept] == ["Block", "Enabled"]


@given(st.lists(st.tuples(st.booleans(), st.booleans()), max_size=12), st.booleans())
def test_the_fixed_model_behaves_as_the_model_with_that_value(
    inputs: list[tuple[bool, bool]], value: bool
) -> None:
    whole = in_order("S", swapped(), frozen=[switch])
    fixed = fixing(value).system(whole)
    assert not variables(*(e for c in fixed.charts for e in c.expressions)).keys() & {"switch"}
    runs = Interpreter(whole, {"switch": int(value)}), Interpreter(fixed)
    for of_a, of_b in inputs:
        for run in runs:
            run.step({"a": int(of_a), "b": int(of_b)})
        first, second = (run.valuation() for run in runs)
        assert {k: v for k, v in first.items() if k in second and k != "switch"} == {
            k: v for k, v in second.items() if k in first
        }
