"""The states of Board 1's ``Motion_Supervision``, the commands that lead to them, and its inputs."""

from dataclasses import dataclass
from enum import Enum, auto

from rovercheck.supervisor.types import SafetyState, SupervisorCommand


class Motion(Enum):
    """The innermost states of ``Motion_Supervision``; the last two are the emergency stop procedure."""

    NORMALE_MARCIA = auto()
    SCHIVATA_A_SINISTRA = auto()
    SCHIVATA_A_DESTRA = auto()
    EVITA_SINISTRA = auto()
    EVITA_DESTRA = auto()
    RETROMARCIA_180 = auto()
    IN_FRENATA_DI_EMERGENZA = auto()
    MOTORI_FERMI = auto()


PROCEDURA_EMERGENCY_STOP = (Motion.IN_FRENATA_DI_EMERGENZA, Motion.MOTORI_FERMI)

ACTIONS = {
    Motion.NORMALE_MARCIA: SupervisorCommand.CMD_NORMAL,
    Motion.SCHIVATA_A_SINISTRA: SupervisorCommand.CMD_GO_LEFT,
    Motion.SCHIVATA_A_DESTRA: SupervisorCommand.CMD_GO_RIGHT,
    Motion.EVITA_SINISTRA: SupervisorCommand.CMD_AVOID_LEFT,
    Motion.EVITA_DESTRA: SupervisorCommand.CMD_AVOID_RIGHT,
    Motion.RETROMARCIA_180: SupervisorCommand.CMD_ROTATE_180,
    Motion.IN_FRENATA_DI_EMERGENZA: SupervisorCommand.CMD_ESTOP,
    Motion.MOTORI_FERMI: SupervisorCommand.CMD_STOP,
}
"""``current_action``, written on entry of each state."""

MANOEUVRES = {
    SupervisorCommand.CMD_GO_LEFT: Motion.SCHIVATA_A_SINISTRA,
    SupervisorCommand.CMD_AVOID_LEFT: Motion.EVITA_SINISTRA,
    SupervisorCommand.CMD_AVOID_RIGHT: Motion.EVITA_DESTRA,
    SupervisorCommand.CMD_GO_RIGHT: Motion.SCHIVATA_A_DESTRA,
}
"""What a command starts while the user drives forward; every other command starts none."""


@dataclass(frozen=True, slots=True)
class MotionInputs:
    """What ``Motion_Supervision`` reads in one step; axes and heading are in their range, or no heading."""

    cmd: SupervisorCommand
    x_norm: float
    y_norm: float
    yaw: float
    wheel_speed_rpm: tuple[float, float, float, float]
    rover_status: SafetyState
    backward_enabled: bool
