"""The safety state of Board 1, from the faults of both boards [spec §2.7, Fig 21]."""

from dataclasses import dataclass

from rovercheck.supervisor.types import SafetyState


@dataclass
class Safety:
    """CH-SAFE1, arc by arc: a degraded rover without degraded cause is first safe, even if one is critical.

    The first execution enters ``Rover_Safe_State`` and tests nothing.
    """

    state: SafetyState = SafetyState.SAFETY_OK
    _started: bool = False

    def step(self, critical: bool, degraded: bool) -> SafetyState:
        """One execution, with the causes of both boards."""
        if not self._started:
            self._started = True
        elif self.state is SafetyState.SAFETY_OK:
            if critical:
                self.state = SafetyState.SAFETY_CRITICAL
            elif degraded:
                self.state = SafetyState.SAFETY_DEGRADED
        elif self.state is SafetyState.SAFETY_DEGRADED:
            if not degraded:
                self.state = SafetyState.SAFETY_OK
            elif critical:
                self.state = SafetyState.SAFETY_CRITICAL
        elif not critical:
            self.state = SafetyState.SAFETY_DEGRADED if degraded else SafetyState.SAFETY_OK
        return self.state
