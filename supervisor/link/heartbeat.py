"""The heartbeat of a supervisor [spec Table 2]: the counter that it sends, and how the other compares it."""

from dataclasses import dataclass

COUNTER = 1 << 32
"""An alive counter starts again at 0 here, after 2.7 years."""


@dataclass
class AliveCounter:
    """The sender's side: how often its supervisor was executed since power-up, modulo 2**32."""

    value: int = 0

    def executed(self) -> int:
        """Call it in every execution; the value belongs in the snapshot published at its end."""
        self.value = (self.value + 1) % COUNTER
        return self.value


@dataclass
class Heartbeat:
    """The receiver's side: when the counter of the other supervisor was last seen to change.

    Any change is one update [S40], by however much, up or down: a wrap or a restart of the sender is seen
    too, unless it happens to repeat the value remembered.
    """

    last_valid_ms: int = 0
    """``last_valid_b2_ms`` on Board 1, ``last_valid_b1_ms`` on Board 2; 0 before the first change."""
    _remembered: int = 0

    def update(self, received: int, now_ms: int) -> int:
        """Call it in every step before the charts run, with the counter last received: ``last_valid_ms``."""
        if received != self._remembered:
            self._remembered, self.last_valid_ms = received, now_ms
        return self.last_valid_ms
