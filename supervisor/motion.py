"""What the motion charts of both boards share: angles, standstill, and the references of the user."""

from collections.abc import Sequence
from dataclasses import dataclass
from math import isfinite

STANDSTILL_RPM = 2.5
"""A wheel slower than this stands."""


def axis(value: float) -> float:
    """A joystick axis that firmware may use: limited to [-1;1], and centred if it is infinite or no number.

    The document knows only axes in [-1;1]; a broken one must not move the rover.
    """
    return max(-1.0, min(1.0, value)) if isfinite(value) else 0.0


def heading(yaw: float) -> float:
    """The same heading in [0;360[ degrees; an infinite one is no number, and no number stays one."""
    return yaw % 360


def sign(value: float) -> int:
    """-1, 0 or 1."""
    return (value > 0) - (value < 0)


def wrap(degrees: float) -> float:
    """The same angle in [-180;180[; the argument is finite."""
    wrapped = (degrees + 180) % 360 - 180
    return wrapped if wrapped < 180 else -180.0  # a remainder just below 360 may be rounded up to it


def angle180(yaw: float) -> float:
    """The heading opposite to ``yaw``, in degrees; 180 gives 360, not 0."""
    opposite = yaw + 180
    return opposite - 360 if opposite > 360 else opposite


def angle_error(yaw: float, target: float) -> float:
    """Degrees to turn from ``yaw`` to ``target``, clockwise positive, in [-180;180[."""
    return wrap(target - yaw)


def check_stop(wheel_speed_rpm: Sequence[float]) -> bool:
    """Whether every wheel stands; one whose speed is infinite or no number does not."""
    return all(abs(speed) < STANDSTILL_RPM for speed in wheel_speed_rpm)


@dataclass
class UserReferences:
    """What the user asks for within the limits of the board, in parts of full scale.

    ``invert_y`` is set after a half turn made with the joystick pulled back: backward then means forward,
    until the joystick is no longer pulled back.
    """

    v_user: float = 0.0
    omega_user: float = 0.0
    invert_y: bool = False

    def update(self, x_norm: float, y_norm: float, v_max: float, omega_max: float) -> None:
        """The references of this step; the axes are finite."""
        self.v_user = y_norm * v_max
        self.omega_user = x_norm * omega_max
        if self.invert_y:
            if self.v_user >= 0:
                self.invert_y = False
            else:
                self.v_user = -self.v_user
