"""One direction of the serial link: bytes that take their time, and what a scenario does to them."""

from collections.abc import Callable
from dataclasses import dataclass, field
from random import Random
from typing import Generic

from rovercheck.supervisor.bench.record import Traffic
from rovercheck.supervisor.bench.scenario import Scenario
from rovercheck.supervisor.bench.schedule import MILLION, Agenda, Rank
from rovercheck.supervisor.link.frame import Refusal
from rovercheck.supervisor.link.receiver import Receiver
from rovercheck.supervisor.link.wire import P

BAUD = 460_800
BITS_PER_BYTE = 10
"""A start bit, eight of data and a stop bit; only those of data are ever wrong."""

Deliver = Callable[[int, int], None]
"""Takes a time in microseconds and the byte that arrives then."""


@dataclass
class Line:
    """``way`` is ``b1_b2`` or ``b2_b1``, as in the names of the conditions."""

    way: str
    scenario: Scenario
    agenda: Agenda
    deliver: Deliver
    traffic: Traffic
    _busy_until_us: int = 0
    _last_arrival_us: int = 0
    _random: Random = field(init=False)

    def __post_init__(self) -> None:
        self._random = Random(f"{self.scenario.seed} {self.way}")

    def send(self, frame: bytes, time_us: int) -> None:
        """Begin to send a frame, unless the one before is still being sent."""
        if time_us < self._busy_until_us:
            self.traffic.dropped += 1
            return
        self._busy_until_us = time_us + duration_us(len(frame))
        self.traffic.sent += 1
        lost = self._happens("frame_loss", time_us)
        for place, byte in enumerate(frame):
            self._send_byte(byte, time_us + duration_us(place), time_us + duration_us(place + 1), lost)

    def _send_byte(self, byte: int, from_us: int, until_us: int, lost: bool) -> None:
        damaged = byte ^ self._wrong_bits(from_us)
        if lost or self.scenario.at(f"link_{self.way}", from_us) == "cut":
            return
        delayed_us = until_us + int(self.scenario.number(f"delay_{self.way}", from_us))
        self._last_arrival_us = max(self._last_arrival_us, delayed_us)
        self.agenda.enter(self._last_arrival_us, Rank.RECEIVE, lambda at: self.deliver(at, damaged))

    def _wrong_bits(self, time_us: int) -> int:
        if not self.scenario.number(f"bit_errors_{self.way}", time_us):
            return 0
        return sum(1 << bit for bit in range(8) if self._happens("bit_errors", time_us))

    def _happens(self, condition: str, time_us: int) -> bool:
        probability = self.scenario.number(f"{condition}_{self.way}", time_us)
        return probability > 0 and self._random.random() < probability


def duration_us(number: int) -> int:
    """How long so many bytes take, rounded up."""
    return -(-number * BITS_PER_BYTE * MILLION // BAUD)


@dataclass
class Port(Generic[P]):
    """The receive task of a board, and the count of what it makes of the bytes."""

    receiver: Receiver[P]
    traffic: Traffic

    def byte(self, byte: int, now_ms: int) -> None:
        """A byte arrives."""
        result = self.receiver.byte(byte, now_ms)
        if isinstance(result, Refusal):
            self.traffic.refused[result.value] += 1
        elif result is not None:
            self.traffic.accepted += 1
