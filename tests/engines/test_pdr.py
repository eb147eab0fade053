"""PDR decides what a naive search decides; its runs replay, and its invariants pass independent checks."""

from collections.abc import Iterator, Sequence
from dataclasses import replace

import pytest
from hypothesis import given

from rovercheck.checker.encode.bits import circuit
from rovercheck.checker.encode.bits.aig import Aig, Literal
from rovercheck.checker.encode.bits.cnf import Cnf
from rovercheck.checker.engines import Limits, engines, pdr, quiet
from rovercheck.checker.engines.pdr.groups import decisions
from rovercheck.checker.process.isolate import Send
from rovercheck.checker.results.verdict import Inductive, Open, Reached, Unreachable
from rovercheck.checker.search import DepthSearched, GoalReached, GoalsExcluded, GoalsLeftOpen, runner
from rovercheck.spec_model.lang.action import Assign, If
from rovercheck.spec_model.lang.domain import chosen, integer
from rovercheck.spec_model.lang.evaluate import admissible, evaluate, step
from rovercheck.spec_model.lang.expr import FALSE, TRUE, Expr, flag, var
from rovercheck.spec_model.lang.system import TransitionSystem
from rovercheck.spec_model.lang.words import minimum
from tests import naive
from tests.engine_children import LIMIT, cut_off
from tests.profiles import examples
from tests.strategies_ts import goals, transition_systems
from tests.toys import filling


def decided(
    system: TransitionSystem, names: Sequence[str], candidates: Sequence[Expr] | None = None
) -> dict[str, Reached | Unreachable]:
    """The answers of a search in this process, which must decide everything."""
    found: dict[str, Reached | Unreachable] = {}
    for event in decisions(system, names, None, candidates):
        match event:
            case GoalReached(goal, run, shortest):
                found[goal] = Reached(run, shortest)
            case GoalsExcluded(names_, because):
                found |= dict.fromkeys(names_, Unreachable(because))
            case GoalsLeftOpen():
                raise AssertionError(event)
    assert set(found) == set(names)
    return found


def within(system: TransitionSystem, invariant: Sequence[Expr]) -> Iterator[dict[str, int]]:
    """Every state within the domains that satisfies an invariant."""
    for at in naive.vectors((*system.frozen, *system.variables)):
        if all(evaluate(c, at) for c in invariant):
            yield at


def holds_initially(system: TransitionSystem, invariant: Sequence[Expr]) -> bool:
    starts = ({**system.init, **frozen} for frozen in naive.vectors(system.frozen))
    return all(evaluate(c, at) for at in starts for c in invariant)


def passes_on(system: TransitionSystem, invariant: Sequence[Expr], goal: str) -> bool:
    """Whether every tick from a state of the invariant leads to another, and not to the goal."""
    for at in within(system, invariant):
        for inputs in naive.vectors(system.inputs):
            if admissible(system, at, inputs):
                after = step(system, at, inputs)
                inside = all(after[v.name] in v.domain for v in system.variables)
                if after[goal] or not inside or not all(evaluate(c, after) for c in invariant):
                    return False
    return True


def justified(system: TransitionSystem, goal: str, because: object) -> bool:
    """Whether evidence is an inductive invariant that excludes a goal, by trying every state."""
    assert isinstance(because, Inductive) and because.ticks == 1
    return holds_initially(system, because.conjuncts) and passes_on(system, because.conjuncts, goal)


@examples(400)
@given(transition_systems())
def test_random_systems_against_a_naive_search(system: TransitionSystem) -> None:
    shortest = naive.search(system, goals(system)).reached
    for name, answer in decided(system, [g.name for g in goals(system)], ()).items():
        if isinstance(answer, Reached):
            assert naive.replay(system, answer.run)[-1][name]
            assert len(answer.run) == shortest[name] or not answer.shortest
        else:
            assert name not in shortest
            assert isinstance(answer.because, Inductive)
            assert holds_initially(system, answer.because.conjuncts)


@examples(150)
@given(transition_systems(2))
def test_invariants_of_random_systems_by_enumeration(system: TransitionSystem) -> None:
    for name, answer in decided(system, [g.name for g in goals(system)]).items():
        assert isinstance(answer, Reached) or justified(system, name, answer.because)


@examples(100)
@given(transition_systems(2))
def test_invariants_found_without_candidates(system: TransitionSystem) -> None:
    for name, answer in decided(system, [g.name for g in goals(system)], ()).items():
        assert isinstance(answer, Reached) or justified(system, name, answer.because)


def test_of_candidates_only_what_is_inductive_is_used() -> None:
    system = filling(9)
    count, full, _ = system.variables
    wrong = [count < 4, count != 7, full, count == 0]
    right = [count <= 9, ~full | (count == 9)]
    over = decided(system, ["over"], [*wrong, *right])["over"]
    assert isinstance(over, Unreachable) and justified(system, "over", over.because)
    assert isinstance(decided(system, ["full"], wrong)["full"], Reached)


@pytest.mark.parametrize("candidates", [None, ()])
@pytest.mark.parametrize("most", [1, 2, 15, 16, 17, 47, 100])
def test_counters(most: int, candidates: Sequence[Expr] | None) -> None:
    system = filling(most)
    answers = decided(system, ["full", "over"], candidates)
    full, over = answers["full"], answers["over"]
    assert isinstance(full, Reached) and len(full.run) == most
    assert naive.replay(system, full.run)[-1]["full"]
    assert isinstance(over, Unreachable) and justified(system, "over", over.because)


def test_the_same_question_has_the_same_answer() -> None:
    first, second = (decided(filling(40), ["full", "over"]) for _ in range(2))
    assert str(first) == str(second)


# --- the contract -----------------------------------------------------------------------------------


def test_it_is_found_by_being_there() -> None:
    assert engines()["pdr"].NAME == pdr.NAME


def test_the_engine_answers_for_every_goal() -> None:
    system, lines = filling(12), list[str]()
    wanted = [v for v in system.variables if v.name != "count"]
    answers = pdr.check(system, wanted, Limits(seconds=60), lines.append)
    reached = answers["full"]
    assert isinstance(reached, Reached) and len(reached.run) == 12
    assert isinstance(answers["over"], Unreachable)
    assert lines[-1].startswith("pdr: depth ") and lines[-1].endswith(" lemmas, 0 goals open, 2 decided")


def test_no_goals() -> None:
    assert pdr.check(filling(3), [], Limits(), quiet) == {}


def test_an_assumption_that_no_input_meets_allows_no_run() -> None:
    system = filling(3)
    for assume in (FALSE, system.inputs[1] > 40):
        answer = pdr.check(replace(system, assume=assume), [flag("full")], Limits(), quiet)["full"]
        assert answer == Unreachable(Inductive(()))


def test_a_variable_that_leaves_its_domain_leaves_the_goals_open() -> None:
    answers = pdr.check(filling(5, saturate=False), [flag("full"), flag("over")], Limits(), quiet)
    assert answers["full"] == answers["over"] == Open("count may leave its domain in tick 6", 0)


def test_a_variable_that_could_leave_its_domain_from_elsewhere_only() -> None:
    """Growing beyond the domain takes a state that no run comes to, which is part of the proof."""
    count, stop, goal = var("count", integer(0, 40)), flag("stop"), flag("goal")
    body = (
        If(~stop, (Assign(count, count + 2),)),
        Assign(stop, stop | (count >= 40)),
        Assign(goal, count == 39),
    )
    system = TransitionSystem("evens", (), (), (count, stop, goal), (), body, TRUE)
    answer = decided(system, ["goal"])["goal"]
    assert isinstance(answer, Unreachable) and justified(system, "goal", answer.because)
    assert not justified(system, "goal", Inductive(()))


def test_frozen_values_are_chosen_once() -> None:
    mode, count, goal = var("mode", integer(0, 3), 1), var("count", integer(0, 9)), flag("goal")
    body = (
        If(mode == 3, (Assign(count, minimum(count + 1, 9)),)),
        Assign(goal, (count == 4) & (mode == 3)),
    )
    system = TransitionSystem("frozen", (), (mode, flag("other")), (count, goal), (), body, TRUE)
    answer = pdr.check(system, [goal], Limits(), quiet)["goal"]
    assert isinstance(answer, Reached)
    assert answer.run.frozen == {"mode": 3, "other": 0} and len(answer.run) == 4


def test_frozen_values_stay_in_their_domain() -> None:
    mode, goal = var("mode", chosen([1, 3]), 1), flag("goal")
    system = TransitionSystem(
        "frozen", (), (mode,), (goal,), (), (Assign(goal, (mode != 1) & (mode != 3)),), TRUE
    )
    assert isinstance(decided(system, ["goal"])["goal"], Unreachable)


def test_a_bounded_search_claims_no_more() -> None:
    """``full`` is reached after 60 ticks, which a search of 3 ticks cannot know of."""
    answer = pdr.check(filling(60), [flag("full")], Limits(depth=3), quiet)["full"]
    assert answer == Open("no run of at most 3 ticks reaches it", 3) or isinstance(answer, Reached)


# --- a child that misbehaves: it has to be importable, so it is a function of this module ---------


def _die(send: Send, *_: object) -> None:
    import os
    import signal

    os.kill(os.getpid(), signal.SIGSEGV)


def test_what_was_seen_before_the_time_was_over_counts(monkeypatch: pytest.MonkeyPatch) -> None:
    cut_off(monkeypatch, DepthSearched(("full",), 7, "12 lemmas"))
    lines = list[str]()
    answers = pdr.check(filling(3), [flag("full")], Limits(), lines.append)
    assert answers["full"] == Open(LIMIT, 7)
    assert lines[-1] == "pdr: depth 7, 12 lemmas, 1 goal open"


def test_a_dying_solver_leaves_the_goals_open(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(runner, "work", _die)
    answers = pdr.check(filling(3), [flag("full")], Limits(), quiet)
    assert answers["full"] == Open("the solver process was ended by SIGSEGV", 0)


# --- clauses of graphs ------------------------------------------------------------------------------


@examples(200)
@given(transition_systems())
def test_clauses_mean_what_the_graph_means(system: TransitionSystem) -> None:
    """One state and all that depends on it: the solver must find the values that the graph has."""
    from pysat.solvers import Minisat22

    made = circuit(system, [g.name for g in goals(system)])
    leaves = [*(latch.literal for latch in made.latches), *(bit.literal for bit in made.inputs)]
    roots = [*(latch.next for latch in made.latches), *made.goals.values(), made.assume, made.within]
    cnf = Cnf(made.aig, leaves, roots)
    solver = Minisat22(cnf.clauses)
    for pattern in (0, 0x5555, 0x3F1C, 0x9A7B, (1 << len(leaves)) - 1):
        values = {leaf >> 1: pattern >> n & 1 for n, leaf in enumerate(leaves)}
        given_ = [cnf.literal(x) if values[x >> 1] else -cnf.literal(x) for x in leaves]
        assert solver.solve(given_)
        model = {abs(x): x > 0 for x in solver.get_model()}
        expected = _bits(made.aig, roots, values)
        assert [model[abs(cnf.literal(r))] == (cnf.literal(r) > 0) for r in roots] == expected


def _bits(aig: Aig, roots: Sequence[Literal], values: dict[int, int]) -> list[bool]:
    return [bool(word & 1) for word in aig.evaluate(roots, values)]
