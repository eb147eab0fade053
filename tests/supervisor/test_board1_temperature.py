"""The temperature monitor: each row on both sides of its boundaries, its timer to the step."""

from math import inf, nan, nextafter

import pytest

from rovercheck.supervisor.board1.monitors import TemperatureMonitor
from rovercheck.supervisor.timing import CLOCK
from rovercheck.supervisor.types import Level
from tests.supervisor.board1_bench import Sensor

OK, DEGRADED, CRITICAL = Level.OK, Level.DEGRADED, Level.CRITICAL


def temperature(*interpretations, start_ms=1000):
    return Sensor(TemperatureMonitor(), start_ms).fresh(*interpretations)


@pytest.mark.parametrize(
    "degc, status",
    [
        (-16, DEGRADED),
        (-15, DEGRADED),
        (nextafter(-15, 0), DEGRADED),
        (-5, DEGRADED),
        (nextafter(-5, 0), OK),
        (25, OK),
        (nextafter(55, 0), OK),
        (55, DEGRADED),
        (nextafter(60, 0), DEGRADED),
        (60, DEGRADED),
        (100, DEGRADED),
        (nan, DEGRADED),
        (inf, DEGRADED),
        (-inf, DEGRADED),
    ],
)
def test_temperature_ranges_from_the_first_step_on(degc, status):
    assert temperature(degc) is status
    assert temperature(25, degc) is status


@pytest.mark.parametrize("degc", [-inf, -15, 60, 70, inf, nan])
def test_temperature_is_critical_after_four_seconds(degc):
    assert temperature(25, *[degc] * 200) is DEGRADED
    assert temperature(25, *[degc] * 201) is CRITICAL
    assert temperature(25, *[degc] * 202) is CRITICAL


@pytest.mark.parametrize("degc", [nextafter(-15, 0), nextafter(60, 0)])
def test_temperature_in_the_degraded_range_is_never_critical(degc):
    assert temperature(*[degc] * 300) is DEGRADED


def test_both_ends_are_one_critical_range():
    assert temperature(*[-20] * 100, *[70] * 101) is CRITICAL


def test_one_step_outside_restarts_the_four_seconds():
    assert temperature(*[70] * 200, 59, *[70] * 200) is DEGRADED
    assert temperature(*[70] * 200, 59, *[70] * 201) is CRITICAL


@pytest.mark.parametrize("degc, status", [(25, OK), (57, DEGRADED)])
def test_critical_temperature_is_released_at_once(degc, status):
    assert temperature(*[70] * 250, degc) is status


@pytest.mark.parametrize(
    "degc, age, status",
    [
        (64.8, 480, DEGRADED),
        (64.8, 499, DEGRADED),
        (64.8, 500, CRITICAL),
        (64.5, 500, DEGRADED),
        (64.5, 501, CRITICAL),
        (64.2, 800, DEGRADED),
        (64.2, 820, CRITICAL),
        (58, 7000, DEGRADED),
        (58, 7001, CRITICAL),
        (64.1, 900, DEGRADED),
        (50, 15_000, OK),
        (50, 15_001, CRITICAL),
        (20, 12_000, OK),
        (nan, 60_000, DEGRADED),
    ],
)
def test_estimated_temperature(degc, age, status):
    assert Sensor(TemperatureMonitor(), 100_020).stale(degc, age) is status


def test_a_stale_cold_reading_stays_cold():
    sensor = Sensor(TemperatureMonitor())
    sensor.fresh(-16)
    for age in range(20, 4000, 20):
        sensor.now += 20
        assert sensor.stale(-16, age) is DEGRADED
    sensor.now += 20
    assert sensor.stale(-16, 4000) is CRITICAL


def test_no_temperature_since_power_up_counts_from_0():
    monitor = TemperatureMonitor()
    assert monitor.step(0.0, 0, 65_000) is OK
    assert monitor.step(0.0, 0, 65_001) is CRITICAL


def test_temperature_across_the_wrap_of_the_clock():
    start = CLOCK - 2000
    assert temperature(25, *[70] * 200, start_ms=start) is DEGRADED
    assert temperature(25, *[70] * 201, start_ms=start) is CRITICAL
    late = Sensor(TemperatureMonitor(), CLOCK + 20)
    assert late.stale(64.8, 480) is DEGRADED
    assert late.stale(64.8, 500) is CRITICAL


def test_a_lost_sensor_does_not_recover_when_the_clock_comes_round():
    monitor = TemperatureMonitor()
    assert monitor.step(25.0, 100, 60_000) is CRITICAL
    assert monitor.step(25.0, 100, 110) is CRITICAL
    assert monitor.step(25.0, 110, 110) is OK


def test_critical_for_a_turn_of_the_clock():
    monitor = TemperatureMonitor()
    for now in (1000, 6000, 990, 1000, 1020):
        status = monitor.step(70.0, now, now)
    assert status is CRITICAL
