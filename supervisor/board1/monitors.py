"""The monitors of Board 1: how well sensors, wheels and Board 2 work [spec §2.4, Fig 15, Table 2].

Each tests its rows in order of severity in every step, the first one included; the first true row wins.
"""

from dataclasses import dataclass, field
from math import isfinite

from rovercheck.supervisor.timing import Age, Held, IntervalMean
from rovercheck.supervisor.types import Level

ESTIMATE_FROM_MS = 500
"""From this age on, a measured value is assumed to drift."""
LATE_MS = 40
"""Mean interval above which updates are slow."""
LOST_MS = 120
"""Age above which updates are absent."""


@dataclass
class TemperatureMonitor:
    """CH-TEMP.  A temperature that is no number is as bad as one in the critical range."""

    status: Level = Level.OK
    _age: Age = field(default_factory=Age)
    _in_critical_range: Held = field(default_factory=lambda: Held(4000))

    def step(self, degc: float, last_valid_ms: int, now_ms: int) -> Level:
        """``degc`` is the last valid reading, however old."""
        age = self._age.update(last_valid_ms, now_ms)
        critical = not isfinite(degc) or degc <= -15 or degc >= 60
        if self._in_critical_range.update(critical, now_ms) or too_warm_by_now(degc, age):
            self.status = Level.CRITICAL
        elif critical or degc <= -5 or degc >= 55:
            self.status = Level.DEGRADED
        else:
            self.status = Level.OK
        return self.status


def too_warm_by_now(degc: float, age_ms: int) -> bool:
    """Whether an old reading that rises by 1 °C/s is above 65 °C by now.

    The limit moves instead of the reading: one correctly rounded division decides decimal readings exactly.
    """
    return age_ms >= ESTIMATE_FROM_MS and degc > (65_000 - age_ms) / 1000


@dataclass
class BatteryMonitor:
    """CH-BATT.  A charge that is infinite or no number is as bad as one in the critical range."""

    status: Level = Level.OK
    _age: Age = field(default_factory=Age)
    _in_critical_range: Held = field(default_factory=lambda: Held(5000))

    def step(self, pct: float, last_valid_ms: int, now_ms: int) -> Level:
        """``pct`` is the last valid reading, however old.  From 23 to 25 the status is kept (S17)."""
        age = self._age.update(last_valid_ms, now_ms)
        critical = not isfinite(pct) or 0 <= pct <= 15
        if self._in_critical_range.update(critical, now_ms) or too_empty_by_now(pct, age):
            self.status = Level.CRITICAL
        elif critical or pct < 23:
            self.status = Level.DEGRADED
        elif pct > 25:
            self.status = Level.OK
        return self.status


def too_empty_by_now(pct: float, age_ms: int) -> bool:
    """Whether an old reading that falls by 0.42 %/s is below 15 % by now; rounded as for the temperature."""
    return age_ms >= ESTIMATE_FROM_MS and pct < (1_500_000 + 42 * age_ms) / 100_000


def wheel_status(has_no_feedback: bool, is_motion_consistent: bool) -> Level:
    """CH-WHEEL, for one wheel: the motor fails, or its encoder, or it is not yet clear what (S27)."""
    if has_no_feedback and not is_motion_consistent:
        return Level.CRITICAL
    if has_no_feedback or not is_motion_consistent:
        return Level.DEGRADED
    return Level.OK


@dataclass
class UpdateMonitor:
    """CH-SUP on the heartbeats of Board 2, CH-RX on its frames: each has its own record of intervals."""

    _age: Age = field(default_factory=Age)
    _slow: IntervalMean = field(default_factory=lambda: IntervalMean(LATE_MS))

    def step(self, stamp_ms: int, now_ms: int) -> Level:
        """``stamp_ms`` is the time of the last update, 0 since power-up."""
        slow = self._slow.update(stamp_ms)
        if self._age.update(stamp_ms, now_ms) > LOST_MS:
            return Level.CRITICAL
        return Level.DEGRADED if slow else Level.OK
