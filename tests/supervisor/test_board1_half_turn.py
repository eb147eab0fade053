"""The half turn of Board 1: its start, its law on both sides of its boundaries, its end, the inversion."""

from math import inf, nan, nextafter

import pytest

from rovercheck.supervisor.board1.states import Motion
from tests.supervisor.board1_motions import CARE, NORMAL, SAFE, rotating, started, step


@pytest.mark.parametrize(
    "y, backward, starts",
    [(-1.0, False, True), (nextafter(-0.5, -1), False, True), (-0.5, False, False), (-1.0, True, False)],
)
def test_pulling_back_starts_a_half_turn(y, backward, starts):
    motion = step(started(), y_norm=y, backward_enabled=backward)
    assert (motion.state is Motion.RETROMARCIA_180) == motion.is_rotating180 == starts


def test_a_half_turn_starts_with_its_target():
    motion = rotating(yaw=200.0)
    assert (motion.target_angle, motion.angle_err) == (20, -180)
    assert (motion.v_ref, motion.omega_ref) == (0, 0)


def test_a_half_turn_keeps_the_speed_before_it():
    motion = step(step(started(), y_norm=1.0), y_norm=-1.0)
    assert step(motion, y_norm=-1.0).v_ref == 1.0


@pytest.mark.parametrize(
    "yaw, omega_ok, omega_degraded",
    [
        (0.0, 1.0, 0.5),
        (134.5, -1.0, -0.5),
        (135.0, -0.225, 9.0),
        (135.5, -0.2225, 9.0),
        (165.0, -0.075, 9.0),
        (175.0, -0.075, 9.0),
        (180.0, 0.0, 9.0),
        (190.0, 0.075, 9.0),
        (225.0, 0.225, 9.0),
        (225.5, 1.0, 0.5),
    ],
)
def test_rotation_law(yaw, omega_ok, omega_degraded):
    for status, omega in ((SAFE, omega_ok), (CARE, omega_degraded)):
        motion = rotating()
        motion.omega_ref = 9.0
        step(motion, yaw=yaw, y_norm=-1.0, rover_status=status)
        assert motion.state is Motion.RETROMARCIA_180
        assert motion.omega_ref == pytest.approx(omega)


@pytest.mark.parametrize("yaw, done", [(172.5, False), (172.6, True), (187.4, True), (187.5, False)])
def test_a_half_turn_ends_near_its_target_one_step_later(yaw, done):
    motion = step(rotating(), yaw=yaw)
    assert motion.is_rotating180
    step(motion, yaw=yaw)
    assert (motion.state is Motion.NORMALE_MARCIA) == done == (not motion.is_rotating180)
    assert (motion.current_action is NORMAL) == done


def test_backward_means_forward_after_a_half_turn_until_the_joystick_returns():
    motion = step(rotating(), yaw=180.0, y_norm=-0.4)
    step(motion, yaw=180.0, y_norm=-0.4)
    assert motion.user.invert_y and motion.user.v_user == -0.4
    step(motion, yaw=180.0, y_norm=-0.4)
    assert (motion.user.v_user, motion.v_ref) == (0.4, 0.0)
    step(motion, yaw=180.0, y_norm=-0.4, backward_enabled=True)
    assert motion.v_ref == 0.4
    step(motion)
    assert not motion.user.invert_y
    assert step(motion, y_norm=-0.4, backward_enabled=True).v_ref == -0.4


def test_a_half_turn_that_ends_with_the_joystick_centred_inverts_nothing():
    motion = step(step(rotating(), yaw=180.0), yaw=180.0)
    assert motion.state is Motion.NORMALE_MARCIA
    assert not motion.user.invert_y


@pytest.mark.parametrize("yaw", [nan, inf, -inf])
def test_a_heading_that_is_no_number(yaw):
    assert step(started(), y_norm=-1.0, yaw=yaw).state is Motion.NORMALE_MARCIA
    motion = step(step(started(), y_norm=1.0), y_norm=-1.0)
    step(motion, y_norm=-1.0)
    step(motion, y_norm=-1.0, yaw=yaw)
    assert (motion.state, motion.v_ref, motion.omega_ref) == (Motion.RETROMARCIA_180, 0, 0)
    assert motion.angle_err == -180
    assert step(motion, y_norm=-1.0).omega_ref == 1.0
