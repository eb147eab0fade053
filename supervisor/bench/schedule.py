"""When the tasks of both boards run: their periods, their first runs, and the order within one instant."""

from collections.abc import Callable
from dataclasses import dataclass, field
from enum import IntEnum
from heapq import heappop, heappush
from types import MappingProxyType

MILLION = 10**6
PERIODS_US = MappingProxyType(
    {
        "supervisor_1": 20_000,
        "transmit_1": 20_000,
        "control": 10_000,
        "health": 100_000,
        "supervisor_2": 20_000,
        "transmit_2": 20_000,
        "sonars": 60_000,
        "joystick": 20_000,
        "imu": 20_000,
    }
)
"""The periodic tasks by name; reception and Board 2's motor commands follow other tasks."""
LATER = ("supervisor_1", "transmit_1", "supervisor_2", "transmit_2")
"""Tasks that first run one period after power-up, so that sensors have data by then; the others at once."""


class Rank(IntEnum):
    """What comes first within one instant."""

    WORLD = 0
    RECEIVE = 1
    SENSE = 2
    SUPERVISE = 3
    ACTUATE = 4
    TRANSMIT = 5
    WATCH = 6


@dataclass(frozen=True)
class Clock:
    """The clock of a board: 0 at its power-up, and faster than the scenario's by ``drift_ppm``."""

    power_up_us: int
    drift_ppm: int = 0

    def local_us(self, time_us: int) -> int:
        """The clock at a time of the scenario that is not before power-up."""
        return (time_us - self.power_up_us) * (MILLION + self.drift_ppm) // MILLION

    def now_ms(self, time_us: int) -> int:
        """The same in whole milliseconds, as tasks read it."""
        return self.local_us(time_us) // 1000

    def time_us(self, local_us: int) -> int:
        """The first microsecond of the scenario at which the clock shows so much."""
        return self.power_up_us - (-local_us * MILLION // (MILLION + self.drift_ppm))


Action = Callable[[int], None]
"""What happens at a time in microseconds."""


@dataclass
class Agenda:
    """What is still to happen, in the order of time, rank and entry."""

    _entries: list[tuple[int, Rank, int, Action]] = field(default_factory=list)
    _entered: int = 0

    def enter(self, time_us: int, rank: Rank, action: Action) -> None:
        """Let ``action`` happen at that time."""
        self._entered += 1
        heappush(self._entries, (time_us, rank, self._entered, action))

    def run(self, until_us: int) -> None:
        """Everything up to and at that time."""
        while self._entries and self._entries[0][0] <= until_us:
            time_us, _, _, action = heappop(self._entries)
            action(time_us)
