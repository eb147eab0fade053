"""The battery monitor: each row on both sides of its boundaries, its timer to the step."""

from math import inf, nan, nextafter

import pytest

from rovercheck.supervisor.board1.monitors import BatteryMonitor
from rovercheck.supervisor.timing import CLOCK
from rovercheck.supervisor.types import Level
from tests.supervisor.board1_bench import Sensor

OK, DEGRADED, CRITICAL = Level.OK, Level.DEGRADED, Level.CRITICAL


def battery(*interpretations, start_ms=1000):
    return Sensor(BatteryMonitor(), start_ms).fresh(*interpretations)


@pytest.mark.parametrize(
    "pct, status",
    [
        (-1, DEGRADED),
        (0, DEGRADED),
        (15, DEGRADED),
        (nextafter(15, 99), DEGRADED),
        (nextafter(23, 0), DEGRADED),
        (23, OK),
        (24, OK),
        (25, OK),
        (nextafter(25, 99), OK),
        (100, OK),
        (nan, DEGRADED),
        (inf, DEGRADED),
        (-inf, DEGRADED),
    ],
)
def test_battery_ranges_from_the_first_step_on(pct, status):
    assert battery(pct) is status
    assert battery(80, pct) is status


@pytest.mark.parametrize("pct", [0, 10, 15, nan, inf, -inf])
def test_battery_is_critical_after_five_seconds(pct):
    assert battery(80, *[pct] * 250) is DEGRADED
    assert battery(80, *[pct] * 251) is CRITICAL
    assert battery(80, *[pct] * 252) is CRITICAL


@pytest.mark.parametrize("pct", [-1, nextafter(15, 99), nextafter(23, 0)])
def test_battery_outside_the_critical_range_only_degrades(pct):
    assert battery(*[pct] * 300) is DEGRADED


def test_one_step_outside_restarts_the_five_seconds():
    assert battery(*[10] * 250, 16, *[10] * 250) is DEGRADED
    assert battery(*[10] * 250, 16, *[10] * 251) is CRITICAL


@pytest.mark.parametrize("between", [23, 24, 25])
def test_between_23_and_25_the_status_is_kept(between):
    assert battery(80, between) is OK
    assert battery(20, between) is DEGRADED
    assert battery(*[10] * 251, between) is CRITICAL


@pytest.mark.parametrize("pct, status", [(20, DEGRADED), (nextafter(25, 99), OK)])
def test_critical_battery_is_released_at_once(pct, status):
    assert battery(*[10] * 260, pct) is status


@pytest.mark.parametrize(
    "pct, age, status",
    [
        (15.2, 480, DEGRADED),
        (15.2, 499, DEGRADED),
        (15.2, 500, CRITICAL),
        (15.21, 500, DEGRADED),
        (15.21, 501, CRITICAL),
        (15.42, 1000, DEGRADED),
        (15.42, 1001, CRITICAL),
        (24.5, 5000, OK),
        (80, 12_000, OK),
        (36, 50_000, OK),
        (36, 50_001, CRITICAL),
        (nan, 90_000, DEGRADED),
        (15.0, 400, DEGRADED),
    ],
)
def test_estimated_battery(pct, age, status):
    assert Sensor(BatteryMonitor(), 100_020).stale(pct, age) is status


def test_a_stale_estimate_leaves_the_kept_range():
    sensor = Sensor(BatteryMonitor(), 100_020)
    assert sensor.stale(24.0, 30_000) is CRITICAL
    assert sensor.stale(24.0, 0) is CRITICAL
    assert sensor.stale(25.1, 0) is OK


def test_no_battery_since_power_up():
    monitor = BatteryMonitor()
    assert monitor.step(0.0, 0, 480) is DEGRADED
    assert monitor.step(0.0, 0, 500) is CRITICAL


def test_battery_across_the_wrap_of_the_clock():
    start = CLOCK - 2000
    assert battery(80, *[10] * 250, start_ms=start) is DEGRADED
    assert battery(80, *[10] * 251, start_ms=start) is CRITICAL
    monitor = BatteryMonitor()
    assert monitor.step(20.0, 100, 60_000) is CRITICAL
    assert monitor.step(20.0, 100, 110) is CRITICAL
