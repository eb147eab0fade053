"""Who drives: Board 1, or Board 2 while Board 1 hears nothing sound from it [spec §2.5, Fig 16]."""

from dataclasses import dataclass, field

from rovercheck.supervisor.timing import Duration, steps
from rovercheck.supervisor.types import Level


@dataclass
class Relay:
    """CH-RELAY: actuation goes to Board 2 at once, and comes back after more than 3 s without a cause.

    The first execution enters ``B1_actuating`` and tests nothing.
    """

    give_b2_actuation: bool = False
    _started: bool = False
    _sound: Duration = field(default_factory=lambda: Duration(steps(3)))

    def step(self, rx_status: Level, b2_sup_status: Level) -> bool:
        """One execution; true while Board 2 moves the rover."""
        sound = Level.CRITICAL not in (rx_status, b2_sup_status)
        if not self._started:
            self._started = True
        elif self.give_b2_actuation:
            self.give_b2_actuation = not self._sound.test(sound)
        elif not sound:
            self.give_b2_actuation = True
            self._sound.enter()
        self._sound.end_step(self.give_b2_actuation, sound)
        return self.give_b2_actuation
