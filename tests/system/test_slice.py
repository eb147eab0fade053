"""Slicing: what remains decides the goals as the whole does, and nothing else remains."""

from dataclasses import replace

from hypothesis import given

from rovercheck.checker.system.slice import sliced
from rovercheck.spec_model.lang.action import Assign, If
from rovercheck.spec_model.lang.domain import integer
from rovercheck.spec_model.lang.expr import FALSE, TRUE, Expr, Var, flag, ite, var
from rovercheck.spec_model.lang.system import Program, TransitionSystem
from rovercheck.spec_model.lang.words import minimum
from tests.naive import projected, search
from tests.strategies_ts import goals, transition_systems

A, B, C = (var(n, integer(0, 5)) for n in "abc")
P, Q, R = (flag(n) for n in "pqr")
I, J, K = (var(n, integer(0, 9)) for n in "ijk")  # noqa: E741
GOAL = flag("goal")


def system(step: Program, assume: Expr = TRUE, frozen: tuple[Var, ...] = ()) -> TransitionSystem:
    return TransitionSystem("", (I, J, K), frozen, (A, B, C, P, Q, R, GOAL), (), step, assume)


def named(variables: tuple[Var, ...]) -> str:
    return " ".join(v.name for v in variables)


def test_a_wire_is_no_part_of_the_valuation() -> None:
    part = sliced(system((Assign(P, I > 3), Assign(Q, P & (J > 2)), Assign(GOAL, Q))), [GOAL])
    assert (named(part.variables), named(part.temps), named(part.inputs)) == ("", "p q goal", "i j")


def test_what_is_read_before_it_is_written_belongs_to_it() -> None:
    part = sliced(system((Assign(GOAL, P), Assign(P, I > 3), Assign(A, minimum(A + 1, 5)))), [GOAL])
    assert (named(part.variables), named(part.inputs), len(part.step)) == ("p", "i", 2)


def test_a_variable_written_on_one_branch_only_is_remembered() -> None:
    part = sliced(system((If(I > 3, (Assign(GOAL, TRUE),)),)), [GOAL])
    assert named(part.variables) == "goal"
    both = (If(I > 3, (Assign(GOAL, TRUE),), (Assign(GOAL, FALSE),)),)
    assert named(sliced(system(both), [GOAL]).variables) == ""


def test_needs_are_followed_from_tick_to_tick() -> None:
    step = (Assign(GOAL, A > 3), Assign(A, B), Assign(B, C), Assign(C, ite(Q, 1, 2)), Assign(R, P))
    assert named(sliced(system(step), [GOAL]).variables) == "a b c q"


def test_branches_without_effect_are_removed() -> None:
    step = (If(P, (Assign(A, B), If(Q, (Assign(R, TRUE),)))), Assign(GOAL, C > 2))
    part = sliced(system(step), [GOAL])
    assert named(part.variables) == "c" and len(part.step) == 1


def test_a_store_that_is_overwritten_is_removed() -> None:
    part = sliced(system((Assign(GOAL, P), Assign(GOAL, Q))), [GOAL])
    assert named(part.variables) == "q" and len(part.step) == 1


def test_several_goals_share_one_slice() -> None:
    part = sliced(system((Assign(P, A > 2), Assign(Q, B > 2), Assign(R, C > 2))), [P, R])
    assert named(part.variables) == "a c"


def test_frozen_variables_stay_if_needed() -> None:
    f, g = var("f", integer(0, 3)), var("g", integer(0, 3))
    part = sliced(system((Assign(GOAL, f > 2), Assign(P, g > 1)), frozen=(f, g)), [GOAL])
    assert named(part.frozen) == "f" and named(part.variables) == ""


def test_an_assumption_on_needed_inputs_stays() -> None:
    step = (Assign(GOAL, I > 3),)
    assert named(sliced(system(step, I < J), [GOAL]).inputs) == "i j"
    assert named(sliced(system(step, (I < J) & (J < K)), [GOAL]).inputs) == "i j k"


def test_an_assumption_on_other_inputs_goes_if_it_can_always_be_met() -> None:
    step = (Assign(GOAL, I > 3),)
    part = sliced(system(step, (J > 3) & (K < J) & (I > 1)), [GOAL])
    assert named(part.inputs) == "i"
    part = sliced(system(step, (J > A) & (J < 9)), [GOAL])
    assert named(part.inputs) == "i" and named(part.variables) == ""


def test_an_assumption_that_may_block_stays() -> None:
    step = (Assign(GOAL, I > 3), Assign(A, minimum(A + 1, 5)))
    assert named(sliced(system(step, J + 5 < A), [GOAL]).variables) == "a"
    assert named(sliced(system(step, A < 3), [GOAL]).variables) == "a"


@given(transition_systems())
def test_the_slice_reaches_what_the_whole_reaches(whole: TransitionSystem) -> None:
    wanted = goals(whole)
    all_of_it = search(whole, wanted)
    for some in (wanted, wanted[:1]):
        part = sliced(whole, some)
        kept = [v.name for v in (*part.frozen, *part.variables)]
        of_slice = search(_showing(part, some), some)
        assert of_slice.reached == {n: t for n, t in all_of_it.reached.items() if n in {g.name for g in some}}
        assert projected(of_slice.states, kept) == projected(all_of_it.states, kept)


def _showing(part: TransitionSystem, some: tuple[Var, ...]) -> TransitionSystem:
    """The slice with goals that are wires among its variables."""
    wires = tuple(g for g in some if g.name in {t.name for t in part.temps})
    temps = tuple(t for t in part.temps if t.name not in {g.name for g in wires})
    return replace(part, variables=(*part.variables, *wires), temps=temps)
