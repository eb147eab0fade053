"""Time as firmware sees it: millisecond stamps of a 32-bit clock, and counts of executed steps."""

from collections import deque
from dataclasses import dataclass, field

from rovercheck.supervisor.types import STEP_MS

CLOCK = 1 << 32
"""The millisecond clock of a board starts again at 0 after 49.7 days."""
INTERVALS = 10
"""Intervals of a moving mean [spec Table 2]."""


def elapsed_ms(now_ms: int, then_ms: int) -> int:
    """Milliseconds since an earlier stamp, also across one wrap of the clock."""
    return (now_ms - then_ms) % CLOCK


def steps(seconds: float) -> int:
    """The executed steps that a time of a chart lasts."""
    return round(seconds * 1000 / STEP_MS)


@dataclass
class Held:
    """Whether a condition has been true, without a step in between, for at least ``limit_ms``."""

    limit_ms: int
    _since_ms: int | None = None
    _over: bool = False

    def update(self, condition: bool, now_ms: int) -> bool:
        """Call it once in every step."""
        if not condition:
            self._since_ms, self._over = None, False
            return False
        if self._since_ms is None:
            self._since_ms = now_ms
        self._over = self._over or elapsed_ms(now_ms, self._since_ms) >= self.limit_ms
        return self._over


@dataclass
class Age:
    """Milliseconds since a stamp; data that miss a whole turn of the clock do not become young again."""

    _stamp_ms: int = 0
    _oldest: int = 0

    def update(self, stamp_ms: int, now_ms: int) -> int:
        """Call it once in every step."""
        if stamp_ms != self._stamp_ms:
            self._stamp_ms, self._oldest = stamp_ms, 0
        self._oldest = max(self._oldest, elapsed_ms(now_ms, stamp_ms))
        return self._oldest


@dataclass
class IntervalMean:
    """Whether the last ten intervals between updates of a stamp are longer than ``mean_ms`` on average.

    The interval from power-up to the first update is none [spec Table 2]; fewer than ten intervals say
    nothing.
    """

    mean_ms: int
    _stamp_ms: int = 0
    _updated: bool = False
    _intervals: deque[int] = field(default_factory=lambda: deque(maxlen=INTERVALS))

    def update(self, stamp_ms: int) -> bool:
        """Call it once in every step."""
        if stamp_ms != self._stamp_ms:
            if self._updated:
                self._intervals.append(elapsed_ms(stamp_ms, self._stamp_ms))
            self._stamp_ms, self._updated = stamp_ms, True
        return len(self._intervals) == INTERVALS and sum(self._intervals) > INTERVALS * self.mean_ms


@dataclass
class After:
    """``after(t, sec)``: so many executed steps have passed since a state was entered."""

    limit: int
    _count: int = 0

    def enter(self) -> None:
        """The state is entered."""
        self._count = 0

    def tick(self) -> None:
        """Call it at the start of every executed step of the chart, before any state runs."""
        self._count = min(self._count + 1, self.limit)

    @property
    def over(self) -> bool:
        return self._count >= self.limit


@dataclass
class Duration:
    """``duration(c) > t``: a condition has been true at the end of more than ``limit`` steps in a row.

    ``limit`` is in executed steps.  ``test`` is for the guard; ``end_step`` closes every executed step.
    """

    limit: int
    _count: int = 0

    def enter(self) -> None:
        """The state is entered."""
        self._count = 0

    def test(self, condition: bool) -> bool:
        """The guard, when the state is executed."""
        if not condition:
            self._count = 0
        return self._count > self.limit

    def end_step(self, active: bool, condition: bool) -> None:
        """The end of an executed step, with the values at its end and whether the state is then active."""
        if active:
            self._count = min(self._count + 1, self.limit + 1) if condition else 0


@dataclass
class Rising:
    """A rising edge: above 0 now, not so in the executed step before; never in the first one."""

    _before: bool = True

    def update(self, value: float) -> bool:
        """Call it once in every executed step of the chart, whether or not the edge is asked for."""
        high = value > 0
        edge = high and not self._before
        self._before = high
        return edge
