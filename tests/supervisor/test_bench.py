"""The bench as a whole: clocks and phases, what boards may assume of their inputs, who drives, damage."""

from collections.abc import Callable, Sequence
from itertools import pairwise
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rovercheck.supervisor.bench import Record
from rovercheck.supervisor.bench.columns import inputs1, inputs2, outputs1, outputs2
from rovercheck.supervisor.bench.record import Driver, Side
from rovercheck.supervisor.types import Level, SupervisorCommand
from tests.profiles import examples
from tests.supervisor.bench_runs import at, board1, board2, first, run

FORWARD = at("0.3 s", stick_y=1.0)
DISTURBED = st.fixed_dictionaries(
    {
        "phase": st.integers(0, 19).map("{} ms".format),
        "drift": st.sampled_from(["0 ppm", "50 ppm", "-7000 ppm", "9000 ppm"]),
        "seed": st.integers(0, 3),
        "initial": st.fixed_dictionaries(
            {
                "frame_loss": st.sampled_from([0.0, 0.3]),
                "bit_errors": st.sampled_from([0.0, 0.002]),
                "stick_y": st.sampled_from([0.0, -1.0, 1.0]),
                "obstacle_left": st.sampled_from(["none", "50 cm", "200 cm"]),
            }
        ),
    }
)
FAULT = at("0.5 s", **{"for": "0.3 s", "temperature": "70 °C", "joystick": "silent"})


# --- what is true of every run -----------------------------------------------------------------------


@given(DISTURBED)
@examples(6)
def test_two_runs_of_a_scenario_are_equal(keys: dict[str, Any]) -> None:
    assert run(FAULT, duration="1 s", **keys) == run(FAULT, duration="1 s", **keys)


STAMPED1 = {
    "temp_last_valid_ms": ("temperature_degC",),
    "batt_last_valid_ms": ("battery_pct",),
    "b2_data_last_valid_ms": ("cmd", "x_norm", "y_norm", "current_yaw", "crit_mask_b2", "last_valid_b2_ms"),
}
STAMPED2 = {
    "sonar_last_valid_ms": ("d1", "d2", "d3"),
    "imu_last_valid_ms": ("yaw", "gz_dps"),
    "ble_last_valid_ms": ("ay_norm", "bx_norm"),
    "b1_data_last_valid_ms": ("crit_mask_b1", "wheel_speed_rpm_FL", "last_valid_b1_ms"),
}


def admissible(rows: Sequence[dict[str, Any]], stamped: dict[str, tuple[str, ...]]) -> None:
    """What the document lets a board assume: a datum changes only with its stamp, no stamp is ahead."""
    for before, after in pairwise(rows):
        for stamp, data in stamped.items():
            assert before[stamp] <= after[stamp] <= after["now_ms"]
            if before[stamp] == after[stamp]:
                assert [before[name] for name in data] == [after[name] for name in data]


@given(DISTURBED)
@examples(12)
def test_boards_get_what_they_may_assume(keys: dict[str, Any]) -> None:
    record = run(FAULT, duration="1 s", **keys)
    admissible([inputs1(step.inputs) for step in record.board1], STAMPED1)
    admissible([inputs2(step.inputs) for step in record.board2], STAMPED2)
    for name, rows in (
        ("last_valid_b2_ms", [inputs1(step.inputs) for step in record.board1]),
        ("last_valid_b1_ms", [inputs2(step.inputs) for step in record.board2]),
    ):
        seen = [(row[name], row["now_ms"]) for row in rows]
        assert all(then == now for (last, _), (then, now) in pairwise(seen) if then != last)


@given(DISTURBED)
@examples(8)
def test_the_relay_follows_board_1_and_the_motors_follow_the_relay(keys: dict[str, Any]) -> None:
    record = run(FAULT, duration="1 s", **keys)
    given_away = {step.time_us: step.outputs.give_b2_actuation for step in record.board1}
    for sample in record.samples:
        if sample.time_us in given_away:
            assert sample.relay is (Side.BOARD_2 if given_away[sample.time_us] else Side.BOARD_1)
        if sample.stop_level or sample.driven_by is Driver.NOBODY:
            assert sample.left_rpm == sample.right_rpm == 0


# --- clocks and phases -------------------------------------------------------------------------------


def test_each_supervisor_runs_every_20_ms_of_its_own_clock() -> None:
    record = run(duration="5 s", phase="7 ms", drift="10000 ppm")
    assert [s.time_us for s in record.board1] == list(range(20_000, 5_000_001, 20_000))
    assert [s.inputs.now_ms for s in record.board2] == list(range(20, 20 * len(record.board2) + 1, 20))
    assert len(record.board2) == 252, "1 % faster, and 7 ms and a first period later"


@pytest.mark.parametrize("phase", [0, 1, 10, 18, 19])
def test_a_frame_is_on_the_line_for_less_than_a_millisecond(phase: int) -> None:
    record = run(duration="0.2 s", phase=f"{phase} ms")
    stamps = [step.inputs.b2_data_last_valid_ms for step in record.board1]
    sent = [20 * k + phase for k in range(1, len(stamps))]
    assert stamps[1:] == [time for time in sent if time < stamps[-1] + 1][: len(stamps) - 1]
    heard = [step.inputs.b1_data_last_valid_ms for step in record.board2]
    waiting = 0 if phase else 20
    assert [step.inputs.now_ms - last for step, last in zip(record.board2, heard, strict=True)][1:] == [
        phase or waiting
    ] * (len(heard) - 1)


def test_first_steps_find_the_first_data_of_every_sensor() -> None:
    record = run(initial={"obstacle_left": "120 cm"})
    one, two = inputs1(record.board1[0].inputs), inputs2(record.board2[0].inputs)
    assert (one["now_ms"], one["temperature_degC"], one["battery_pct"]) == (20, 25.0, 80.0)
    assert (two["now_ms"], two["d1"], two["d2"], two["imu_last_valid_ms"]) == (20, 120.0, 301.0, 20)


def test_a_task_may_be_shifted_within_its_period() -> None:
    record = run(phases={"joystick": "4 ms", "sonars": "30 ms"})
    stamps = [inputs2(step.inputs) for step in record.board2]
    assert stamps[5]["ble_last_valid_ms"] == 104 and stamps[5]["now_ms"] == 120
    assert stamps[5]["sonar_last_valid_ms"] == 110


def test_the_periods_of_a_task_may_last_unlike_times() -> None:
    record = run(periods={"supervisor_1": ["19 ms", "21 ms", "20 ms"], "transmit_1": "19 ms"})
    assert [step.inputs.now_ms for step in record.board1][:6] == [19, 40, 60, 79, 100, 120]
    heard = [step.inputs.b1_data_last_valid_ms for step in record.board2]
    assert {b - a for a, b in pairwise(heard[2:])} <= {19, 38}


# --- faults ------------------------------------------------------------------------------------------


def test_a_cut_link_hands_over_after_more_than_120_ms_and_back_after_3_s() -> None:
    cut = at("1 s", link="cut", **{"for": "1 s"})
    record = run(FORWARD, cut, duration="6 s", phase="13 ms")
    give = board1(record, "give_b2_actuation")
    last = max(s.inputs.b2_data_last_valid_ms for s in record.board1 if s.time_us <= 1_500_000)
    assert (last, first(give, True)) == (993, 1120), "age 127 ms; it was 107 ms the step before"
    back = first(board1(record, "rx_status"), Level.DEGRADED)
    assert (back, first(give, False, 1200)) == (2020, back + 3020)
    assert {s.driven_by for s in record.samples if 1_200_000 < s.time_us < 5_000_000} == {Driver.BOARD_2}


def test_both_boards_drive_when_only_board_1_is_heard_no_more() -> None:
    record = run(FORWARD, at("1 s", link_b1_b2="cut"), duration="3 s")
    assert first(board2(record, "autorized_to_send_command"), True) == 1120
    assert not any(board1(record, "give_b2_actuation").values())
    assert record.samples[-1].driven_by is Driver.BOARD_1


@pytest.mark.parametrize(("start", "long", "frames"), [("0.5004 s", "1 ms", 1), ("0.50043 s", "10 us", 2)])
def test_a_frame_without_its_end_is_lost_and_one_byte_less_costs_two(
    start: str, long: str, frames: int
) -> None:
    whole = run(duration="1 s")
    cut = run(at(start, link_b2_b1="cut", **{"for": long}), duration="1 s")
    assert cut.b2_to_b1.sent == whole.b2_to_b1.sent
    assert whole.b2_to_b1.accepted - cut.b2_to_b1.accepted == frames


def test_lost_frames_are_counted_and_delayed_ones_come_late_and_in_order() -> None:
    lossy = run(initial={"frame_loss": 0.5}, duration="4 s")
    assert 60 < lossy.b1_to_b2.accepted < 140 < lossy.b1_to_b2.sent
    late = run(initial={"delay_b2_b1": "45 ms"}, duration="1 s")
    assert late.board1[-1].inputs.payload.alive_counter == 47
    assert late.b2_to_b1.accepted == late.b2_to_b1.sent - 3


def test_a_dead_supervisor_whose_frames_still_come_leaves_nobody_to_drive() -> None:
    record = run(FORWARD, at("1 s", supervisor_2="stopped"), duration="3 s", phase="5 ms")
    assert set(board1(record, "rx_status").values()) == {Level.OK}
    given = first(board1(record, "give_b2_actuation"), True)
    assert given == 1140, "the last heartbeat was seen at 1000 ms"
    nobody = next(s.time_us for s in record.samples[5:] if s.driven_by is Driver.NOBODY)
    assert nobody == 1_430_000, "300 ms after the last command of Board 1"
    assert record.samples[-1].speed == 0


def test_board_1_without_power_leaves_the_motors_to_board_2() -> None:
    off = at("1 s", board_1="off", **{"for": "1 s"})
    record = run(FORWARD, off, duration="3 s")
    assert not [s for s in record.board1 if 1_000_000 < s.time_us < 2_020_000]
    again = next(s for s in record.board1 if s.time_us > 2_000_000)
    assert (again.time_us, again.inputs.now_ms, again.outputs.v_ref) == (2_020_000, 20, 0.0)
    drivers = {s.driven_by for s in record.samples if 1_200_000 < s.time_us < 2_000_000}
    assert drivers == {Driver.BOARD_2}
    assert record.samples[-1].driven_by is Driver.BOARD_1


def test_a_board_2_that_starts_late_is_waited_for() -> None:
    record = run(at("0.5 s", board_2="on"), initial={"board_2": "off"}, duration="1 s")
    assert record.board2[0].time_us == 520_000 and record.board2[0].inputs.now_ms == 20
    assert first(board1(record, "give_b2_actuation"), True) == 140


Faulty = Callable[[Record], object]
SILENT: list[tuple[str, Faulty, object]] = [
    ("temperature_sensor", lambda r: r.board1[-1].inputs.temp_last_valid_ms, 900),
    ("battery_sensor", lambda r: r.board1[-1].inputs.batt_last_valid_ms, 900),
    ("imu", lambda r: r.board2[-1].inputs.imu_last_valid_ms, 980),
    ("imu", lambda r: r.board2[-1].outputs.statuses.imu_status, Level.CRITICAL),
    ("joystick", lambda r: r.board2[-1].inputs.ble_last_valid_ms, 980),
    ("joystick", lambda r: r.board1[-1].outputs.current_action, SupervisorCommand.CMD_ESTOP),
    ("sonars", lambda r: r.board2[-1].inputs.sonar_last_valid_ms, 980),
]


@pytest.mark.parametrize(("name", "read", "found"), SILENT)
def test_a_silent_sensor_keeps_its_stamp(name: str, read: Faulty, found: object) -> None:
    assert read(run(FORWARD, at("1 s", **{name: "silent"}), duration="1.3 s")) == found


def test_an_encoder_that_reads_0_and_a_wheel_that_stands_have_no_feedback() -> None:
    for fault in ({"encoder_FR": "dead"}, {"wheel_FR": "blocked"}):
        record = run(FORWARD, at("1 s", **fault), duration="1.2 s")
        assert record.board1[-1].inputs.has_no_feedback == (False, True, False, False)
        assert record.board1[-1].inputs.wheel_speed_rpm[1] == 0
    frozen = run(FORWARD, at("1 s", encoder_FR="frozen"), at("1.1 s", stick_y=0.2), duration="1.8 s")
    one = frozen.board1[-1].inputs.wheel_speed_rpm
    assert one[1] > 150 and one[0] < 40


def test_wheels_that_slip_are_noticed() -> None:
    turning = at("0.3 s", stick_x=1.0)
    slipping = run(turning, at("1 s", grip=0.2), duration="5 s")
    assert set(board2(run(turning, duration="5 s"), "isMotionConsistent").values()) == {True}
    assert not all(board2(slipping, "isMotionConsistent").values())


# --- the rover ---------------------------------------------------------------------------------------


def test_full_speed_is_160_rpm_and_positive_omega_turns_left() -> None:
    ahead = run(FORWARD).samples[-1]
    assert ahead.speed == pytest.approx(1.17, abs=0.01) and ahead.heading == 0
    left = run(at("0.3 s", stick_x=0.5)).samples[-1]
    assert (left.left_rpm, left.right_rpm) == (-40.0, 40.0) and left.yaw_rate < -70
    both = run(at("0.3 s", stick_x=1.0, stick_y=1.0)).samples[-1]
    assert both.left_rpm == pytest.approx(160 / 3) and both.right_rpm == pytest.approx(160)


def test_nothing_moves_before_the_first_command() -> None:
    record = run(at("0 s", stick_y=1.0), initial={"board_1": "off", "board_2": "off"}, duration="1 s")
    assert {(s.driven_by, s.stop_level, s.speed) for s in record.samples} == {(Driver.NOBODY, True, 0.0)}
    assert not record.board1 and not record.board2


def test_outputs_are_logged_with_the_inputs_of_their_step() -> None:
    record = run(FORWARD)
    assert len(outputs1(record.board1[0].outputs)) == 27 and len(outputs2(record.board2[0].outputs)) == 25
    driven = [s for s in record.board1 if s.inputs.payload.y_norm == 1.0]
    assert driven and {s.outputs.v_ref for s in driven} == {1.0}
