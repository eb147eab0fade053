"""The safety state of the rover while Board 2 drives it: degraded at best."""

from dataclasses import dataclass

from rovercheck.supervisor.types import SafetyState


@dataclass
class Safety:
    """Degraded, or critical while either board reports an emergency.  Executed in authorised steps only."""

    rover_safety_state: SafetyState = SafetyState.SAFETY_OK

    def step(self, emergency: bool) -> SafetyState:
        """The state of this step; degraded in the first one, whatever the masks."""
        first = self.rover_safety_state is SafetyState.SAFETY_OK
        critical = emergency and not first
        self.rover_safety_state = SafetyState.SAFETY_CRITICAL if critical else SafetyState.SAFETY_DEGRADED
        return self.rover_safety_state
