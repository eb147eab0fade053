"""Obstacles in the degraded state: any obstacle within three metres stops the rover."""

from dataclasses import dataclass

from rovercheck.supervisor.board2.decision import Decision
from rovercheck.supervisor.board2.distances import STOP_DEGRADED_CM, Distances, within


@dataclass
class DegradedObstacles:
    """The obstacle chart of the degraded state [spec §3.4.2, Fig 28].

    In its first execution it lets the rover move whatever the distances: no transition is tested yet.
    """

    _decision: Decision | None = None

    def step(self, distances: Distances) -> Decision:
        """Execute one step; the distances are in cm."""
        if self._decision is None or not within(distances, STOP_DEGRADED_CM):
            self._decision = Decision.DEGRADED_MOVE
        else:
            self._decision = Decision.DEGRADED_STOP
        return self._decision
