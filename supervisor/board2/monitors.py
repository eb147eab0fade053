"""How well the sources of Board 2 work, from the time stamps of their last valid data.

A clock that starts again at 0 makes no source look fresh: a stamp found too old stays too old until it
changes.  Data missing since power-up are data of time 0.
"""

from collections import deque
from dataclasses import dataclass, field

from rovercheck.supervisor.board2.masks import Statuses
from rovercheck.supervisor.board2.signals import Board2Inputs
from rovercheck.supervisor.timing import INTERVALS, Duration, elapsed_ms, steps
from rovercheck.supervisor.types import Level


@dataclass
class Slow2:
    """Whether the last gaps between stamps, at most ten, are longer than ``mean_ms`` on average.

    Unlike on Board 1 [spec Table 2], fewer than ten gaps count, and so does the one from power-up.
    """

    mean_ms: int
    _stamp_ms: int | None = None
    _gaps: deque[int] = field(default_factory=lambda: deque(maxlen=INTERVALS))

    def update(self, stamp_ms: int) -> bool:
        """Call it in every step that leaves the state of the monitor as it is."""
        if self._stamp_ms is None:
            self._stamp_ms = stamp_ms
        if stamp_ms != self._stamp_ms:
            self._gaps.append(elapsed_ms(stamp_ms, self._stamp_ms))
            self._stamp_ms = stamp_ms
        return sum(self._gaps) > len(self._gaps) * self.mean_ms


@dataclass
class TooOld:
    """Whether a stamp is more than ``limit_ms`` old."""

    limit_ms: int
    _stamp_ms: int | None = None
    _over: bool = False

    def update(self, stamp_ms: int, now_ms: int) -> bool:
        """Call it once in every step."""
        if stamp_ms != self._stamp_ms:
            self._stamp_ms, self._over = stamp_ms, False
        self._over = self._over or elapsed_ms(now_ms, stamp_ms) > self.limit_ms
        return self._over


class Monitor:
    """One region: degraded when updates come slowly, critical when they are missing.

    It returns to OK when updates have not been slow for ``recovery_s`` (1 s from degraded); the age of the
    data is not examined in critical.
    """

    def __init__(self, mean_ms: int, limit_ms: int, recovery_s: float) -> None:
        self.status = Level.OK
        self._first = True
        self._slow = Slow2(mean_ms)
        self._too_old = TooOld(limit_ms)
        self._deg = False
        self._from_degraded = Duration(steps(1))
        self._from_critical = Duration(steps(recovery_s))

    def step(self, stamp_ms: int, now_ms: int) -> Level:
        """The status of this step; OK in the first one."""
        too_old = self._too_old.update(stamp_ms, now_ms)
        target = Level.OK if self._first else self._transition(too_old)
        self._first = False
        if target is not None:
            self._enter(target)
        else:
            self._deg = self._slow.update(stamp_ms)
        self._from_degraded.end_step(self.status is Level.DEGRADED, not self._deg)
        self._from_critical.end_step(self.status is Level.CRITICAL, not self._deg)
        return self.status

    def _transition(self, too_old: bool) -> Level | None:
        """The state to enter, if a transition is valid."""
        if self.status is Level.OK and self._deg:
            return Level.DEGRADED
        if self.status is Level.DEGRADED and self._from_degraded.test(not self._deg):
            return Level.OK
        if self.status is Level.CRITICAL:
            return Level.OK if self._from_critical.test(not self._deg) else None
        return Level.CRITICAL if too_old else None

    def _enter(self, level: Level) -> None:
        self.status = level
        self._from_degraded.enter()
        self._from_critical.enter()


class Monitors:
    """The four monitors of Board 2; none reads what another writes."""

    def __init__(self) -> None:
        self._b1_sup = Monitor(mean_ms=60, limit_ms=150, recovery_s=2)
        self._esp = Monitor(mean_ms=40, limit_ms=120, recovery_s=1)
        self._imu = Monitor(mean_ms=100, limit_ms=200, recovery_s=1)
        self._rx = Monitor(mean_ms=40, limit_ms=120, recovery_s=1)

    def step(self, inputs: Board2Inputs) -> Statuses:
        """The statuses of this step."""
        now = inputs.now_ms
        return Statuses(
            b1_sup_status=self._b1_sup.step(inputs.last_valid_b1_ms, now),
            esp_status=self._esp.step(inputs.ble_last_valid_ms, now),
            imu_status=self._imu.step(inputs.imu_last_valid_ms, now),
            rx_status=self._rx.step(inputs.b1_data_last_valid_ms, now),
        )
