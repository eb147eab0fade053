"""Bounded model checking finds what a naive search finds, in as few ticks, and never claims more."""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import pytest
from hypothesis import given

from rovercheck.checker.engines import Limits, bmc, engines, quiet
from rovercheck.checker.engines.bmc.search import search
from rovercheck.checker.process.isolate import Send
from rovercheck.checker.results.verdict import Open, Reached, Run
from rovercheck.checker.search import DepthSearched, GoalReached, GoalsLeftOpen, runner
from rovercheck.spec_model.lang.action import Assign, If
from rovercheck.spec_model.lang.domain import integer
from rovercheck.spec_model.lang.expr import FALSE, TRUE, flag, var
from rovercheck.spec_model.lang.system import TransitionSystem
from rovercheck.spec_model.lang.words import minimum
from tests import naive
from tests.engine_children import LIMIT, cut_off
from tests.profiles import examples
from tests.strategies_ts import goals, transition_systems
from tests.toys import GOAL, filling, overflowing


@dataclass
class Searched:
    found: dict[str, Run] = field(default_factory=dict)
    deep: dict[str, int] = field(default_factory=dict)


def searched(system: TransitionSystem, names: Sequence[str], most: int) -> Searched:
    """What the events of a search in this process add up to."""
    result = Searched(deep=dict.fromkeys(names, 0))
    for event in search(system, names, most):
        match event:
            case GoalReached(goal, run):
                result.found[goal] = run
            case DepthSearched(goals_, depth):
                result.deep |= dict.fromkeys(goals_, depth)
            case GoalsLeftOpen():
                raise AssertionError(event)
    return result


@examples(150)
@given(transition_systems())
def test_random_systems_against_a_naive_search(system: TransitionSystem) -> None:
    names, most = [g.name for g in goals(system)], 20
    result, shortest = searched(system, names, most), naive.search(system, goals(system)).reached
    for name in names:
        if shortest.get(name, most + 1) > most:
            assert name not in result.found
            assert result.deep[name] == most
        else:
            assert len(result.found[name]) == shortest[name]
            assert naive.replay(system, result.found[name])[-1][name]


@pytest.mark.parametrize("most", [1, 2, 15, 16, 17, 18, 30, 47, 100])
def test_the_shortest_run_wherever_it_falls_in_a_block(most: int) -> None:
    system = filling(most)
    result = searched(system, ["full", "over"], 2 * most)
    assert len(result.found["full"]) == most and naive.replay(system, result.found["full"])[-1]["full"]
    assert "over" not in result.found and result.deep["over"] == 2 * most


def test_it_is_found_by_being_there() -> None:
    assert engines()["bmc"].NAME == bmc.NAME


def test_the_engine_answers_for_every_goal() -> None:
    system, lines = filling(12), list[str]()
    wanted = [v for v in system.variables if v.name != "count"]
    answers = bmc.check(system, wanted, Limits(depth=40, seconds=60), lines.append)
    reached = answers["full"]
    assert isinstance(reached, Reached) and reached.shortest and len(reached.run) == 12
    assert answers["over"] == Open("no run of at most 40 ticks reaches it", 40)
    assert lines[-1] == "bmc: depth 40, 1 goal open, 1 decided"


def test_a_depth_that_nobody_asked_for_is_said() -> None:
    answer = bmc.check(filling(3), [flag("over")], Limits(), quiet)["over"]
    assert answer == Open("no run of at most 300 ticks reaches it, and no other depth was asked for", 300)


def test_a_run_shorter_than_the_limit_is_not_reported_beyond_it() -> None:
    answers = bmc.check(filling(12), [flag("full")], Limits(depth=11), quiet)
    assert answers["full"] == Open("no run of at most 11 ticks reaches it", 11)


def test_no_goals() -> None:
    assert bmc.check(filling(3), [], Limits(), quiet) == {}


def test_an_assumption_that_no_input_meets_allows_no_run() -> None:
    system = filling(3)
    for assume in (FALSE, system.inputs[1] > 40):
        answers = bmc.check(replace(system, assume=assume), [flag("full")], Limits(depth=7), quiet)
        assert answers["full"] == Open("no run of at most 7 ticks reaches it", 7)


def test_a_variable_that_leaves_its_domain_ends_the_search() -> None:
    answers = bmc.check(filling(5, saturate=False), [flag("full"), flag("over")], Limits(depth=9), quiet)
    assert isinstance(answers["full"], Reached)
    assert answers["over"] == Open("count may leave its domain in tick 6", 5)


def test_a_variable_that_leaves_its_domain_counts_also_where_it_was_simplified_away() -> None:
    """``count > 5`` is false as long as the domain is kept, and then mentions no counter any more."""
    answer = bmc.check(overflowing(5), [GOAL], Limits(depth=9), quiet)["goal"]
    assert answer == Open("count may leave its domain in tick 6", 5)


def test_frozen_values_are_chosen_once() -> None:
    mode, count, goal = var("mode", integer(0, 3), 1), var("count", integer(0, 9)), flag("goal")
    step = (
        If(mode == 3, (Assign(count, minimum(count + 1, 9)),)),
        Assign(goal, (count == 4) & (mode == 3)),
    )
    system = TransitionSystem("frozen", (), (mode, flag("other")), (count, goal), (), step, TRUE)
    answer = bmc.check(system, [goal], Limits(), quiet)["goal"]
    assert isinstance(answer, Reached) and answer.run == Run({"mode": 3, "other": 0}, ({},) * 4)


# --- a child that misbehaves: it has to be importable, so it is a function of this module ---------


def _die(send: Send, *_: object) -> None:
    import os
    import signal

    os.kill(os.getpid(), signal.SIGSEGV)


def test_what_was_seen_before_the_time_was_over_counts(monkeypatch: pytest.MonkeyPatch) -> None:
    cut_off(monkeypatch, DepthSearched(("full",), 7))
    lines = list[str]()
    answers = bmc.check(filling(3), [flag("full")], Limits(), lines.append)
    assert answers["full"] == Open(LIMIT, 7)
    assert lines[-1] == "bmc: depth 7, 1 goal open" and len(lines) >= 2


def test_a_dying_solver_leaves_the_goals_open(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(runner, "work", _die)
    answers = bmc.check(filling(3), [flag("full")], Limits(), quiet)
    assert answers["full"] == Open("the solver process was ended by SIGSEGV", 0)


def test_too_little_memory_leaves_the_goals_open() -> None:
    answer = bmc.check(filling(3000), [flag("full")], Limits(memory=200 << 20), quiet)["full"]
    assert isinstance(answer, Open)
