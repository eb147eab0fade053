"""Which of the two obstacle decisions counts, and the command that Board 1 is sent."""

from dataclasses import dataclass, field

from rovercheck.supervisor.board2.decision import COMMANDS, Decision
from rovercheck.supervisor.board2.distances import Distances
from rovercheck.supervisor.board2.obstacles import Obstacles
from rovercheck.supervisor.board2.obstacles_degraded import DegradedObstacles
from rovercheck.supervisor.types import SupervisorCommand


@dataclass(frozen=True)
class Selected:
    """The result of a step: ``B2Dec``, its command, and whether the degraded decision was taken."""

    b2_dec: Decision
    command: SupervisorCommand
    deg_b1: bool


@dataclass
class Selection:
    """Both obstacle charts run in every step (E32); the degraded one counts if Board 1 is not healthy or
    Board 2 drives (E09) [spec Figs 12, 24, 28]."""

    _obstacles: Obstacles = field(default_factory=Obstacles)
    _degraded: DegradedObstacles = field(default_factory=DegradedObstacles)
    _deg_b1: bool = False

    def step(
        self, distances: Distances, yaw: float, critical_mask: int, degraded_mask: int, autorized: bool
    ) -> Selected:
        """Execute one step.

        The masks are those received from Board 1; ``autorized`` is whether Board 2 was authorised to send
        commands in the step before.
        """
        prev_deg_b1 = self._deg_b1
        self._deg_b1 = degraded_mask != 0 or critical_mask != 0 or autorized
        healthy = self._obstacles.step(distances, yaw, prev_deg_b1)
        degraded = self._degraded.step(distances)
        b2_dec = degraded if self._deg_b1 else healthy
        return Selected(b2_dec, COMMANDS[b2_dec], self._deg_b1)
