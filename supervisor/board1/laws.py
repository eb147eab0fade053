"""How Board 1 steers around an obstacle, and how it turns by 180° [spec §2.7, Fig 20]."""

from rovercheck.supervisor.board1.limits import Limits
from rovercheck.supervisor.board1.states import Motion
from rovercheck.supervisor.motion import UserReferences, sign
from rovercheck.supervisor.types import SafetyState

FINE_DEG = 45
"""Within this angle of its target a half turn slows down."""


def avoid(state: Motion, user: UserReferences, limits: Limits) -> tuple[float, float]:
    """``v_ref`` and ``omega_ref`` of the two dodges (Schivata) and the two avoidances (Evita)."""
    slow = min(user.v_user, limits.v_max_maneuver)
    if state is Motion.SCHIVATA_A_SINISTRA:
        return slow, max(user.omega_user, limits.omega_go_left)
    if state is Motion.SCHIVATA_A_DESTRA:
        return slow, min(user.omega_user, limits.omega_go_right)
    if state is Motion.EVITA_DESTRA:
        return user.v_user, max(user.omega_user, 0.0)
    return user.v_user, min(user.omega_user, 0.0)


def turn(angle_err: float, omega_max: float, rover_status: SafetyState) -> float | None:
    """``omega_ref`` of a half turn, or None: near its target a degraded rover keeps the speed it has.

    ``angle_err`` is in degrees and finite, clockwise positive; ``omega_ref`` is positive to the left.
    """
    error = abs(angle_err)
    if error > FINE_DEG:
        return sign(-angle_err) * omega_max
    if rover_status is SafetyState.SAFETY_OK:
        return sign(-angle_err) * min(omega_max, 0.005 * max(error, 15))
    return None
