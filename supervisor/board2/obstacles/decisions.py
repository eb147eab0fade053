"""The decision about obstacles: go on, stop, or turn 45 degrees toward the sonar that saw one first."""

from dataclasses import dataclass, field
from math import isfinite
from types import MappingProxyType

from rovercheck.supervisor.board2.decision import Decision
from rovercheck.supervisor.board2.obstacles.events import Event
from rovercheck.supervisor.motion import angle_error
from rovercheck.supervisor.timing import After, steps

TURN_DEG = 45
STRAIGHT_S = 0.5

FROM_WAITING = MappingProxyType(
    {
        Event.EMERGENCY: Decision.STOP,
        Event.MOVE_TO_S1: Decision.TOWARD_S1,
        Event.MOVE_TO_S2: Decision.TOWARD_S2,
        Event.MOVE_TO_S3: Decision.TOWARD_S3,
    }
)


def target_angle(yaw: float, decision: Decision) -> float:
    """The heading after the turn, in degrees clockwise: sonar 1 is on the left (E07) [spec §3.4.1]."""
    if decision is Decision.TOWARD_S1:
        left = yaw - TURN_DEG
        return left + 360 if left < 0 else left
    right = yaw + TURN_DEG
    return right - 360 if right > 360 else right


def has_turned(yaw: float, target: float, decision: Decision) -> bool:
    """Whether the rover has turned to the target or past it (E06).

    A heading that is no finite number measures no turn.  A turn that cannot be measured would last for
    ever (E08), so it counts as made, and the user steers.
    """
    if not (isfinite(yaw) and isfinite(target)):
        return True
    error = angle_error(yaw, target)
    return error >= 0 if decision is Decision.TOWARD_S1 else error <= 0


@dataclass
class Decisions:
    """``B2Decisions`` [spec Fig 25].  Every state sets its own output: the decision is the state.

    A move is not changed by another moving obstacle (E19); only an emergency, its end or a degraded
    Board 1 end it.
    """

    decision: Decision = Decision.READY
    _target: float = 0.0
    _straight: After = field(default_factory=lambda: After(steps(STRAIGHT_S)))

    def tick(self) -> None:
        """Call it at the start of every executed step of the chart."""
        self._straight.tick()

    def execute(self, event: Event | None, yaw: float, prev_deg_b1: bool) -> None:
        """One execution, nested or not: transitions without an event are tested in both."""
        match self.decision:
            case Decision.READY:
                if event is not None and event in FROM_WAITING:
                    self._enter(FROM_WAITING[event], yaw)
            case Decision.STOP:
                if event is Event.SAFE:
                    self._enter(Decision.READY, yaw)
            case _:
                if event is Event.EMERGENCY:
                    self._enter(Decision.STOP, yaw)
                elif self._move_is_over(yaw) or prev_deg_b1:
                    self._enter(Decision.READY, yaw)

    def _enter(self, decision: Decision, yaw: float) -> None:
        self.decision = decision
        if decision in (Decision.TOWARD_S1, Decision.TOWARD_S3):
            self._target = target_angle(yaw, decision)
        elif decision is Decision.TOWARD_S2:
            self._straight.enter()

    def _move_is_over(self, yaw: float) -> bool:
        if self.decision is Decision.TOWARD_S2:
            return self._straight.over
        return has_turned(yaw, self._target, self.decision)
