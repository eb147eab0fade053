"""What each board tells the other every 20 ms; the initial values are those before the first accepted frame.

[spec §1.2, §2.2, Fig 3, Fig 4]
"""

from dataclasses import dataclass

from rovercheck.supervisor.types import SupervisorCommand


@dataclass(frozen=True, slots=True)
class FromBoard1:
    """The payload of Board 1 for Board 2."""

    wheel_speed_rpm: tuple[float, float, float, float] = (0.0, 0.0, 0.0, 0.0)
    """Measured speeds: front left, front right, rear left, rear right."""
    critical_mask: int = 0
    """Critical components of Board 1, bits 0 to 7 [spec Table 1]."""
    degraded_mask: int = 0
    alive_counter: int = 0
    """Executions of the supervisor of Board 1 since power-up, modulo 2**32 [spec Table 2]."""


@dataclass(frozen=True, slots=True)
class FromBoard2:
    """The payload of Board 2 for Board 1."""

    command: SupervisorCommand = SupervisorCommand.CMD_NORMAL
    critical_mask: int = 0
    """Critical components of Board 2: bits 0 to 3 are used."""
    degraded_mask: int = 0
    is_motion_consistent: bool = True
    """Whether IMU and wheels agree on the rotation; taken as true before the first accepted frame."""
    yaw: float = 0.0
    """Heading in degrees, [0;360[, clockwise positive."""
    x_norm: float = 0.0
    """Turning command of the joystick, [-1;1], positive to the left."""
    y_norm: float = 0.0
    """Speed command of the joystick, [-1;1], positive forward."""
    btn1: bool = False
    btn2: bool = False
    alive_counter: int = 0
    """Executions of the supervisor of Board 2 since power-up, modulo 2**32 [spec Table 2]."""
