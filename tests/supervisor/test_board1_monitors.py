"""The monitors of wheels, of reception and of the supervisor of Board 2, row by row."""

import pytest

from rovercheck.supervisor.board1.monitors import UpdateMonitor, wheel_status
from rovercheck.supervisor.timing import CLOCK
from rovercheck.supervisor.types import Level

OK, DEGRADED, CRITICAL = Level.OK, Level.DEGRADED, Level.CRITICAL


@pytest.mark.parametrize(
    "no_feedback, consistent, status",
    [
        (True, False, CRITICAL),
        (True, True, DEGRADED),
        (False, True, OK),
        (False, False, DEGRADED),
    ],
)
def test_wheel(no_feedback, consistent, status):
    assert wheel_status(no_feedback, consistent) is status


def updates(monitor, first_ms, *intervals):
    """The status at the last update."""
    stamp = first_ms
    status = monitor.step(stamp % CLOCK, stamp % CLOCK)
    for interval in intervals:
        stamp += interval
        status = monitor.step(stamp % CLOCK, stamp % CLOCK)
    return status


@pytest.mark.parametrize("age, status", [(0, OK), (100, OK), (120, OK), (121, CRITICAL), (140, CRITICAL)])
@pytest.mark.parametrize("stamp", [0, 1000, CLOCK - 60])
def test_age(stamp, age, status):
    assert UpdateMonitor().step(stamp, (stamp + age) % CLOCK) is status


@pytest.mark.parametrize(
    "intervals, status",
    [
        ([40] * 10, OK),
        ([40] * 9 + [41], DEGRADED),
        ([60] * 9, OK),
        ([60] * 10, DEGRADED),
        ([20] * 9 + [220], OK),
        ([20] * 9 + [221], DEGRADED),
        ([100] * 10 + [20] * 7, DEGRADED),
        ([100] * 10 + [20] * 8, OK),
    ],
)
@pytest.mark.parametrize("first_ms", [20, 900, CLOCK - 250])
def test_mean_of_ten_intervals(intervals, status, first_ms):
    assert updates(UpdateMonitor(), first_ms, *intervals) is status


def test_time_to_the_first_update_is_no_interval():
    assert updates(UpdateMonitor(), 900, *[20] * 10) is OK


def test_the_open_interval_is_not_counted():
    monitor = UpdateMonitor()
    updates(monitor, 1000, *[38] * 10)
    assert monitor.step(1380, 1480) is OK
    assert monitor.step(1380, 1501) is CRITICAL


def test_absence_outweighs_slowness_and_ends_with_the_first_update():
    monitor = UpdateMonitor()
    assert updates(monitor, 1000, *[48] * 10) is DEGRADED
    assert monitor.step(1480, 1600) is DEGRADED
    assert monitor.step(1480, 1620) is CRITICAL
    assert monitor.step(1620, 1620) is DEGRADED


def test_one_long_gap_degrades_while_it_is_in_the_window():
    monitor = UpdateMonitor()
    updates(monitor, 1000, *[20] * 10)
    assert updates(monitor, 1500, *[20] * 9) is DEGRADED
    assert monitor.step(1700, 1700) is OK


def test_silence_since_power_up_and_for_a_turn_of_the_clock():
    monitor = UpdateMonitor()
    assert monitor.step(0, 120) is OK
    assert monitor.step(0, 140) is CRITICAL
    assert monitor.step(0, 20) is CRITICAL
    assert monitor.step(20, 20) is OK


def test_a_stamp_from_the_future_is_absent():
    assert UpdateMonitor().step(1001, 1000) is CRITICAL
