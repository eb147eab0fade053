"""Symbolic search against a naive search: answers, shortest runs, and the very set of states."""

from dataclasses import replace
from itertools import product

import pytest
from hypothesis import given
from hypothesis import strategies as st

from benchmarks.roverlite import roverlite
from rovercheck.checker.encode.bits import circuit
from rovercheck.checker.encode.bits.inputs import input_cut
from rovercheck.checker.encode.bits.order import orders
from rovercheck.checker.engines import Limits, bdd, engines, quiet
from rovercheck.checker.engines.bdd import search as kept
from rovercheck.checker.engines.bdd.search import search
from rovercheck.checker.results.diagram import Diagram
from rovercheck.checker.results.verdict import Answer, Exhausted, Open, Reached, Run, Unreachable
from rovercheck.checker.search import DepthSearched, GoalReached, GoalsExcluded, GoalsLeftOpen
from rovercheck.spec_model.lang.action import Assign, If
from rovercheck.spec_model.lang.domain import Bool, chosen, integer
from rovercheck.spec_model.lang.expr import FALSE, TRUE, Apply, Var, all_of, const, flag, ite, var
from rovercheck.spec_model.lang.operators import Op
from rovercheck.spec_model.lang.system import TransitionSystem
from rovercheck.spec_model.lang.words import minimum
from tests import naive
from tests.engine_children import LIMIT, cut_off
from tests.profiles import examples
from tests.strategies_ts import goals, transition_systems

NODES = 1 << 18
UNLIMITED = Limits()


def searched(system: TransitionSystem, *names: str, most: int | None = None) -> dict[str, Answer]:
    """What the events of a search in this process add up to."""
    found: dict[str, Answer] = {}
    deep = dict.fromkeys(names, 0)
    for event in search(system, names, most, NODES):
        match event:
            case GoalReached(goal, run):
                found[goal] = Reached(run)
            case GoalsExcluded(left, because):
                found |= dict.fromkeys(left, Unreachable(because))
            case GoalsLeftOpen(left, reason):
                found |= {g: Open(reason, deep[g]) for g in left}
            case DepthSearched(left, depth):
                deep |= dict.fromkeys(left, depth)
    return {n: found.get(n, Open("", deep[n])) for n in names}


def check(system: TransitionSystem, wanted: Var, limits: Limits = UNLIMITED) -> Answer:
    return bdd.check(system, [wanted], limits, quiet)[wanted.name]


def agrees(system: TransitionSystem, names: list[str], expected: naive.Searched) -> None:
    """Answers, lengths, the runs themselves, the number of states, and which ones they are."""
    for name, answer in searched(system, *names).items():
        match answer:
            case Reached(run, True):
                assert len(run) == expected.reached[name]
                assert naive.replay(system, run)[-1][name]
            case Unreachable(Exhausted() as because):
                assert name not in expected.reached
                assert because.states == len(naive.projected(expected.states, because.variables))
                assert because.diagram is not None
                holds_exactly(because.diagram, system, because, expected)
            case _:
                raise AssertionError(answer)


def holds_exactly(
    diagram: Diagram, system: TransitionSystem, because: Exhausted, expected: naive.Searched
) -> None:
    """Of the states of its variables, those that are reachable belong to the diagram and no others."""
    names = {*because.variables, *diagram.variables}
    own = [v for v in (*system.frozen, *system.variables) if v.name in names]
    reachable = naive.projected(expected.states, [v.name for v in own])
    for at in naive.vectors(own):
        state = tuple((v.name, at[v.name]) for v in (*system.frozen, *system.variables) if v.name in names)
        assert (at in diagram) == (state in reachable)


@examples(150)
@given(transition_systems())
def test_random_systems(system: TransitionSystem) -> None:
    agrees(system, [g.name for g in goals(system)], naive.search(system, goals(system)))


@examples(60)
@given(transition_systems())
def test_random_systems_goal_by_goal(system: TransitionSystem) -> None:
    expected = naive.search(system, goals(system))
    for goal in goals(system):
        agrees(system, [goal.name], expected)


@examples(60)
@given(transition_systems(), st.integers(0, 3))
def test_a_depth_limit_never_proves_more_than_was_seen(system: TransitionSystem, most: int) -> None:
    names = [g.name for g in goals(system)]
    expected = naive.search(system, goals(system))
    for name, answer in searched(system, *names, most=most).items():
        first = expected.reached.get(name)
        assert isinstance(answer, Reached) == (first is not None and first <= most)
        assert not isinstance(answer, Open) or answer.depth == most
        assert not isinstance(answer, Unreachable) or first is None


@examples(60)
@given(transition_systems())
def test_an_order_has_every_variable_once(system: TransitionSystem) -> None:
    made = circuit(system, [g.name for g in goals(system)])
    names = {bit.var.name for bit in (*(x.bit for x in made.latches), *made.inputs)}
    for order in orders(made):
        assert len(order) == len(names) and set(order) == names


# --- known answers ------------------------------------------------------------------------------------


@pytest.mark.parametrize(("comp", "k", "states"), [(3, 1, 50_904), (28, 1, 3_101_048), (31, 10, 2_383_722)])
def test_parts_of_roverlite(comp: int, k: int, states: int) -> None:
    system, _ = roverlite(comp, k)
    broken = searched(system, "broken")["broken"]
    assert isinstance(broken, Unreachable) and isinstance(broken.because, Exhausted)
    assert broken.because.states == states


def test_a_deep_run_to_where_two_counters_lead() -> None:
    system, _ = roverlite(85)
    deep = searched(system, "P5")["P5"]
    assert isinstance(deep, Reached) and len(deep.run) == 406
    assert naive.replay(system, deep.run)[-1]["P5"]


def counters(*sizes: int) -> tuple[TransitionSystem, Var, Var]:
    """Counters that an input each lets go on; all of them at their ends, and never."""
    own = [var(f"count{i}", integer(0, size)) for i, size in enumerate(sizes)]
    inputs = [flag(f"go{i}") for i in range(len(sizes))]
    end, never = flag("end"), flag("never")
    full = all_of(*(c == n for c, n in zip(own, sizes, strict=True)))
    step = [Assign(c, ite(go & (c < n), c + 1, c)) for c, n, go in zip(own, sizes, inputs, strict=True)]
    step += [Assign(end, full), Assign(never, full & (own[0] == 0))]
    return TransitionSystem("counters", tuple(inputs), (), (*own, end, never), (), tuple(step)), end, never


def test_more_valuations_than_could_be_visited() -> None:
    system, _, never = counters(*[20] * 12)
    answer = check(system, never)
    assert isinstance(answer, Unreachable) and isinstance(answer.because, Exhausted)
    assert answer.because.states == 21**12 and answer.because.depth == 12 * 20 - 220


def test_the_same_question_has_the_same_answer() -> None:
    system, _ = roverlite(4, 10)
    system = replace(system, assume=TRUE)
    names = [v.name for v in system.variables if v.name.startswith("P")]
    assert searched(system, *names, "broken") == searched(system, *names, "broken")


# --- limits -------------------------------------------------------------------------------------------


def test_it_is_found_by_being_there() -> None:
    assert engines()["bdd"].NAME == bdd.NAME


def test_progress_is_reported() -> None:
    system, end, never = counters(5, 5)
    lines: list[str] = []
    answers = bdd.check(system, [end, never], Limits(), lines.append)
    assert isinstance(answers["end"], Reached) and isinstance(answers["never"], Unreachable)
    assert lines[-1].startswith("bdd: depth 6, 36 states") and lines[-1].endswith("0 goals open, 2 decided")


def test_a_depth_limit_leaves_the_goal_open() -> None:
    system, end, _ = counters(9)
    reached = check(system, end, Limits(depth=9))
    assert isinstance(reached, Reached) and len(reached.run) == 9
    assert check(system, end, Limits(depth=8)) == Open("the depth limit of 8 ticks", 8)


def test_a_node_limit_leaves_the_goal_open() -> None:
    system, _ = roverlite(28)
    answer = check(system, flag("broken"), Limits(memory=1 << 18))
    assert isinstance(answer, Open) and answer.reason == "the memory limit is reached"


def test_what_was_seen_before_the_time_was_over_counts(monkeypatch: pytest.MonkeyPatch) -> None:
    cut_off(monkeypatch, DepthSearched(("end",), 7))
    answer = check(counters(3)[0], flag("end"), Limits())
    assert answer == Open(LIMIT, 7)


def test_no_goals() -> None:
    assert bdd.check(counters(3)[0], [], Limits(), quiet) == {}


def test_a_diagram_that_is_too_large_is_left_out(monkeypatch: pytest.MonkeyPatch) -> None:
    system, _, _ = counters(5, 5)
    monkeypatch.setattr(kept, "MOST", 3)
    answer = searched(system, "never")["never"]
    assert isinstance(answer, Unreachable) and isinstance(answer.because, Exhausted)
    assert answer.because.diagram is None and answer.because.states == 36


# --- what a system may do -----------------------------------------------------------------------------


def test_an_assumption_that_no_input_meets_allows_no_run() -> None:
    system = counters(3)[0]
    noise = var("noise", chosen([3, 5, 40]))
    for assume in (FALSE, noise > 40):
        narrow = replace(system, inputs=(*system.inputs, noise), assume=assume)
        answer = searched(narrow, "end")["end"]
        assert isinstance(answer, Unreachable) and isinstance(answer.because, Exhausted)
        assert answer.because.states == 1


def test_inputs_outside_the_cone_fulfil_the_assumption() -> None:
    system = counters(3)[0]
    noise = var("noise", chosen([3, 5, 40]))
    answer = searched(replace(system, inputs=(*system.inputs, noise), assume=noise == 40), "end")["end"]
    assert isinstance(answer, Reached)
    assert [tick["noise"] for tick in answer.run.inputs] == [40, 40, 40]


def test_what_is_read_of_an_input_stands_for_it() -> None:
    """Whether a distance is above a bound, and whether it is odd, which is a bit of it."""
    far, count = var("far", integer(0, 500)), var("count", integer(0, 3))
    goal, never, odd = flag("goal"), flag("never"), Apply(Op.BIT, (far, const(0)), Bool())
    step = (
        If((far > 77) & odd, (Assign(count, minimum(count + 1, 3)),)),
        Assign(goal, (count == 3) & (far < 9)),
        Assign(never, (far > 77) & (far < 9)),
    )
    system = TransitionSystem("read", (far,), (), (count, goal, never), (), step, far < 80)
    cut = input_cut(circuit(system, ["goal", "never"]))
    assert not cut.kept and len(cut.bits) < len(cut.hidden) == 9
    agrees(system, ["goal", "never"], naive.search(system, [goal, never]))
    answer = searched(system, "goal")["goal"]
    assert isinstance(answer, Reached) and [tick["far"] for tick in answer.run.inputs[:3]] == [79, 79, 79]


def test_a_variable_that_leaves_its_domain_ends_the_search() -> None:
    count, full, over = var("count", integer(0, 5)), flag("full"), flag("over")
    step = (Assign(count, count + 1), Assign(full, count == 5), Assign(over, count > 5))
    system = TransitionSystem("unbounded", (), (), (count, full, over), (), step)
    answers = searched(system, "full", "over")
    assert isinstance(answers["full"], Reached)
    assert answers["over"] == Open("count may leave its domain in tick 6", 5)


def test_frozen_values_are_chosen_once() -> None:
    mode, count, goal = var("mode", integer(0, 3), 1), var("count", integer(0, 9)), flag("goal")
    step = (
        If(mode == 3, (Assign(count, minimum(count + 1, 9)),)),
        Assign(goal, (count == 4) & (mode == 3)),
    )
    system = TransitionSystem("frozen", (), (mode, flag("other")), (count, goal), (), step, TRUE)
    answer = searched(system, "goal")["goal"]
    assert isinstance(answer, Reached) and answer.run == Run({"mode": 3, "other": 0}, ({},) * 4)


def test_constants_belong_to_the_diagram() -> None:
    """The states are closed only where the constant has its value."""
    fixed, count, goal = var("fixed", integer(-2, 5), -2), var("count", integer(0, 3)), flag("goal")
    step = (Assign(count, ite(count == 2, 0, count + 1) + (fixed + 2)), Assign(goal, count > 2))
    system = TransitionSystem("fixed", (), (), (fixed, count, goal), (), step)
    answer = searched(system, "goal")["goal"]
    assert isinstance(answer, Unreachable) and isinstance(answer.because, Exhausted)
    diagram = answer.because.diagram
    assert diagram is not None and set(diagram.variables) == {"fixed", "count"}
    for a, b in product(fixed.domain.values, count.domain.values):
        assert ({"fixed": a, "count": b} in diagram) == (a == -2 and b < 3)
