"""The faults of a step: the statuses of the sources, the masks made of them, and what they ask for."""

from dataclasses import dataclass, field

from rovercheck.supervisor.board2.classify import Classification, classify
from rovercheck.supervisor.board2.masks import Statuses, mask
from rovercheck.supervisor.board2.monitors import Monitors
from rovercheck.supervisor.board2.signals import Board2Inputs
from rovercheck.supervisor.types import Level


@dataclass(frozen=True, slots=True)
class Faults:
    """What the monitors, the masks and the classification say in one step."""

    statuses: Statuses
    critical_mask: int
    degraded_mask: int
    classification: Classification


@dataclass
class FaultFinder:
    """The blocks from the monitors to the classification [spec §3.1]."""

    _monitors: Monitors = field(default_factory=Monitors)

    def step(self, inputs: Board2Inputs) -> Faults:
        """The faults of this step; none of Board 2 in the first one."""
        statuses = self._monitors.step(inputs)
        critical_mask = mask(statuses, Level.CRITICAL)
        return Faults(
            statuses=statuses,
            critical_mask=critical_mask,
            degraded_mask=mask(statuses, Level.DEGRADED),
            classification=classify(critical_mask, inputs.payload.critical_mask),
        )
