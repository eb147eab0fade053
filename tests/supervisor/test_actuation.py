"""The motor commands of Board 2, against the document: limits, rate, first authorised step, stop pin."""

from math import inf, nan

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rovercheck.supervisor.board2.actuation import Actuated, Actuation, MotorCommand, next_rpm


def started() -> Actuation:
    """Authorised, with the driver initialised."""
    actuation = Actuation()
    actuation.step(True, 0, 0, False)
    return actuation


def rpm(actuation: Actuation, count: int, v_ref: float, omega_ref: float) -> tuple[float, float]:
    """Left and right after so many authorised steps."""
    for _ in range(count):
        motors = actuation.step(True, v_ref, omega_ref, False).motors
    assert motors is not None
    return motors.left_rpm, motors.right_rpm


def test_nothing_is_sent_without_authorisation():
    actuation = Actuation()
    for _ in range(3):
        assert actuation.step(False, 0.5, 0, False) == Actuated(True, driver_timeout_ms=None, motors=None)


def test_the_first_authorised_step_after_power_up_only_initialises_the_driver():
    actuation = Actuation()
    assert actuation.step(True, 0.5, 0, False) == Actuated(stop_pin=True, driver_timeout_ms=300)
    assert actuation.step(True, 0.5, 0, False) == Actuated(stop_pin=False, motors=MotorCommand(4, 4))
    assert actuation.step(True, 0.5, 0, True) == Actuated(stop_pin=True, motors=MotorCommand(8, 8))


@pytest.mark.parametrize("stop", [False, True])
def test_the_stop_pin_keeps_its_level_without_authorisation(stop):
    actuation = started()
    actuation.step(True, 0, 0, stop)
    assert actuation.step(False, 0, 0, not stop) == Actuated(stop_pin=stop)
    assert actuation.step(True, 0, 0, not stop).stop_pin is not stop


def test_a_new_authorisation_starts_from_rest_without_initialising_again():
    actuation = started()
    assert rpm(actuation, 20, 0.5, 0) == (80, 80)
    actuation.step(False, 0.5, 0, False)
    assert actuation.step(True, 0.5, 0, False) == Actuated(stop_pin=False, motors=MotorCommand(4, 4))


@pytest.mark.parametrize(
    ("v_ref", "omega_ref", "left", "right"),
    [(0.5, 0, 80, 80), (0.25, 0, 40, 40), (0, 0.25, -40, 40), (0.25, -0.25, 80, 0)]
    + [(0.5, 0.5, 0, 80), (-0.5, 0.5, -80, 0), (0.5, -0.25, 80, 40), (1, 0, 80, 80), (-1, 0, -80, -80)],
)
def test_references_become_rpm_of_the_sides_within_80(v_ref, omega_ref, left, right):
    assert rpm(started(), 20, v_ref, omega_ref) == (left, right)
    assert rpm(started(), 40, v_ref, omega_ref) == (left, right)


def test_a_side_changes_by_4_rpm_from_one_command_to_the_next():
    actuation = started()
    assert [rpm(actuation, 1, 0.5, 0)[0] for _ in range(21)] == [*range(4, 81, 4), 80]
    assert [rpm(actuation, 1, -0.5, 0)[0] for _ in range(41)] == [*range(76, -81, -4), -80]


@pytest.mark.parametrize(
    ("reference", "expected"), [(3 / 160, 3), (4 / 160, 4), (5 / 160, 4), (-5 / 160, -4)]
)
def test_a_change_of_4_rpm_is_allowed(reference, expected):
    assert next_rpm(0, reference) == pytest.approx(expected, abs=1e-12)


def test_full_scale_is_12_volts_and_the_wheels_of_a_side_get_the_same():
    assert MotorCommand(80, -40).volts == (6, -3, 6, -3)


@pytest.mark.parametrize("reference", [nan, inf, -inf])
def test_a_reference_that_is_no_number_asks_for_rest(reference):
    actuation = started()
    rpm(actuation, 20, 0.5, 0)
    assert rpm(actuation, 1, reference, 0) == (76, 76)
    assert rpm(actuation, 30, reference, 0) == (0, 0)
    assert rpm(actuation, 30, 0, reference) == (0, 0)


@given(st.lists(st.tuples(st.booleans(), st.floats(), st.floats()), min_size=1))
def test_every_command_keeps_the_limits(steps):
    actuation, before = Actuation(), MotorCommand()
    for autorized, v_ref, omega_ref in steps:
        motors = actuation.step(autorized, v_ref, omega_ref, False).motors
        assert motors is None or autorized
        before, last = motors or MotorCommand(), before
        for side, side_before in ((before.left_rpm, last.left_rpm), (before.right_rpm, last.right_rpm)):
            assert abs(side) <= 80
            assert motors is None or abs(side - side_before) <= 4 + 1e-9
