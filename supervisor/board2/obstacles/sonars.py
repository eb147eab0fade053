"""The sonars watched: is one too near, and has a moving obstacle left the field of one."""

from dataclasses import dataclass

from rovercheck.supervisor.board2.distances import STOP_CM, Distances, close_range, within
from rovercheck.supervisor.board2.obstacles.events import Event, Send


@dataclass
class NearObstacle:
    """``distance_70``: tells of an emergency, and when it is over [spec Fig 26].

    Its transitions see the ``stop`` of the step before, so that the events come one step after the distances.
    """

    stop: bool = False
    _moving_again: bool = False

    def execute(self, distances: Distances, send: Send) -> None:
        """One execution; ``send`` reaches the decisions."""
        if self.stop and not self._moving_again:
            send(Event.EMERGENCY)
            self._moving_again = True
        elif not self.stop and self._moving_again:
            send(Event.SAFE)
            self._moving_again = False
        self.stop = within(distances, STOP_CM)


@dataclass
class SonarField:
    """``Waiting_Si``: an obstacle enters and leaves the field of one sonar (E17) [spec Fig 27].

    A near obstacle before any sonar freezes what is remembered (E18, E27).
    """

    fall: Event
    detected: bool = False
    _is_close: bool = False

    def execute(self, distance: float, stop: bool, send: Send) -> None:
        """One execution; ``send`` reaches the timers, which must already see the obstacle as gone."""
        if not stop:
            if self._is_close:
                self.detected = True
            elif self.detected:
                self.detected = False
                send(self.fall)
        self._is_close = close_range(distance)
