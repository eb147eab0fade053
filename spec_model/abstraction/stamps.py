"""Time stamps as firmware holds them: milliseconds of a 32-bit clock, read as ages, updates and intervals."""

from collections import deque
from fractions import Fraction

from rovercheck.spec_model.abstraction.signals import Raw, whole
from rovercheck.spec_model.lang.system import TICK_MS

NOW = "now_ms"
"""The name of the clock itself, the time of the step, on every board."""
CLOCK = 1 << 32
"""The clock of a board starts again at 0 after 49.7 days."""


def since(now_ms: int, then_ms: int) -> int:
    """Milliseconds from an earlier stamp, also across one wrap of the clock."""
    return (now_ms - then_ms) % CLOCK


def age(now_ms: int, then_ms: int) -> Raw:
    """The raw age of a stamp: in ticks of 20 ms, a fraction for a stamp between two steps."""
    return whole(Fraction(since(now_ms, then_ms), TICK_MS))


class Updates:
    """The changes of one stamp, from power-up, where it is 0."""

    def __init__(self) -> None:
        self._stamp = 0

    def step(self, stamp: int) -> int | None:
        """The stamp before, in a step that finds a new one."""
        before, self._stamp = self._stamp, stamp
        return before if stamp != before else None


class MeanOfTen:
    """Whether the last ten intervals between updates exceed a mean, in ms [spec Table 2].

    The power-up begins no interval, and fewer than ten say nothing (S34, S66); the open interval does not
    count (S35) and of several updates between two steps only the last is seen (S36).
    """

    def __init__(self, mean_ms: int, bits: int = 0) -> None:
        """``bits``: in how many bits the intervals are added up; 0: in as many as they need."""
        self._total, self._limit = 10 * mean_ms, 1 << bits if bits else 0
        self._updates = Updates()
        self._latest: int | None = None
        self._intervals: deque[int] = deque(maxlen=10)

    def step(self, stamp: int) -> bool:
        """Call it once in every step."""
        if self._updates.step(stamp) is not None:
            if self._latest is not None:
                self._intervals.append(since(stamp, self._latest))
            self._latest = stamp
        total = sum(self._intervals)
        total = total % self._limit if self._limit else total
        return len(self._intervals) == 10 and total > self._total


class Stamp:
    """The stamp that a run of the model stands for, from the age it gives the datum in each step."""

    def __init__(self) -> None:
        self._value = 0

    def step(self, now_ms: int, ticks: int, most: int, tick_ms: int = TICK_MS) -> int:
        """``ticks`` is the raw age; at ``most`` it stands for all larger ones, and the stamp stays."""
        if ticks < most:
            self._value = now_ms - ticks * tick_ms
        return self._value
