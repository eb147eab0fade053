"""The monitors of Board 2 at their limits, from slow data, through recovery and without any data."""

from dataclasses import dataclass, field
from operator import attrgetter
from typing import Any

import pytest

from rovercheck.supervisor.board2.monitors import Monitor, Monitors, Slow2, TooOld
from rovercheck.supervisor.board2.signals import Board2Inputs
from rovercheck.supervisor.timing import CLOCK
from rovercheck.supervisor.types import Level

FIELDS = ("last_valid_b1_ms", "ble_last_valid_ms", "imu_last_valid_ms", "b1_data_last_valid_ms")
STATUSES = ("b1_sup_status", "esp_status", "imu_status", "rx_status")
MEANS, LIMITS, RECOVERIES = (60, 40, 100, 40), (150, 120, 200, 120), (100, 50, 50, 50)
REGIONS = tuple(zip(FIELDS, STATUSES, LIMITS, strict=True))


@dataclass
class Source:
    """A monitor of the joystick and its stamp, fresh in every step unless told otherwise."""

    monitor: Monitor = field(default_factory=lambda: Monitor(mean_ms=40, limit_ms=120, recovery_s=1))
    now_ms: int = 0
    stamp_ms: int = 0

    def step(self, steps: int = 1, fresh: bool = True) -> Level:
        for _ in range(steps):
            self.now_ms = (self.now_ms + 20) % CLOCK
            self.stamp_ms = self.now_ms if fresh else self.stamp_ms
            status = self.monitor.step(self.stamp_ms, self.now_ms)
        return status

    def updates(self, gap_steps: int, count: int) -> Level:
        """So many updates, each this long after the one before."""
        for _ in range(count):
            if gap_steps > 1:
                self.step(gap_steps - 1, fresh=False)
            status = self.step()
        return status


@pytest.mark.parametrize(("stamp", "status", "limit"), REGIONS)
def test_an_age_above_its_limit_is_critical(stamp: str, status: str, limit: int) -> None:
    for age, level in ((limit, Level.OK), (limit + 1, Level.CRITICAL)):
        monitors = Monitors()
        fresh: dict[str, Any] = dict.fromkeys(FIELDS, 5_000)
        monitors.step(Board2Inputs(now_ms=5_000, **fresh))
        old = fresh | {name: 5_000 + age for name in FIELDS if name != stamp}
        statuses = monitors.step(Board2Inputs(now_ms=5_000 + age, **old))
        assert attrgetter(status)(statuses) is level


@pytest.mark.parametrize(("stamp", "status", "mean"), tuple(zip(FIELDS, STATUSES, MEANS, strict=True)))
def test_a_mean_above_its_limit_is_degraded(stamp: str, status: str, mean: int) -> None:
    for gap, level in ((mean, Level.OK), (mean + 1, Level.DEGRADED)):
        monitors = Monitors()
        for k in range(4):  # entered, first stamp, one gap, seen in the step after
            now = 1_000 + k * gap
            fresh: dict[str, Any] = dict.fromkeys(FIELDS, now)
            statuses = monitors.step(Board2Inputs(now_ms=now, **fresh))
            assert k < 3 or attrgetter(status)(statuses) is level


@pytest.mark.parametrize(("status", "steps"), tuple(zip(STATUSES, RECOVERIES, strict=True)))
def test_recovery_from_critical_takes_one_step_more_than_its_time(status: str, steps: int) -> None:
    monitors = Monitors()
    monitors.step(Board2Inputs(now_ms=20))
    statuses = monitors.step(Board2Inputs(now_ms=1_000))
    assert attrgetter(status)(statuses) is Level.CRITICAL
    for k in range(1, steps + 2):
        now = 1_000 + 20 * k
        statuses = monitors.step(Board2Inputs(now_ms=now))
        expected = Level.OK if k == steps + 1 else Level.CRITICAL
        assert attrgetter(status)(statuses) is expected


def test_the_first_step_is_ok_whatever_the_age() -> None:
    statuses = Monitors().step(Board2Inputs(now_ms=100_000))
    assert all(status is Level.OK for status in (statuses.esp_status, statuses.rx_status))
    assert statuses.imu_status is statuses.b1_sup_status is Level.OK


def test_a_slow_source_is_degraded_in_the_step_after_it_is_found_slow() -> None:
    source = Source()
    source.step(3)
    source.updates(3, 1)  # gaps of 20 and 60 ms: a mean of exactly 40
    assert source.step() is Level.OK
    source = Source()
    source.step()
    assert source.updates(3, 1) is Level.OK  # one gap of 60 ms is enough, found in this step
    assert source.step() is Level.DEGRADED


def test_a_degraded_source_returns_51_steps_after_its_mean_is_good() -> None:
    source = Source()
    source.step()
    source.updates(3, 1)
    assert source.step() is Level.DEGRADED
    source.step()  # the gaps since: 60 and, the degrading step in between being unseen, 40
    assert source.step(2) is Level.DEGRADED  # gaps of 60, 40, 20, 20: not slow since the first of both
    history = [source.step() for _ in range(51)]
    assert history.index(Level.OK) == 49
    assert history[:49] == [Level.DEGRADED] * 49


def test_an_interruption_begins_the_recovery_anew() -> None:
    source = Source()
    source.step()
    source.step(7, fresh=False)
    assert source.monitor.status is Level.CRITICAL
    source.step(40)
    source.updates(25, 1)  # slow again, and the age is not examined while critical
    assert source.monitor.status is Level.CRITICAL
    assert source.step(50) is Level.CRITICAL
    assert source.step(40) is Level.OK


def test_a_gap_is_seen_by_the_first_execution_that_takes_no_transition() -> None:
    slow = Slow2(mean_ms=40)
    assert not slow.update(500)  # the power-up stamp counts as one
    assert slow.update(541)
    assert slow.update(541)
    assert not slow.update(561)


def test_only_the_last_ten_gaps_count() -> None:
    slow = Slow2(mean_ms=40)
    slow.update(0)
    assert slow.update(1_000)
    found = [slow.update(1_000 + 20 * k) for k in range(1, 11)]
    assert found == [True] * 9 + [False]


def test_missing_data_since_power_up_are_critical_by_their_age() -> None:
    source = Source()
    assert source.step(6, fresh=False) is Level.OK
    assert source.step(1, fresh=False) is Level.CRITICAL


def test_a_source_that_stays_silent_is_ok_for_one_step_after_each_recovery_time() -> None:
    """The age is not examined in critical, and no gap is seen: the recovery time passes."""
    source = Source()
    source.step(7, fresh=False)
    for _ in range(3):
        assert [source.step(fresh=False) for _ in range(52)] == [Level.CRITICAL] * 50 + [
            Level.OK,
            Level.CRITICAL,
        ]


def test_degraded_data_that_stop_coming_become_critical() -> None:
    source = Source()
    source.step()
    source.updates(3, 1)
    assert source.step() is Level.DEGRADED
    assert source.step(6, fresh=False) is Level.DEGRADED
    assert source.step(1, fresh=False) is Level.CRITICAL


def test_ages_and_gaps_pass_the_wrap_of_the_clock() -> None:
    source = Source(now_ms=CLOCK - 50, stamp_ms=CLOCK - 50)
    assert source.step(20) is Level.OK
    source = Source(now_ms=CLOCK - 50)
    source.step(1)
    assert source.step(6, fresh=False) is Level.OK
    assert source.step(1, fresh=False) is Level.CRITICAL


def test_a_stamp_found_too_old_does_not_become_young_when_the_clock_comes_round() -> None:
    age = TooOld(limit_ms=120)
    assert not age.update(0, 120)
    assert age.update(0, 121)
    assert age.update(0, 20)
    assert not age.update(21, 141)
    assert age.update(21, 142)


def test_a_stamp_in_the_future_is_too_old() -> None:
    assert TooOld(limit_ms=120).update(1_000, 999)
