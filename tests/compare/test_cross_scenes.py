"""Scenes in which one step counts: each shows the fault that only it is likely to show."""

from collections.abc import Iterator
from dataclasses import replace

import pytest

from benchmarks.faults.by_hand import Fault, faults
from benchmarks.faults.hand_run import InProcess
from rovercheck.checker.compare.beside import compared, played
from rovercheck.checker.compare.environment import Environment
from rovercheck.checker.compare.stimulus import InputBlock, Stimulus
from rovercheck.checker.compare.strategy import ENVIRONMENTS

FAULTS = {
    "timer, board1, Backward_mode_toggle: 1 s becomes 1.02 s": "presses",
    "missing return, board2, Backward_mode_toggle_2: the stick does not end the combination": "presses",
    "priority, board2, Obstacles: confirmation before the end of the window": "obstacles that pass",
    "priority, board2, Monitors_2: silence before recovery of the joystick": "recoveries",
    "timer, board2, Motion_Supervision_2: 2 s become 2.02 s": "braking without the link",
    "reset, board2, Actuation: the ramp goes on after a pause": "driving again",
}
JOYSTICK = "ble_last_valid_ms"


def of(env: Environment, label: str) -> Iterator[Stimulus]:
    """Runs of one scene each; of the recoveries those of the joystick."""
    for name, begin, scene in env.scenes(env):
        if name == label and (label != "recoveries" or scene[0].changes[0][0] == JOYSTICK):
            yield Stimulus((InputBlock(2, env.at_rest), *begin, *scene))


@pytest.mark.parametrize("text", FAULTS)
def test_a_scene_shows_its_fault(text: str) -> None:
    fault = {str(f): f for f in faults()}[text]
    env = replace(ENVIRONMENTS[fault.board], board=fault.varied())
    implementation = InProcess(fault)
    runs = (played(env.board, env.fields, stimulus) for stimulus in of(env, FAULTS[text]))
    assert any(compared(env.board, run, implementation) for run in runs)


def test_a_fast_turn_is_summed_in_full() -> None:
    """The sums of a long window were cut at 122 °/s: a turn that the wheels explain was incoherent."""
    env = ENVIRONMENTS["board2"]
    for stimulus in of(env, "rotations"):
        run = played(env.board, env.fields, stimulus)
        assert not compared(env.board, run, InProcess(Fault("none", "board2", "none", "none")))
