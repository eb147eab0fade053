"""The covering tests kept with the project: they reach what they claim, and our supervisors pass them."""

import pytest

from rovercheck.checker.adapters import python
from rovercheck.checker.system.instrument.goals import GoalKind
from rovercheck.checker.system.instrument.watch import watched
from rovercheck.checker.testgen import kept, kept_text
from rovercheck.checker.testgen.expected_outputs import required
from rovercheck.checker.testgen.fingerprint import fingerprint
from rovercheck.checker.testgen.keep import kept_of
from rovercheck.checker.testgen.replay import first_reached
from rovercheck.spec_model.abstraction import boards
from rovercheck.spec_model.rover import systems

BOARDS = ["board1", "board2"]
OURS = {
    "board1": "rovercheck.supervisor.board1:Board1",
    "board2": "rovercheck.supervisor.board2.board:Board2",
}
LEAST = {"board1": 104, "board2": 127}
"""Transitions that the kept tests reach at least."""


@pytest.mark.parametrize("name", BOARDS)
def test_kept_tests_reach_what_they_claim(name: str) -> None:
    board = boards()[name]
    for test in kept(name):
        looked = watched(board.system, only=set(test.goals))
        assert test.goals and {g.id for g in looked.goals} == set(test.goals)
        assert first_reached(board, looked, test.steps).keys() == set(test.goals), test.name


@pytest.mark.parametrize("name", BOARDS)
def test_every_goal_is_covered_or_said_not_to_be(name: str) -> None:
    document = kept_of(boards()[name], kept_text(name))
    covered = [goal for _, goals, _ in document.tests for goal in goals]
    stated = [*covered, *document.uncoverable, *document.unknown]
    assert len(stated) == len(set(stated))
    assert set(stated) == {g.id for g in watched(boards()[name].system).goals}
    assert set(document.shortest) <= set(covered)


@pytest.mark.parametrize("name", BOARDS)
def test_what_is_proved_is_proved_of_the_charts_as_drawn(name: str) -> None:
    """After a change of charts: ``rovercheck generate-tests --keep checker/testgen/kept``."""
    document = kept_of(boards()[name], kept_text(name))
    assert document.charts == fingerprint(boards()[name], systems()[name])


@pytest.mark.parametrize("name", BOARDS)
def test_kept_tests_cover_the_transitions(name: str) -> None:
    transitions = {g.id for g in watched(boards()[name].system, [GoalKind.TRANSITIONS]).goals}
    covered = {goal for test in kept(name) for goal in test.goals}
    assert len(transitions & covered) >= LEAST[name]


@pytest.mark.parametrize("name", BOARDS)
def test_our_supervisors_pass_the_kept_tests(name: str) -> None:
    board = boards()[name]
    ours = python.start(OURS[name], board, isolated=False)
    for test in kept(name):
        ours.reset()
        for step, after in zip(test.steps, required(board, test.steps), strict=True):
            actual = ours.step(step)
            assert {n: actual[n] for n in after} == pytest.approx(after, abs=1e-9), (
                test.name,
                step["now_ms"],
            )
