"""The emergency stop procedure of Board 1: what starts it, the second of standstill, its release."""

from math import inf, nan

import pytest

from rovercheck.supervisor.board1.states import MANOEUVRES, Motion
from rovercheck.supervisor.types import SupervisorCommand
from tests.supervisor.board1_motions import (
    CARE,
    ESTOP,
    MOVING,
    NORMAL,
    SAFE,
    STOP,
    braking,
    manoeuvring,
    rotating,
    started,
    step,
)

RUNNING = [Motion.NORMALE_MARCIA, *MANOEUVRES.values(), Motion.RETROMARCIA_180]


def running(state):
    """In a state of ``Stato_marcia_rover``, with the joystick forward."""
    for cmd, manoeuvre in MANOEUVRES.items():
        if manoeuvre is state:
            return step(manoeuvring(cmd), cmd=cmd, y_norm=1.0, x_norm=0.5)
    return step(rotating() if state is Motion.RETROMARCIA_180 else started(), y_norm=1.0)


@pytest.mark.parametrize("state", RUNNING)
def test_a_critical_rover_stops(state):
    motion = step(running(state), rover_status=STOP, y_norm=1.0)
    assert motion.state is Motion.IN_FRENATA_DI_EMERGENZA
    assert (motion.v_ref, motion.omega_ref, motion.emergency_stop) == (0, 0, True)
    assert motion.current_action is ESTOP
    assert not motion.is_rotating180 and not motion.user.invert_y


def test_a_stop_ends_the_inversion():
    motion = started()
    motion.user.invert_y = True
    assert not step(motion, rover_status=STOP, y_norm=-1.0).user.invert_y


@pytest.mark.parametrize("state", RUNNING)
def test_a_collision_stops_a_rover_that_drives_forward_but_not_a_half_turn(state):
    motion = step(running(state), cmd=ESTOP)  # the speed of the step before decides
    assert motion.emergency_stop == (state is not Motion.RETROMARCIA_180)


@pytest.mark.parametrize("y", [0.0, -0.4])
def test_a_rover_that_did_not_drive_forward_ignores_a_collision_for_one_step(y):
    motion = step(step(started(), y_norm=y), cmd=ESTOP, y_norm=1.0)
    assert (motion.emergency_stop, motion.v_ref) == (False, 1.0)
    assert step(motion, cmd=ESTOP).emergency_stop


def test_user_references_are_not_updated_while_stopping():
    motion = step(step(started(), y_norm=1.0), rover_status=STOP, y_norm=0.3)
    assert motion.user.v_user == 1.0


def stopped_after(motion, steps, wheels=(0.0,) * 4, status=STOP):
    for _ in range(steps):
        step(motion, rover_status=status, wheel_speed_rpm=wheels)
    return motion.state


def test_standstill_is_recognised_after_more_than_one_second():
    # the flag is true at the end of the first step at standstill, j; the guard in j + 51
    assert stopped_after(braking(), 1 + 50) is Motion.IN_FRENATA_DI_EMERGENZA
    motion = braking()
    assert stopped_after(motion, 1 + 51) is Motion.MOTORI_FERMI
    assert motion.current_action is SupervisorCommand.CMD_STOP
    assert motion.emergency_stop and motion.estop_recover_enabled


@pytest.mark.parametrize("rpm", [2.5, nan, inf])
def test_a_turning_wheel_restarts_the_second(rpm):
    motion = braking()
    stopped_after(motion, 50)
    stopped_after(motion, 1, (0.0, 0.0, rpm, 0.0))
    assert stopped_after(motion, 51) is Motion.IN_FRENATA_DI_EMERGENZA
    assert stopped_after(motion, 1) is Motion.MOTORI_FERMI


def test_the_standstill_of_the_last_stop_counts_from_the_entry_on():
    motion = braking()
    stopped_after(motion, 52)
    step(motion)
    assert motion.rover_is_stopped
    step(motion, rover_status=STOP, wheel_speed_rpm=MOVING)  # entered: true at the end of this step
    assert stopped_after(motion, 50) is Motion.IN_FRENATA_DI_EMERGENZA
    assert stopped_after(motion, 1) is Motion.MOTORI_FERMI


@pytest.mark.parametrize("status", [SAFE, CARE])
def test_release_needs_standstill_and_no_critical_state(status):
    motion = braking()
    assert stopped_after(motion, 30, MOVING, status) is Motion.IN_FRENATA_DI_EMERGENZA
    assert stopped_after(motion, 60) is Motion.MOTORI_FERMI
    step(motion, rover_status=status, y_norm=1.0, x_norm=1.0, cmd=SupervisorCommand.CMD_GO_LEFT)
    assert motion.state is Motion.NORMALE_MARCIA
    assert (motion.v_ref, motion.omega_ref, motion.emergency_stop) == (0, 0, False)
    assert motion.current_action is NORMAL
    assert motion.user.v_user == (1.0 if status is SAFE else 0.5)


def test_a_new_stop_needs_a_new_standstill():
    motion = braking()
    stopped_after(motion, 60)
    step(motion)
    step(motion, rover_status=STOP, wheel_speed_rpm=MOVING)
    assert not motion.estop_recover_enabled
    assert step(motion, wheel_speed_rpm=MOVING).emergency_stop
