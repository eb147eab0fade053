"""One step of the obstacle chart: its regions in their order, and who receives whose events."""

from dataclasses import dataclass, field

from rovercheck.supervisor.board2.decision import Decision
from rovercheck.supervisor.board2.distances import Distances
from rovercheck.supervisor.board2.obstacles.decisions import Decisions
from rovercheck.supervisor.board2.obstacles.events import Event
from rovercheck.supervisor.board2.obstacles.sonars import NearObstacle, SonarField
from rovercheck.supervisor.board2.obstacles.timers import Detected, PairTimer, pair_timers


def _sonar_fields() -> tuple[SonarField, SonarField, SonarField]:
    return SonarField(Event.FALL1), SonarField(Event.FALL2), SonarField(Event.FALL3)


@dataclass
class Obstacles:
    """The obstacle chart of the non-degraded state [spec §3.4.1, Figs 24-27].

    Its first execution needs no case of its own: with all flags 0 no transition is valid, and entry actions
    take over the distances as the during actions do.
    """

    _near: NearObstacle = field(default_factory=NearObstacle)
    _fields: tuple[SonarField, SonarField, SonarField] = field(default_factory=_sonar_fields)
    _timers: tuple[PairTimer, ...] = field(default_factory=pair_timers)
    _decisions: Decisions = field(default_factory=Decisions)

    def step(self, distances: Distances, yaw: float, prev_deg_b1: bool) -> Decision:
        """Execute one step of 20 ms.

        ``distances`` are in cm, ``yaw`` in degrees clockwise; ``prev_deg_b1`` is whether Board 1 was
        degraded in the step before, which ends a move.
        """
        self._tick()

        def decide(event: Event | None) -> None:
            self._decisions.execute(event, yaw, prev_deg_b1)

        def watch(event: Event | None) -> None:
            for timer in self._timers:
                timer.execute(event, self._detected, decide)

        self._near.execute(distances, decide)
        for sonar, distance in zip(self._fields, distances, strict=True):
            sonar.execute(distance, self._near.stop, watch)
        watch(None)
        decide(None)
        return self._decisions.decision

    def _tick(self) -> None:
        for timer in self._timers:
            timer.tick()
        self._decisions.tick()

    @property
    def _detected(self) -> Detected:
        left, centre, right = self._fields
        return left.detected, centre.detected, right.detected
