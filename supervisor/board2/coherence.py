"""Does the rotation that the IMU measures agree with the one that the wheel speeds make?"""

from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass
from math import isfinite

from rovercheck.supervisor.timing import elapsed_ms

WHEEL_RADIUS_M = 0.07
TRACK_M = 0.38
CORRECTION = 0.83
DPS_PER_RPM = CORRECTION * 2 * WHEEL_RADIUS_M * 180 / (60 * TRACK_M)
"""Yaw rate in degrees/s, clockwise positive, of left wheels 1 rpm faster than the middle of both sides."""

MAX_GAP_MS = 100
"""Data that come later than this tell nothing about the time between."""
FAST_MS, FAST_MDEG = 100, 1_000
LONG_MS, LONG_MDEG = 3_000, 5_000
WINDOWS, HITS = 10, 8
"""So many of the last ten fast windows must disagree."""


def wheel_yaw_rate(wheel_speed_rpm: Sequence[float]) -> float:
    """Yaw rate in degrees/s that the wheels FL, FR, RL and RR make, clockwise positive."""
    front_left, front_right, rear_left, rear_right = wheel_speed_rpm
    return DPS_PER_RPM * ((front_left + rear_left) / 2 - (front_right + rear_right) / 2)


@dataclass
class Window:
    """Rotations of a stretch of time in thousandths of a degree (degrees/s by ms), clockwise positive."""

    length_ms: int
    start_ms: int
    imu: float = 0.0
    wheels: float = 0.0

    def is_over(self, stamp_ms: int) -> bool:
        """Whether the stamp closes the window."""
        return elapsed_ms(stamp_ms, self.start_ms) >= self.length_ms

    def differs(self, limit: float) -> bool:
        """Whether the two rotations lie ``limit`` apart; without two finite rotations they do not agree."""
        difference = self.imu - self.wheels
        return abs(difference) >= limit or not isfinite(difference)

    def clear(self, stamp_ms: int) -> None:
        """Begin anew."""
        self.start_ms, self.imu, self.wheels = stamp_ms, 0.0, 0.0


@dataclass
class _Stamp:
    """The stamp of a source, and the time between its updates."""

    last_ms: int

    def gap_ms(self, stamp_ms: int) -> int:
        """Milliseconds that the new data stand for: 0 without an update or after too long a gap."""
        gap = elapsed_ms(stamp_ms, self.last_ms)
        self.last_ms = stamp_ms
        return gap if gap < MAX_GAP_MS else 0


class _Comparison:
    """The block after its first step."""

    def __init__(self, wheels_ms: int, imu_ms: int) -> None:
        self._wheels = _Stamp(wheels_ms)
        self._imu = _Stamp(imu_ms)
        self._fast = Window(FAST_MS, imu_ms)
        self._long = Window(LONG_MS, imu_ms)
        self._hits: deque[bool] = deque(maxlen=WINDOWS)

    def step(self, wheels_ms: int, imu_ms: int, wheel_speed_rpm: Sequence[float], gz_dps: float) -> bool:
        wheels_gap, imu_gap = self._wheels.gap_ms(wheels_ms), self._imu.gap_ms(imu_ms)
        for window in (self._fast, self._long):
            if wheels_gap:
                window.wheels += wheel_yaw_rate(wheel_speed_rpm) * wheels_gap
            if imu_gap:
                window.imu += gz_dps * imu_gap
        agrees_fast, agrees_long = self._close_fast(imu_ms), self._close_long(imu_ms)
        return agrees_fast and agrees_long

    def _close_fast(self, imu_ms: int) -> bool:
        if not self._fast.is_over(imu_ms):
            return True
        turns = not abs(self._fast.imu) < FAST_MDEG
        self._hits.append(turns and self._fast.differs(FAST_MDEG))
        self._fast.clear(imu_ms)
        return sum(self._hits) < HITS

    def _close_long(self, imu_ms: int) -> bool:
        if not self._long.is_over(imu_ms):
            return True
        agrees = not self._long.differs(LONG_MDEG)
        self._long.clear(imu_ms)
        return agrees


@dataclass
class Coherence:
    """``isMotionConsistent``: false only in a step that closes a window whose rotations disagree.

    A fast window lasts 100 ms and counts only while the IMU turns; a long one lasts 3 s [spec §2.2 for
    the purpose].  A measurement that is infinite or no number spoils its windows: those do not agree.
    """

    _comparison: _Comparison | None = None

    def step(
        self, last_valid_b1_ms: int, imu_ms: int, wheel_speed_rpm: Sequence[float], gz_dps: float
    ) -> bool:
        """Execute one step.

        ``last_valid_b1_ms`` is the stamp of the wheel speeds, ``imu_ms`` that of the yaw rate ``gz_dps`` in
        degrees/s, clockwise positive.
        """
        if self._comparison is None:
            self._comparison = _Comparison(last_valid_b1_ms, imu_ms)
            return True
        return self._comparison.step(last_valid_b1_ms, imu_ms, wheel_speed_rpm, gz_dps)
