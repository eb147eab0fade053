"""k-induction proves what a naive search does not reach, with invariants that plain enumeration confirms."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace

import pytest
from hypothesis import given

from benchmarks.roverlite import roverlite
from rovercheck.checker.engines import Limits, engines, kinduction, quiet
from rovercheck.checker.engines.kinduction import invariant_search
from rovercheck.checker.engines.kinduction.invariant_search import InvariantSearch
from rovercheck.checker.engines.kinduction.search import InductionGroup, InductionModel, search
from rovercheck.checker.results.verdict import Answer, Inductive, Open, Reached, Unreachable
from rovercheck.checker.search import (
    DepthSearched,
    GoalReached,
    GoalsExcluded,
    GoalsLeftOpen,
    SearchEvent,
    SearchPhase,
)
from rovercheck.spec_model.lang.action import Assign, If
from rovercheck.spec_model.lang.domain import chosen, integer
from rovercheck.spec_model.lang.expr import FALSE, Var, flag, var
from rovercheck.spec_model.lang.system import TransitionSystem
from rovercheck.spec_model.lang.words import minimum
from tests import naive
from tests.inductive import problems
from tests.profiles import examples
from tests.strategies_ts import goals, transition_systems
from tests.toys import GOAL, counter, once, overflowing, relay, waiting


def searched(
    system: TransitionSystem, wanted: Sequence[Var], depth: int | None = None
) -> Mapping[str, Answer]:
    """The answers of a search in this process."""
    return answered(search(system, [g.name for g in wanted], depth), wanted)


def answered(events: Iterable[SearchEvent], wanted: Sequence[Var]) -> Mapping[str, Answer]:
    """What events come to."""
    found: dict[str, Answer] = {}
    deep = {g.name: 0 for g in wanted}
    for event in events:
        match event:
            case GoalReached(goal, run, shortest):
                found[goal] = Reached(run, shortest)
            case GoalsExcluded((goal,), because):
                found[goal] = Unreachable(because)
            case DepthSearched(names, ticks):
                deep |= dict.fromkeys(names, ticks)
            case GoalsLeftOpen(names, reason):
                found |= {n: Open(reason, deep[n]) for n in names}
            case SearchPhase():
                pass
    assert found.keys() == deep.keys()
    return found


def agrees(system: TransitionSystem, wanted: Sequence[Var], answers: Mapping[str, Answer]) -> None:
    """Nothing that a naive search and plain enumeration do not confirm."""
    reached = naive.search(system, wanted).reached
    for goal in wanted:
        match answers[goal.name]:
            case Reached(run, shortest):
                assert naive.replay(system, run)[-1][goal.name] == 1
                assert len(run) == reached[goal.name] or (not shortest and len(run) > reached[goal.name])
            case Unreachable(Inductive() as because):
                assert goal.name not in reached
                assert problems(system, goal, because) == []
            case Open(_, depth):
                assert reached.get(goal.name, depth + 1) > depth
            case other:
                raise AssertionError(other)


@examples(60)
@given(transition_systems())
def test_random_systems(system: TransitionSystem) -> None:
    agrees(system, goals(system), searched(system, goals(system)))


@examples(20)
@given(transition_systems())
def test_a_depth_limit_bounds_the_runs(system: TransitionSystem) -> None:
    for depth in (0, 2):
        answers = searched(system, goals(system), depth)
        agrees(system, goals(system), answers)
        for answer in answers.values():
            assert not isinstance(answer, Reached) or len(answer.run) <= depth


# --- systems that need invariants ---------------------------------------------------------------


def proved(system: TransitionSystem) -> Inductive:
    """The invariant that the search finds for the goal, confirmed by enumeration."""
    answer = searched(system, [GOAL])["goal"]
    assert isinstance(answer, Unreachable) and isinstance(answer.because, Inductive)
    assert problems(system, GOAL, answer.because) == []
    return answer.because


@pytest.mark.parametrize("limit", [2, 3, 7, 9])
def test_two_counters_are_related(limit: int) -> None:
    proved(relay(limit))


def test_what_is_given_is_tried_before_anything_is_searched(monkeypatch: pytest.MonkeyPatch) -> None:
    """That three counters add up to a fourth is no template; a condition that is no invariant is dropped."""
    monkeypatch.setattr(invariant_search, "ROUNDS", 0)
    parts = [var(f"part{i}", integer(0, 12)) for i in range(3)]
    total, asked = var("total", integer(0, 36)), [flag(f"more{i}") for i in range(3)]
    each: list[Assign | If] = [
        If(more & (part < 12), (Assign(part, part + 1), Assign(total, total + 1)))
        for more, part in zip(asked, parts, strict=True)
    ]
    adds_up = total == parts[0] + parts[1] + parts[2]
    step = (*each, Assign(GOAL, ~adds_up))
    system = TransitionSystem("sums", tuple(asked), (), (*parts, total, GOAL), (), step)
    model = InductionModel(system)
    found = {
        given: answered(InductionGroup(model, ["goal"], None, given).decide(), [GOAL])["goal"]
        for given in ((), (total < 3,), (total < 3, adds_up))
    }
    assert [type(answer) for answer in found.values()] == [Open, Open, Unreachable]


def test_a_state_that_is_never_entered_is_excluded() -> None:
    assert proved(waiting()).ticks == 1


def test_simple_paths_where_no_invariant_is_found(monkeypatch: pytest.MonkeyPatch) -> None:
    """Waiting may last for ever, but not along a simple path."""
    monkeypatch.setattr(InvariantSearch, "phases", lambda self: iter(()))
    because = proved(waiting())
    assert because.simple and not because.conjuncts


def test_simple_paths_are_simple_in_all_that_the_goal_is_written_with(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """``turn`` is simplified away, and states that differ in it alone are different to who checks."""
    monkeypatch.setattr(InvariantSearch, "phases", lambda self: iter(()))
    turn, plain = var("turn", integer(0, 1)), waiting()
    step = (*plain.step, Assign(GOAL, GOAL | (turn > 1)), Assign(turn, 1 - turn))
    system = replace(plain, variables=(*plain.variables, turn), step=step)
    assert searched(plain, [GOAL])["goal"] == Unreachable(Inductive((), 4, simple=True))
    because = proved(system)
    assert because.simple and because.ticks > 4


def test_the_full_roverlite() -> None:
    """The relay is off only 150 ticks after the last critical one, and two goals beside it."""
    system, names = roverlite(127)
    wanted = [n for n in names if n.name in ("P1", "P3", "P3h")]
    for answer in searched(system, wanted).values():
        assert isinstance(answer, Unreachable) and isinstance(answer.because, Inductive)
        assert len(answer.because.conjuncts) < 20 and answer.because.ticks <= 3


# --- runs ---------------------------------------------------------------------------------------


def test_the_first_ticks_give_shortest_runs() -> None:
    answer = searched(once(), [GOAL])["goal"]
    assert isinstance(answer, Reached) and answer.shortest and len(answer.run) == 2


def test_random_runs_may_be_longer_than_need_be() -> None:
    system = counter(15, top=20)
    answer = searched(system, [GOAL])["goal"]
    assert isinstance(answer, Reached) and not answer.shortest and len(answer.run) >= 15
    assert naive.replay(system, answer.run)[-1]["goal"] == 1


def test_the_same_question_has_the_same_answer() -> None:
    for system in (relay(9), counter(15, top=20)):
        first, second = (kinduction.check(system, [GOAL], Limits(), quiet) for _ in range(2))
        assert str(first) == str(second)


# --- the engine ---------------------------------------------------------------------------------


def test_it_is_found_by_being_there() -> None:
    assert engines()["kinduction"].NAME == kinduction.NAME


def test_the_engine_answers_for_every_goal() -> None:
    system, lines = relay(9), list[str]()
    answers = kinduction.check(system, [GOAL, flag("on")], Limits(seconds=200), lines.append)
    assert isinstance(answers["goal"], Unreachable)
    assert isinstance(answers["on"], Reached) and len(answers["on"].run) == 1
    assert lines[-1].startswith("kinduction: ") and lines[-1].endswith("0 goals open, 2 decided")


def test_no_goals() -> None:
    assert kinduction.check(relay(), [], Limits(), quiet) == {}


def test_no_time_leaves_the_goals_open() -> None:
    answer = kinduction.check(relay(), [GOAL], Limits(seconds=0.0), quiet)["goal"]
    assert answer == Open("the time limit of 0 s is reached", 0)


def test_an_assumption_that_no_input_meets_allows_no_run() -> None:
    noise = var("noise", chosen([3, 5, 40]))
    system = replace(counter(3, top=3), inputs=(flag("hold"), noise))
    for assume in (FALSE, noise > 40):
        proved(replace(system, assume=assume))


def test_a_variable_that_leaves_its_domain_is_named() -> None:
    within = searched(overflowing(5), [GOAL])["goal"]
    assert within == Open("count may leave its domain in tick 6", 5)
    beyond = searched(overflowing(20), [GOAL])["goal"]
    assert beyond == Open("no invariant was found that keeps count in the domain", 12)


def test_a_domain_with_gaps_is_kept() -> None:
    """Between two members is outside the domain, too."""
    place = var("place", chosen([0, 10, 20]))
    step = (Assign(GOAL, place == 15), Assign(place, minimum(place + 5, 20)))
    system = TransitionSystem("gaps", (), (), (place, GOAL), (), step)
    assert searched(system, [GOAL])["goal"] == Open("place may leave its domain in tick 1", 0)


def test_frozen_values_stay() -> None:
    mode, seen = var("mode", integer(0, 3), 1), flag("seen")
    step = (Assign(GOAL, seen & (mode != 3)), If(mode == 3, (Assign(seen, ~seen),)))
    proved(TransitionSystem("frozen", (), (mode,), (seen, GOAL), (), step))
