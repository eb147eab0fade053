"""The pairs of sonars: an obstacle that left one and is seen by its neighbour within three seconds."""

from dataclasses import dataclass, field

from rovercheck.supervisor.board2.obstacles.events import Event, Send
from rovercheck.supervisor.timing import After, steps

WINDOW_S = 3
Detected = tuple[bool, bool, bool]
"""Whether sonars 1, 2 and 3 have an obstacle in their field."""


@dataclass
class PairTimer:
    """One region of ``timers``: waits for the fall of one sonar, then for the flag of the other.

    A second fall within the window does not start it again (E16); the flag counts also when it was set
    before the fall (E15), but no longer in the step in which the window ends (E14).
    """

    fall: Event
    neighbour: int
    move: Event
    _fallen: bool = False
    _window: After = field(default_factory=lambda: After(steps(WINDOW_S)))

    def tick(self) -> None:
        """Call it at the start of every executed step of the chart."""
        self._window.tick()

    def execute(self, event: Event | None, detected: Detected, send: Send) -> None:
        """One execution, nested or not; ``send`` reaches the decisions."""
        if not self._fallen:
            if event is self.fall:
                self._fallen = True
                self._window.enter()
        elif self._window.over:
            self._fallen = False
        elif detected[self.neighbour]:
            send(self.move)
            self._fallen = False


def pair_timers() -> tuple[PairTimer, ...]:
    """The four regions in their order, which decides when two pairs are seen in one step (E20)."""
    return (
        PairTimer(Event.FALL1, neighbour=1, move=Event.MOVE_TO_S1),
        PairTimer(Event.FALL2, neighbour=0, move=Event.MOVE_TO_S2),
        PairTimer(Event.FALL2, neighbour=2, move=Event.MOVE_TO_S2),
        PairTimer(Event.FALL3, neighbour=1, move=Event.MOVE_TO_S3),
    )
