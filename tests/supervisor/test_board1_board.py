"""The supervisor of Board 1 as a whole: power-up, nominal driving, faults of both boards, a stop."""

import pytest

from rovercheck.supervisor.board1 import Board1Outputs
from rovercheck.supervisor.types import SafetyState
from rovercheck.supervisor.types import SupervisorCommand as COMMAND
from tests.supervisor.board1_bench import Bench, references


def test_before_the_first_step():
    out = Board1Outputs()
    assert references(out) == (0, 0)
    assert not (out.give_b2_actuation or out.actuate_emergency_stop or out.critical_mask or out.degraded_mask)
    assert out.current_action is COMMAND.CMD_NORMAL


def test_nominal_driving():
    bench = Bench().set(x_norm=-0.4, y_norm=0.6)
    assert references(bench.step()) == (0, 0)
    out = bench.step()
    assert references(out) == (0.6, -0.4)
    assert (out.critical_mask, out.degraded_mask, out.rover_safety_state) == (0, 0, SafetyState.SAFETY_OK)


def test_monitors_and_masks_work_in_the_first_step_and_safety_in_the_second():
    bench = Bench().set(temperature_degc=57.0)
    out = bench.step()
    assert (out.degraded_mask, out.rover_safety_state) == (1, SafetyState.SAFETY_OK)
    assert bench.step().rover_safety_state is SafetyState.SAFETY_DEGRADED


@pytest.mark.parametrize(
    "changes, critical, degraded",
    [
        ({"temperature_degc": -10.0}, 0, 1),
        ({"battery_pct": 20.0}, 0, 2),
        ({"has_no_feedback": (True, False, False, False)}, 0, 8),
        ({"has_no_feedback": (False, True, False, False)}, 0, 16),
        ({"has_no_feedback": (False, False, True, False)}, 0, 32),
        ({"has_no_feedback": (False, False, False, True)}, 0, 64),
        ({"is_motion_consistent": False}, 0, 120),
        ({"has_no_feedback": (False, True, False, False), "is_motion_consistent": False}, 16, 104),
    ],
)
def test_masks(changes, critical, degraded):
    out = Bench().set(**changes).step(2)
    assert (out.critical_mask, out.degraded_mask) == (critical, degraded)
    assert out.rover_safety_state == (2 if critical else 1)


@pytest.mark.parametrize(
    "critical, degraded, state",
    [(0, 0, 0), (1, 0, 2), (2, 0, 2), (4, 0, 1), (8, 0, 1), (0, 1, 1), (0, 8, 1), (5, 0, 2), (16, 0, 0)],
)
def test_masks_of_board_2(critical, degraded, state):
    out = Bench().set(critical_mask=critical, degraded_mask=degraded).step(2)
    assert out.rover_safety_state == state
    assert (out.critical_mask, out.degraded_mask) == (0, 0)
    assert (out.stop_required, out.degraded_required) == (critical & 3 > 0, critical & 12 > 0 or degraded > 0)


def test_backward_mode_is_seen_by_the_motion_in_the_same_step():
    bench = Bench()
    bench.step()
    for btn1, btn2 in ((1, 0), (0, 0), (1, 0), (0, 0), (0, 1), (0, 0)):
        bench.set(btn1=bool(btn1), btn2=bool(btn2)).step()
    assert bench.set(btn2=True).step().backward_enabled
    assert bench.set(y_norm=-1.0).step().v_ref == -1.0


def test_a_collision_and_the_release_after_standstill():
    bench = Bench().set(y_norm=1.0, wheel_speed_rpm=(60.0,) * 4)
    bench.step(5)
    out = bench.set(command=COMMAND.CMD_ESTOP).step()
    assert out.actuate_emergency_stop and out.current_action is COMMAND.CMD_ESTOP
    assert bench.set(command=COMMAND.CMD_NORMAL).step(100).actuate_emergency_stop
    bench.set(wheel_speed_rpm=(0.0,) * 4)
    assert bench.step(52).current_action is COMMAND.CMD_STOP
    out = bench.step()
    assert (out.actuate_emergency_stop, out.v_ref) == (False, 0)
    assert bench.step().v_ref == 1.0
