"""The motion of Board 2: references, half turn, and the emergency stop with and without a link."""

from dataclasses import dataclass, field, replace
from typing import Any

import pytest

from rovercheck.supervisor.board2.motion import Motion, MotionInputs, State
from rovercheck.supervisor.types import Level, SafetyState, SupervisorCommand

STANDING, MOVING = (0.0,) * 4, (60.0,) * 4
DEGRADED, CRITICAL = SafetyState.SAFETY_DEGRADED, SafetyState.SAFETY_CRITICAL
ESTOP, NORMAL = SupervisorCommand.CMD_ESTOP, SupervisorCommand.CMD_NORMAL
AT_REST = MotionInputs(NORMAL, 0.0, STANDING, 0.0, 0.0, DEGRADED, Level.OK, False)


@dataclass
class Rover:
    """A motion chart with inputs that keep their values."""

    motion: Motion = field(default_factory=Motion)
    inputs: MotionInputs = AT_REST

    def step(self, steps: int = 1, **changes: Any) -> Motion:
        self.inputs = replace(self.inputs, **changes)
        for _ in range(steps):
            self.motion.step(self.inputs)
        return self.motion

    @property
    def references(self) -> tuple[float, float]:
        return self.motion.v_ref, self.motion.omega_ref


def braking(**changes: Any) -> Rover:
    """A rover in its entry step of In_frenata_di_emergenza, wheels turning."""
    rover = Rover()
    rover.step(2, y_norm=1.0, wheel_speed_rpm=MOVING)
    rover.step(cmd=ESTOP, **changes)
    assert rover.motion.state is State.IN_FRENATA_DI_EMERGENZA
    return rover


def turning() -> Rover:
    """A rover in the entry step of a half turn from heading 10 to 190."""
    rover = Rover()
    rover.step(2, x_norm=0.3)
    rover.step(y_norm=-0.6, yaw=10.0)
    assert rover.motion.state is State.RETROMARCIA_180
    return rover


def test_the_first_step_only_enters_normal_running() -> None:
    rover = Rover()
    motion = rover.step(x_norm=1.0, y_norm=1.0, cmd=ESTOP, safety_state=CRITICAL)
    assert motion.state is State.NORMALE_MARCIA and motion.current_action is NORMAL
    assert rover.references == (0.0, 0.0) and not motion.emergency_stop


@pytest.mark.parametrize(
    ("x", "y", "backward", "references"),
    (
        (1.0, 1.0, False, (0.5, 0.5)),
        (-1.0, 0.4, False, (0.2, -0.5)),
        (0.0, -0.4, False, (0.0, 0.0)),
        (0.0, -0.4, True, (-0.2, 0.0)),
        (0.0, -1.0, True, (-0.5, 0.0)),
        (0.6, 0.0, False, (0.0, 0.3)),
    ),
)
def test_the_references_are_half_of_what_the_user_asks(
    x: float, y: float, backward: bool, references: tuple[float, float]
) -> None:
    rover = Rover()
    rover.step()
    rover.step(x_norm=x, y_norm=y, backward_enabled=backward)
    assert rover.references == pytest.approx(references)


@pytest.mark.parametrize(("y", "turns"), ((-0.5, False), (-0.51, True), (-1.0, True)))
def test_a_half_turn_begins_below_half_back(y: float, turns: bool) -> None:
    for backward in (False, True):
        rover = Rover()
        rover.step()
        rover.step(y_norm=y, backward_enabled=backward)
        assert (rover.motion.state is State.RETROMARCIA_180) is (turns and not backward)


def test_the_entry_of_a_half_turn_writes_no_reference() -> None:
    rover = turning()
    assert rover.motion.current_action is SupervisorCommand.CMD_ROTATE_180
    assert rover.references == (0.0, 0.15)
    rover.step()
    assert rover.references == (0.0, 0.5)  # the error of 180 is wrapped to -180: left


@pytest.mark.parametrize(
    ("yaw", "omega"),
    ((20.0, -0.5), (0.0, 0.5), (144.9, -0.5), (145.0, 0.15), (180.0, 0.15), (235.0, 0.15), (235.1, 0.5)),
)
def test_the_turn_coasts_on_the_last_reference_in_the_last_45_degrees(yaw: float, omega: float) -> None:
    rover = turning()
    rover.step(yaw=yaw)
    assert rover.motion.omega_ref == omega


@pytest.mark.parametrize(
    ("yaw", "over"), ((182.5, False), (182.6, True), (190.0, True), (197.4, True), (197.5, False))
)
def test_the_turn_is_over_within_7_5_degrees_one_step_later(yaw: float, over: bool) -> None:
    rover = turning()
    assert rover.step(yaw=yaw).state is State.RETROMARCIA_180
    assert (rover.step().state is State.NORMALE_MARCIA) is over
    assert rover.motion.is_rotating180 is not over


def test_after_the_turn_pulling_back_drives_forward_until_released() -> None:
    rover = turning()
    rover.step(2, yaw=190.0, y_norm=-0.4)
    assert rover.motion.user.invert_y
    rover.step(backward_enabled=True)
    assert rover.motion.v_ref == pytest.approx(0.2)
    rover.step(y_norm=0.0)
    assert not rover.motion.user.invert_y
    rover.step(y_norm=-0.4)
    assert rover.motion.v_ref == pytest.approx(-0.2)


def test_a_released_joystick_at_the_end_of_the_turn_inverts_nothing() -> None:
    rover = turning()
    rover.step(2, yaw=190.0, y_norm=0.0)
    assert rover.motion.state is State.NORMALE_MARCIA and not rover.motion.user.invert_y


def test_an_obstacle_stops_a_rover_that_was_asked_forward_in_the_step_before() -> None:
    rover = Rover()
    rover.step(2)
    assert rover.step(cmd=ESTOP, y_norm=1.0).state is State.NORMALE_MARCIA
    assert rover.step(y_norm=0.0).state is State.IN_FRENATA_DI_EMERGENZA
    assert rover.references == (0.0, 0.0) and rover.motion.emergency_stop
    assert rover.motion.current_action is ESTOP


@pytest.mark.parametrize("y", (0.0, -0.4))
def test_an_obstacle_does_not_stop_a_rover_not_asked_forward(y: float) -> None:
    rover = Rover()
    rover.step(y_norm=y)
    assert rover.step(10, cmd=ESTOP).state is State.NORMALE_MARCIA


def test_an_obstacle_does_not_stop_a_half_turn_but_an_emergency_does() -> None:
    rover = turning()
    rover.step(y_norm=1.0)
    assert rover.step(5, cmd=ESTOP).state is State.RETROMARCIA_180
    rover.step(safety_state=CRITICAL)
    assert rover.motion.state is State.IN_FRENATA_DI_EMERGENZA
    assert not rover.motion.is_rotating180 and not rover.motion.user.invert_y


def test_standstill_is_believed_51_steps_after_it_is_first_measured() -> None:
    rover = braking()
    rover.step(3)
    rover.step(wheel_speed_rpm=STANDING)
    assert rover.step(50).state is State.IN_FRENATA_DI_EMERGENZA
    assert rover.step().state is State.MOTORI_FERMI
    assert rover.motion.current_action is SupervisorCommand.CMD_STOP and rover.motion.emergency_stop


@pytest.mark.parametrize(("rpm", "stands"), ((2.5, False), (-2.5, False), (2.49, True), (-2.49, True)))
def test_a_wheel_below_2_5_rpm_stands(rpm: float, stands: bool) -> None:
    rover = braking()
    rover.step(52, wheel_speed_rpm=(0.0, 0.0, rpm, 0.0))
    assert (rover.motion.state is State.MOTORI_FERMI) is stands


@pytest.mark.parametrize("speed", (float("nan"), float("inf"), float("-inf")))
def test_a_wheel_whose_speed_is_no_number_does_not_stand(speed: float) -> None:
    rover = braking()
    rover.step(200, wheel_speed_rpm=(0.0, speed, 0.0, 0.0))
    assert rover.motion.state is State.IN_FRENATA_DI_EMERGENZA


def test_a_wheel_that_moves_once_begins_the_standstill_anew() -> None:
    rover = braking()
    rover.step(50, wheel_speed_rpm=STANDING)
    rover.step(wheel_speed_rpm=MOVING)
    rover.step(wheel_speed_rpm=STANDING)
    assert rover.step(50).state is State.IN_FRENATA_DI_EMERGENZA
    assert rover.step().state is State.MOTORI_FERMI


def test_the_standstill_of_the_last_stop_counts_in_the_entry_step() -> None:
    rover = braking()
    rover.step(52, wheel_speed_rpm=STANDING)
    rover.step(cmd=NORMAL)
    rover.step(2)
    rover.step(cmd=ESTOP)
    assert rover.step(50).state is State.IN_FRENATA_DI_EMERGENZA
    assert rover.step().state is State.MOTORI_FERMI


def test_without_a_link_braking_ends_after_100_steps() -> None:
    rover = braking(rx_status=Level.CRITICAL)
    assert rover.step(99).state is State.IN_FRENATA_DI_EMERGENZA
    assert rover.step().state is State.MOTORI_FERMI
    assert rover.motion.estop_recover_enabled


@pytest.mark.parametrize("rx_status", (Level.OK, Level.DEGRADED))
def test_with_a_link_turning_wheels_brake_for_ever(rx_status: Level) -> None:
    rover = braking(rx_status=rx_status)
    assert rover.step(300).state is State.IN_FRENATA_DI_EMERGENZA


def test_a_link_lost_late_ends_the_braking_at_once() -> None:
    rover = braking()
    rover.step(150)
    assert rover.step(rx_status=Level.CRITICAL).state is State.MOTORI_FERMI


def test_at_rest_the_rover_recovers_in_the_next_step_unless_critical() -> None:
    rover = braking(rx_status=Level.CRITICAL)
    rover.step(100, safety_state=CRITICAL)
    assert rover.step(10).state is State.MOTORI_FERMI
    motion = rover.step(safety_state=DEGRADED)
    assert motion.state is State.NORMALE_MARCIA and not motion.emergency_stop
    assert rover.references == (0.0, 0.0)  # the entry writes no reference
    assert rover.step().state is State.IN_FRENATA_DI_EMERGENZA  # the obstacle is still there


def test_braking_is_not_left_before_the_rover_rests() -> None:
    rover = braking(safety_state=CRITICAL)
    assert rover.step(20, safety_state=DEGRADED, cmd=NORMAL).state is State.IN_FRENATA_DI_EMERGENZA


def test_a_new_stop_forgets_that_the_rover_may_recover() -> None:
    rover = braking(rx_status=Level.CRITICAL)
    rover.step(100)
    rover.step(2)
    assert rover.motion.state is State.IN_FRENATA_DI_EMERGENZA
    assert not rover.motion.estop_recover_enabled


def test_a_stop_ends_the_inversion_of_a_half_turn() -> None:
    rover = turning()
    rover.step(2, yaw=190.0, y_norm=-0.4)
    rover.step(backward_enabled=True, rx_status=Level.CRITICAL)
    rover.step(cmd=ESTOP)
    assert rover.motion.state is State.IN_FRENATA_DI_EMERGENZA and not rover.motion.user.invert_y
    rover.step(101, cmd=NORMAL)
    assert rover.step().v_ref == pytest.approx(-0.2)


def test_the_references_of_the_first_step_are_what_the_second_one_stops_for() -> None:
    for y, state in ((1.0, State.IN_FRENATA_DI_EMERGENZA), (0.0, State.NORMALE_MARCIA)):
        rover = Rover()
        rover.step(y_norm=y)
        assert rover.step(cmd=ESTOP, y_norm=0.0).state is state


def test_the_references_of_the_recovery_step_are_what_the_next_one_stops_for() -> None:
    rover = braking(rx_status=Level.CRITICAL)
    rover.step(100)
    assert rover.step(y_norm=0.0).state is State.NORMALE_MARCIA
    assert rover.step().state is State.NORMALE_MARCIA


def test_the_turn_goes_the_shorter_way_from_where_the_rover_is() -> None:
    rover = turning()
    rover.step(yaw=100.0)
    assert rover.motion.omega_ref == -0.5  # 90 degrees clockwise are left: turn right
    rover.step(yaw=280.0)
    assert rover.motion.omega_ref == 0.5


def test_the_opposite_of_180_is_reached_across_north() -> None:
    rover = Rover()
    rover.step()
    rover.step(y_norm=-0.6, yaw=180.0)
    rover.step(2, yaw=359.0)
    assert rover.motion.state is State.NORMALE_MARCIA
