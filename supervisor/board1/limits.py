"""How fast Board 1 may drive in each safety state [spec §2.7, Fig 20]."""

from dataclasses import dataclass

from rovercheck.supervisor.types import SafetyState


@dataclass(frozen=True, slots=True)
class Limits:
    """Parts of full scale; angular velocities are positive to the left."""

    v_max: float
    omega_max: float
    v_max_maneuver: float
    omega_go_left: float
    omega_go_right: float


LIMITS = {
    SafetyState.SAFETY_OK: Limits(1.0, 1.0, 0.8, 0.4, -0.4),
    SafetyState.SAFETY_DEGRADED: Limits(0.5, 0.5, 0.4, 0.2, -0.2),
    SafetyState.SAFETY_CRITICAL: Limits(0.0, 0.0, 0.0, 0.0, 0.0),
}
"""``updateSafetyLimits``."""
