"""Which obstacle decision Board 2 sends, against the document."""

import pytest

from rovercheck.supervisor.board2.decision import COMMANDS, Decision
from rovercheck.supervisor.board2.distances import Distances
from rovercheck.supervisor.board2.selection import Selected, Selection
from rovercheck.supervisor.types import SupervisorCommand as Command

CLEAR: Distances = (301, 301, 301)
AHEAD: Distances = (301, 200, 301)
NEAR: Distances = (301, 60, 301)
DEGRADED = [(4, 0, False), (0, 4, False), (0, 0, True), (255, 255, True)]
"""Critical mask, degraded mask, authorisation of the step before."""


def step(selection: Selection, distances: Distances, deg: tuple[int, int, bool] = (0, 0, False)) -> Selected:
    return selection.step(distances, 0, *deg)


def test_every_decision_has_the_command_of_the_table():
    numbers = [COMMANDS[Decision(i)].name for i in range(7)]
    assert numbers == [
        "CMD_NORMAL",
        "CMD_ESTOP",
        "CMD_GO_LEFT",
        "CMD_NORMAL",
        "CMD_GO_RIGHT",
        "CMD_NORMAL",
        "CMD_ESTOP",
    ]


@pytest.mark.parametrize("deg", DEGRADED)
def test_any_mask_bit_of_board_1_or_an_authorisation_selects_the_degraded_chart(deg):
    selection = Selection()
    assert step(selection, AHEAD) == Selected(Decision.READY, Command.CMD_NORMAL, False)
    assert step(selection, AHEAD) == Selected(Decision.READY, Command.CMD_NORMAL, False)
    assert step(selection, AHEAD, deg) == Selected(Decision.DEGRADED_STOP, Command.CMD_ESTOP, True)
    assert step(selection, AHEAD) == Selected(Decision.READY, Command.CMD_NORMAL, False)


@pytest.mark.parametrize("deg", DEGRADED)
def test_the_first_step_lets_the_rover_move_whatever_the_distances(deg):
    assert step(Selection(), NEAR, deg) == Selected(Decision.DEGRADED_MOVE, Command.CMD_NORMAL, True)
    assert step(Selection(), NEAR) == Selected(Decision.READY, Command.CMD_NORMAL, False)


def test_the_chart_that_is_not_selected_runs_too():
    """E32: after a degraded time with a near obstacle the stop is there in the first step."""
    selection = Selection()
    for _ in range(5):
        step(selection, NEAR, (1, 0, False))
    assert step(selection, NEAR) == Selected(Decision.STOP, Command.CMD_ESTOP, False)


def moving() -> Selection:
    """The step after, the rover turns left."""
    selection = Selection()
    for distances in [(200, 200, 301)] * 4 + [AHEAD]:
        assert step(selection, distances).b2_dec is Decision.READY
    return selection


def test_a_move_goes_on_in_the_step_in_which_board_1_becomes_degraded_and_ends_in_the_next():
    """The obstacle chart sees the flag of the step before."""
    selection = moving()
    assert step(selection, CLEAR) == Selected(Decision.TOWARD_S1, Command.CMD_GO_LEFT, False)
    assert step(selection, CLEAR, (1, 0, False)) == Selected(Decision.DEGRADED_MOVE, Command.CMD_NORMAL, True)
    assert step(selection, CLEAR) == Selected(Decision.READY, Command.CMD_NORMAL, False)


def test_a_move_decided_one_step_after_a_degraded_one_is_not_made():
    selection = moving()
    selection_before = moving()
    assert step(selection, CLEAR, (0, 8, False)).b2_dec is Decision.DEGRADED_MOVE
    assert step(selection, CLEAR, (0, 0, False)).b2_dec is Decision.READY
    assert step(selection_before, CLEAR).b2_dec is Decision.TOWARD_S1
