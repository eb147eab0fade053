"""Interpretations that are no numbers: they are no interpretations, and the rover stops when they last."""

from dataclasses import replace
from typing import Any

import pytest

from rovercheck.supervisor.board2.signals import Board2Inputs
from rovercheck.supervisor.board2.validity import Validity
from rovercheck.supervisor.types import Level
from tests.supervisor.board2_bench import Bench

NO_NUMBERS = (float("nan"), float("inf"), float("-inf"))
READ = Board2Inputs(
    now_ms=40,
    yaw=90.0,
    gz_dps=5.0,
    imu_last_valid_ms=40,
    x_norm=0.5,
    y_norm=1.0,
    btn1=True,
    ble_last_valid_ms=40,
)


@pytest.mark.parametrize("value", NO_NUMBERS)
@pytest.mark.parametrize("name", ("yaw", "gz_dps"))
def test_the_last_valid_imu_reading_and_its_stamp_stay(name: str, value: float) -> None:
    validity = Validity()
    assert validity.judge(READ) == READ
    later = replace(READ, now_ms=60, imu_last_valid_ms=60, ble_last_valid_ms=60)
    changes: dict[str, Any] = {"yaw": 91.0, name: value}
    broken = replace(later, **changes)
    for _ in range(2):
        judged = validity.judge(broken)
        assert judged == replace(later, imu_last_valid_ms=40)
    assert validity.judge(later) == later


@pytest.mark.parametrize("value", NO_NUMBERS)
@pytest.mark.parametrize("name", ("x_norm", "y_norm"))
def test_the_last_valid_joystick_reading_and_its_stamp_stay(name: str, value: float) -> None:
    validity = Validity()
    validity.judge(READ)
    later = replace(READ, now_ms=60, imu_last_valid_ms=60, ble_last_valid_ms=60)
    changes: dict[str, Any] = {"btn1": False, "btn2": True, name: value}
    judged = validity.judge(replace(later, **changes))
    assert judged == replace(later, ble_last_valid_ms=40)


def test_from_power_up_no_reading_is_the_initial_one() -> None:
    broken = replace(READ, yaw=float("nan"), y_norm=float("nan"))
    assert Validity().judge(broken) == Board2Inputs(now_ms=40)


@pytest.mark.parametrize(
    ("value", "axis"), ((1.5, 1.0), (1.0, 1.0), (0.99, 0.99), (-1.0, -1.0), (-1.01, -1.0))
)
def test_an_axis_is_limited_to_its_range(value: float, axis: float) -> None:
    judged = Validity().judge(replace(READ, x_norm=value, y_norm=value))
    assert (judged.x_norm, judged.y_norm) == (axis, axis)


@pytest.mark.parametrize(("name", "steps", "bit"), (("yaw", 11, 2), ("gz_dps", 11, 2), ("y_norm", 7, 1)))
def test_lasting_nonsense_is_a_critical_source(name: str, steps: int, bit: int) -> None:
    bench = Bench()
    bench.step(5)
    assert bench.step(steps - 1, **{name: float("nan")}).critical_mask == 0
    outputs = bench.step()
    assert outputs.critical_mask == bit and outputs.b2_emergency


@pytest.mark.parametrize("value", NO_NUMBERS)
def test_a_distance_that_is_no_number_is_an_obstacle(value: float) -> None:
    for sonar in range(3):
        bench = Bench()
        bench.authorise()
        bench.step(y_norm=1.0)
        distances = [301.0, 301.0, 301.0]
        distances[sonar] = value
        outputs = bench.step(dist_cm=tuple(distances))
        assert outputs.b2_dec == 6 and outputs.actuate_emergency_stop


def test_wheels_that_measure_nonsense_leave_the_link_alone() -> None:
    bench = Bench()
    bench.step(5)
    assert bench.step(20, payload=bench.wheels(float("nan"))).statuses.rx_status is Level.OK
