"""The reference charts of both boards, row by row, run on the interpreter.

A scenario is a list of blocks: a number of steps, and what is given meanwhile; what is not given is
at rest.  Steps count from 1, the step in which the charts are entered.
"""

from collections.abc import Mapping, Sequence
from fractions import Fraction

import pytest

from rovercheck.spec_model.board1 import REFERENCES
from rovercheck.spec_model.board1.backward import toggle
from rovercheck.spec_model.board1.limits import update_safety_limits
from rovercheck.spec_model.board1.motion import motion_with_free_error
from rovercheck.spec_model.board1.safety import safety_state
from rovercheck.spec_model.board2.backward import toggle_2
from rovercheck.spec_model.board2.motion import (
    check_stop_2,
    motion_2_with_free_error,
    motion_supervision_2,
)
from rovercheck.spec_model.lang.chart import Enabled
from rovercheck.spec_model.lang.evaluate import evaluate
from rovercheck.spec_model.lang.interpret import Interpreter
from rovercheck.spec_model.lang.system import System, in_order
from rovercheck.spec_model.manoeuvres.rotation import angle180, angleError
from rovercheck.spec_model.signals import board1 as b1
from rovercheck.spec_model.signals.board2_supervisor import autorized_to_send_command
from rovercheck.spec_model.signals.rotation import ERROR_CLASSES, GRID, HEADING

Given = Mapping[str, bool | float | str]
Block = tuple[int, Given]

BOARD1 = in_order("board1_references", REFERENCES)
FREE1 = in_order("board1_free", safety_state, update_safety_limits, motion_with_free_error)
BOARD2 = in_order(
    "board2_references", Enabled(autorized_to_send_command, check_stop_2, toggle_2, motion_supervision_2)
)
FREE2 = in_order("board2_free", motion_2_with_free_error)
TOGGLE = in_order("toggle", toggle)

DRIVING: Given = {"autorized_to_send_command": True, "B2.rover_safety_state": "SAFETY_DEGRADED"}
STICK_BACK: Given = {"y_norm": -1}


def run(system: System, blocks: Sequence[Block], always: Given | None = None) -> list[dict[str, str]]:
    """Every variable after every step, as shown to people; the step's number is the index."""
    rover = Interpreter(system)
    shown: list[dict[str, str]] = [{}]
    for steps, given in blocks:
        values = {**(always or {}), **given}
        inputs = {n: v.domain.raw(values[n]) if n in values else v.init for n, v in system.inputs.items()}
        for _ in range(steps):
            rover.step(inputs)
            shown.append({n: v.domain.show(rover.data[n]) for n, v in system.written.items()})
    return shown


def seen(shown: Sequence[Mapping[str, str]], signal: str) -> list[str]:
    """The signal in every step from 1 on."""
    return [at[signal] for at in shown[1:]]


# --- toggle of backward mode ------------------------------------------------------------------------

NONE: Given = {}
ONE: Given = {"btn1": True}
TWO: Given = {"btn2": True}


def presses(*gaps: int) -> list[Block]:
    """btn1, btn1, btn2, btn2 with so many steps from press to press; the first press is in step 2."""
    blocks: list[Block] = [(1, NONE), (1, ONE)]
    for gap, button in zip(gaps, (ONE, TWO, TWO), strict=True):
        blocks += [(gap - 1, NONE), (1, button)]
    return [*blocks, (1, NONE)]


@pytest.mark.parametrize("press", [0, 1, 2])
@pytest.mark.parametrize(("gap", "counts"), [(49, True), (50, True), (51, False)])
def test_a_press_counts_up_to_one_second_after_the_one_before(press: int, gap: int, counts: bool) -> None:
    gaps = [5, 5, 5]
    gaps[press] = gap
    assert run(TOGGLE, presses(*gaps))[-1]["backward_enabled"] == ("true" if counts else "false")


def test_the_combination_switches_backward_mode_on_and_off() -> None:
    once = presses(5, 5, 5)
    shown = seen(run(TOGGLE, [*once, *once[1:]]), "backward_enabled")
    assert (shown[15], shown[16], shown[-3], shown[-2]) == ("false", "true", "true", "false")


@pytest.mark.parametrize("touched", [{"x_norm": 1}, {"y_norm": 0.4}])
def test_the_stick_ends_the_combination(touched: Given) -> None:
    blocks = presses(5, 5, 5)
    blocks[4] = (4, touched)
    assert run(TOGGLE, blocks)[-1]["backward_enabled"] == "false"


def test_a_button_held_down_is_one_press() -> None:
    assert run(TOGGLE, [(1, NONE), (60, ONE), (60, TWO), (1, NONE)])[-1]["backward_enabled"] == "false"


def test_a_button_pressed_in_the_first_step_is_no_press() -> None:
    late: list[Block] = [(1, ONE), (1, NONE), (1, ONE), (1, NONE), (1, TWO), (1, NONE), (1, TWO)]
    assert run(TOGGLE, late)[-1]["backward_enabled"] == "false"


def test_the_combination_waits_while_board_2_drives() -> None:
    blocks = presses(5, 5, 5)
    frozen = [*blocks[:3], (100, {"give_b2_actuation": True}), *blocks[3:]]
    assert run(BOARD1, frozen)[-1]["backward_enabled"] == "true"


# --- 180° rotation of Board 1 ----------------------------------------------------------------------


def test_the_rotation_is_entered_and_aims_at_the_opposite_heading() -> None:
    shown = run(BOARD1, [(2, {"current_yaw": 90}), (2, {"current_yaw": 90, **STICK_BACK})])
    entered, next_step = shown[3], shown[4]
    assert (entered["current_action"], entered["is_rotating180"]) == ("CMD_ROTATE_180", "true")
    assert (entered["targetAngle180"], entered["angle_err"], entered["omega_ref"]) == ("270", "-180", "0")
    assert (next_step["angle_err"], next_step["omega_ref"]) == ("-180", "1")


@pytest.mark.parametrize(
    ("y", "action"), [(-0.4, "CMD_NORMAL"), (-0.5, "CMD_NORMAL"), (-1, "CMD_ROTATE_180")]
)
def test_only_a_stick_beyond_half_asks_for_the_rotation(y: float, action: str) -> None:
    assert run(BOARD1, [(2, NONE), (1, {"y_norm": y})])[-1]["current_action"] == action


LAW = {  # error: reference of the healthy rover
    -180: "1", -90: "1", -45: "0.225", -30: "0.15", -15: "0.075", -10: "0.075", -7.5: "0.075", -5: "0.075",
    0: "0", 5: "-0.075", 7.5: "-0.075", 10: "-0.075", 15: "-0.075", 30: "-0.15", 45: "-0.225", 90: "-1",
}  # fmt: skip
FAR = {-180, -90, 90}


def rotating(error: float, **given: bool | float | str) -> list[Block]:
    """Turning at full speed, then one step with this error."""
    turning: Given = {"rotation_error": 90, **given}
    return [(2, NONE), (1, STICK_BACK), (1, turning), (1, {**turning, "rotation_error": error})]


@pytest.mark.parametrize("error", LAW)
def test_the_law_of_the_rotation(error: float) -> None:
    assert run(FREE1, rotating(error))[-1]["omega_ref"] == LAW[error]


@pytest.mark.parametrize("error", LAW)
def test_a_degraded_rover_keeps_its_angular_reference_near_the_target(error: float) -> None:
    shown = run(FREE1, rotating(error, b1_degraded=True))[-1]
    assert shown["omega_ref"] == ({"1": "0.5", "-1": "-0.5"}[LAW[error]] if error in FAR else "-0.5")


@pytest.mark.parametrize("error", LAW)
def test_board_2_keeps_its_angular_reference_near_the_target(error: float) -> None:
    always = {"B2.rover_safety_state": "SAFETY_DEGRADED"}
    turning = {"B2.rotation_error": 90}
    blocks: list[Block] = [
        (2, NONE), (1, {"ay_norm": -1}), (1, turning), (1, {"B2.rotation_error": error}),
    ]  # fmt: skip
    shown = run(FREE2, blocks, always)[-1]["omega_ref_actuation"]
    assert shown == ({"1": "0.5", "-1": "-0.5"}[LAW[error]] if error in FAR else "-0.5")


@pytest.mark.parametrize(
    ("error", "ends"), [(0, True), (5, True), (-5, True), (7.5, False), (-7.5, False), (10, False)]
)
def test_the_rotation_ends_below_7_5_degrees_one_step_later(error: float, ends: bool) -> None:
    blocks = [*rotating(error), (1, {"rotation_error": 90})]
    shown = seen(run(FREE1, blocks), "current_action")
    assert shown[-2:] == ["CMD_ROTATE_180", "CMD_NORMAL" if ends else "CMD_ROTATE_180"]


def test_the_rotation_keeps_the_linear_reference() -> None:
    shown = run(BOARD1, [(3, {"y_norm": 1}), (20, STICK_BACK)])
    assert (shown[-1]["current_action"], shown[-1]["v_ref"]) == ("CMD_ROTATE_180", "1")


# --- the stick pulled back after the rotation -------------------------------------------------------

AROUND: list[Block] = [(2, NONE), (2, STICK_BACK), (1, {**STICK_BACK, "current_yaw": 180})]
"""The rotation is complete; the next step leaves it."""


def test_the_stick_still_pulled_back_means_forward() -> None:
    back: Given = {**STICK_BACK, "current_yaw": 180}
    shown = run(BOARD1, [*AROUND, (2, back)])
    assert [at["invert_y"] for at in shown[5:]] == ["false", "true", "true"]
    assert shown[-1]["v_user"] == "1"


def test_a_stick_not_pulled_back_keeps_its_meaning() -> None:
    shown = run(BOARD1, [*AROUND, (2, {"current_yaw": 180})])
    assert (shown[-1]["invert_y"], shown[-1]["current_action"]) == ("false", "CMD_NORMAL")


def test_a_released_stick_gets_its_meaning_back() -> None:
    back: Given = {**STICK_BACK, "current_yaw": 180}
    shown = run(BOARD1, [*AROUND, (2, back), (1, {"current_yaw": 180}), (1, {"y_norm": -0.4})])
    assert [at["invert_y"] for at in shown[7:]] == ["true", "false", "false"]
    assert shown[-1]["v_user"] == "-0.4"


def test_an_emergency_stop_gives_the_stick_its_meaning_back() -> None:
    back: Given = {**STICK_BACK, "current_yaw": 180}
    shown = run(BOARD1, [*AROUND, (2, back), (1, {**back, "b1_critical": True})])
    assert (shown[-1]["invert_y"], shown[-1]["current_action"]) == ("false", "CMD_ESTOP")


# --- emergency stop -----------------------------------------------------------------------------------

ESTOP: Given = {"cmd": "CMD_ESTOP", "y_norm": 1}


def test_the_rotation_ignores_an_emergency_stop_of_board_2() -> None:
    shown = run(BOARD1, [(2, NONE), (2, STICK_BACK), (3, ESTOP)])
    assert (shown[-1]["current_action"], shown[-1]["actuate_emergency_stop"]) == ("CMD_ROTATE_180", "false")


def test_a_critical_cause_ends_the_rotation() -> None:
    shown = run(BOARD1, [(2, NONE), (2, STICK_BACK), (1, {"b1_critical": True})])[-1]
    assert (shown["current_action"], shown["is_rotating180"]) == ("CMD_ESTOP", "false")


def released(turning_again: Sequence[Block]) -> list[int]:
    """The steps in which the emergency stop is released."""
    stop = seen(run(BOARD1, turning_again), "actuate_emergency_stop")
    return [k for k in range(2, len(stop) + 1) if stop[k - 2] == "true" and stop[k - 1] == "false"]


RESTING: Given = {"wheels_below_2_5": True}


def test_the_stop_is_released_after_the_rover_has_been_at_rest_for_1_02_s() -> None:
    # Stopped in step 4; at rest from step 11 on: at rest for 51 steps in step 62, released in step 63.
    stopped: list[Block] = [(3, {"y_norm": 1}), (1, ESTOP), (6, NONE), (60, RESTING)]
    assert released(stopped) == [11 + 51 + 1]


def test_a_second_stop_is_released_one_step_earlier_for_what_was_remembered_of_the_first() -> None:
    first: list[Block] = [(3, {"y_norm": 1}), (1, ESTOP), (60, RESTING)]
    second: list[Block] = [(3, {"y_norm": 1}), (1, ESTOP), (60, RESTING)]
    assert released([*first, *second]) == [5 + 51 + 1, 64 + 4 + 51 + 1]


def test_wheels_that_turn_start_the_rest_anew() -> None:
    stopped: list[Block] = [(3, {"y_norm": 1}), (1, ESTOP), (50, RESTING), (1, NONE), (60, RESTING)]
    assert released(stopped) == [56 + 51 + 1]


def test_board_2_does_not_wait_for_wheel_speeds_that_do_not_arrive() -> None:
    stop: Given = {"ay_norm": 1, "B2.cmd": "CMD_ESTOP"}
    turning: Given = {f"B2.wheel_speed_rpm_{w}": 60 for w in b1.WHEELS}
    silent: Given = {**turning, "B2.rx_status": "RX_CRITICAL"}
    blocks: list[Block] = [
        (2, turning),
        (1, {**turning, "ay_norm": 1}),
        (1, {**turning, **stop}),
        (110, silent),
    ]
    shown = seen(run(BOARD2, blocks, DRIVING), "B2.current_action")
    assert (shown.index("CMD_ESTOP") + 1, shown.index("CMD_STOP") + 1) == (4, 104)
    assert "CMD_STOP" not in seen(
        run(BOARD2, [*blocks[:3], (200, {**turning, **stop})], DRIVING), "B2.current_action"
    )


# --- while the other board drives (G12) ------------------------------------------------------------------


def test_everything_is_frozen_while_board_2_drives() -> None:
    frozen: Given = {"give_b2_actuation": True, "current_yaw": 270, "y_norm": 1, "b1_critical": True}
    shown = run(BOARD1, [(2, NONE), (3, STICK_BACK), (100, frozen), (2, {"current_yaw": 90})])
    assert shown[5] == shown[105]
    assert (shown[106]["targetAngle180"], shown[106]["angle_err"]) == ("180", "90")


def test_board_2_resumes_where_it_was() -> None:
    back: Given = {"ay_norm": -1}
    away: Given = {"autorized_to_send_command": False, "yaw": 90}
    shown = run(BOARD2, [(2, NONE), (3, back), (100, away), (1, {"yaw": 90})], DRIVING)
    assert shown[5] == shown[105]
    assert (shown[106]["B2.targetAngle180"], shown[106]["B2.angle_err"]) == ("180", "90")


# --- why the heading may be free -------------------------------------------------------------------------


def test_the_error_of_entry_is_minus_180_for_every_heading() -> None:
    aim = angleError(b1.current_yaw, angle180(b1.current_yaw))
    assert {Fraction(evaluate(aim, {"current_yaw": yaw})) * GRID for yaw in HEADING.values} == {-180}


@pytest.mark.parametrize("target", [0, 90, 357.5, 360])
def test_every_error_is_that_of_some_heading(target: float) -> None:
    aim = angleError(b1.current_yaw, b1.targetAngle)
    at = b1.targetAngle.domain.raw(target)
    errors = {evaluate(aim, {"current_yaw": yaw, "targetAngle180": at}) for yaw in HEADING.values}
    assert errors == set(b1.angle_err.domain.values)
    assert set(ERROR_CLASSES.values) < errors
