"""Localisation: cuts add runs and lose none, and proofs on few variables hold where all are computed."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import islice
from queue import SimpleQueue

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rovercheck.checker.engines import Limits, engines, localisation, quiet
from rovercheck.checker.engines.localisation.bounded_search import BoundedEngine, BoundedHit, Core
from rovercheck.checker.engines.localisation.cuts import with_cuts, with_switches, written
from rovercheck.checker.engines.localisation.orders import Orders
from rovercheck.checker.process.isolate import ChildStopped
from rovercheck.checker.results.verdict import Answer, Inductive, Open, Reached, Unreachable
from rovercheck.spec_model.lang.action import If, assign, when
from rovercheck.spec_model.lang.domain import integer
from rovercheck.spec_model.lang.evaluate import step
from rovercheck.spec_model.lang.expr import Var, flag, ite, var
from rovercheck.spec_model.lang.system import TransitionSystem
from rovercheck.spec_model.lang.words import minimum, modulo
from tests import naive
from tests.engine_children import engines_here
from tests.inductive import problems
from tests.profiles import examples
from tests.strategies_ts import goals, transition_systems
from tests.toys import GOAL


def check(system: TransitionSystem, wanted: Sequence[Var]) -> Mapping[str, Answer]:
    """The answers of a search in this process."""
    with engines_here():
        return localisation.check(system, wanted, Limits(), quiet)


# --- cuts -----------------------------------------------------------------------------------------


@examples(60)
@given(transition_systems(most=3), st.data())
def test_every_reachable_valuation_is_one_of_the_system_with_cuts(
    system: TransitionSystem, data: st.DataObject
) -> None:
    names = [v.name for v in system.variables]
    free = data.draw(st.sets(st.sampled_from(names), max_size=2))
    cut = with_cuts(system, set(names) - free)
    if len(cut.inputs) - len(system.inputs) <= 3:  # the naive search tries all their values together
        assert naive.search(system, goals(system)).states <= naive.search(cut, goals(system)).states


@examples(100)
@given(transition_systems(), st.integers(0, 1))
def test_with_all_switches_on_nothing_is_other(system: TransitionSystem, pick: int) -> None:
    switched, switches = with_switches(system)
    on = {s.name: 1 for s in switches.values()}
    own = {v.name for v in system.inputs}
    free = {v.name: v.domain.values[-pick] for v in switched.inputs if v.name not in own}
    for at, inputs in _ticks(system):
        after = step(switched, {**at, **on}, {**inputs, **free})
        expected = step(system, at, inputs)
        assert {v.name: after[v.name] for v in system.variables} == {
            v.name: expected[v.name] for v in system.variables
        }


def _ticks(system: TransitionSystem) -> Iterator[tuple[dict[str, int], dict[str, int]]]:
    """Some states on one run, and the inputs that lead on."""
    at = {**system.init, **{v.name: v.init for v in system.frozen}}
    for inputs in islice(naive.vectors(system.inputs), 8):
        yield at, inputs
        at = {n: v for n, v in step(system, at, inputs).items() if n not in inputs}


def test_what_is_written_in_one_branch_is_cut_apart() -> None:
    """Of an enabled board each part is a piece of its own, and the condition is computed once."""
    on, a, b = flag("on"), flag("a"), flag("b")
    body = (assign(a, ~a), assign(on, False), assign(b, a))
    system = TransitionSystem("board", (), (), (on, a, b), (), (If(on, body),))
    cut = with_cuts(system, {"on", "b"})
    assert [name for s in cut.step if isinstance(s, If) for name in written(s)] == ["a", "on", "b"]
    assert [v.name for v in cut.temps] == ["condition@1"] and len(cut.inputs) == 1


# --- proofs ---------------------------------------------------------------------------------------


def board(rows: int) -> TransitionSystem:
    """A goal that a latch keeps away, beside a record so large that nothing can be enumerated."""
    hot, latch, count = flag("hot"), flag("latch"), var("count", integer(0, 40))
    record = [var(f"row{n}", integer(0, 40)) for n in range(rows)]
    busy = flag("busy")
    shift = [assign(new, old) for old, new in zip(record[-2::-1], record[:0:-1], strict=True)]
    return TransitionSystem(
        "board",
        (hot, busy),
        (),
        (latch, count, *record, GOAL),
        (),
        (
            *shift,
            assign(record[0], modulo(record[0] + record[-1] + ite(busy, count, count * 0 + 1), 41)),
            assign(count, minimum(count + 1, 40)),
            when(hot, [assign(latch, True)]),
            assign(GOAL, hot & ~latch),
        ),
    )


def test_a_proof_rests_on_the_few_variables_that_matter() -> None:
    system = board(12)
    answer = check(system, [GOAL])[GOAL.name]
    assert isinstance(answer, Unreachable) and isinstance(answer.because, Inductive)
    assert not any("row" in str(conjunct) for conjunct in answer.because.conjuncts)


def test_why_a_goal_is_out_of_reach() -> None:
    said: SimpleQueue[object] = SimpleQueue()
    BoundedEngine(board(12))(said.put, GOAL.name, 3, frozenset())
    assert said.get_nowait() == Core(frozenset({GOAL.name, "latch"}))


def test_a_run_is_one_of_the_system_itself() -> None:
    system = board(12)
    late = assign(GOAL, system.var("count") >= 5)
    answer = check(replace(system, step=(*system.step, late)), [GOAL])[GOAL.name]
    assert isinstance(answer, Reached) and len(answer.run) == 5
    assert set(answer.run.inputs[0]) == {"hot", "busy"} and not answer.run.frozen


@examples(60)
@given(transition_systems())
def test_nothing_that_a_naive_search_does_not_confirm(system: TransitionSystem) -> None:
    wanted = goals(system)
    reached = naive.search(system, wanted).reached
    for name, answer in check(system, wanted).items():
        match answer:
            case Reached(run):
                assert naive.replay(system, run)[-1][name]
            case Unreachable(Inductive() as because):
                assert name not in reached
                assert problems(system, system.var(name), because) == []
            case Open(_, depth):
                assert depth == 0


# --- limits ---------------------------------------------------------------------------------------


def test_engines_know_it() -> None:
    assert engines()["localisation"].NAME == localisation.NAME


def test_a_limit_of_depth_ends_the_search_of_runs() -> None:
    answer = localisation.check(board(4), [GOAL], Limits(depth=1), quiet)[GOAL.name]
    assert isinstance(answer, Open) and "at most 1 tick" in answer.reason


def test_no_time_is_told() -> None:
    answer = localisation.check(board(4), [GOAL], Limits(seconds=0.0), quiet)[GOAL.name]
    assert isinstance(answer, Open) and "time limit" in answer.reason


def test_a_child_that_dies_is_told() -> None:
    with Orders(board(2), None, 1) as asked, pytest.raises(ChildStopped):  # a byte of memory
        asked.why(GOAL.name, 2, frozenset())


def test_a_run_found_at_once_is_told() -> None:
    said: SimpleQueue[object] = SimpleQueue()
    hot = flag("hot")
    system = TransitionSystem("hot", (hot,), (), (GOAL,), (), (assign(GOAL, hot),))
    BoundedEngine(system)(said.put, GOAL.name, 2, frozenset())
    assert isinstance(said.get_nowait(), BoundedHit)
