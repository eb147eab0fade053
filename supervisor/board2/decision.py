"""The obstacle decision of Board 2, and the command that it becomes for the motion charts."""

from enum import IntEnum
from types import MappingProxyType

from rovercheck.supervisor.types import SupervisorCommand


class Decision(IntEnum):
    """``B2Dec``: 0 to 4 with Board 1 healthy, 5 and 6 in the degraded state [spec Figs 24, 28]."""

    READY = 0
    STOP = 1
    TOWARD_S1 = 2
    TOWARD_S2 = 3
    TOWARD_S3 = 4
    DEGRADED_MOVE = 5
    DEGRADED_STOP = 6


COMMANDS = MappingProxyType(
    {
        Decision.READY: SupervisorCommand.CMD_NORMAL,
        Decision.STOP: SupervisorCommand.CMD_ESTOP,
        Decision.TOWARD_S1: SupervisorCommand.CMD_GO_LEFT,
        Decision.TOWARD_S2: SupervisorCommand.CMD_NORMAL,
        Decision.TOWARD_S3: SupervisorCommand.CMD_GO_RIGHT,
        Decision.DEGRADED_MOVE: SupervisorCommand.CMD_NORMAL,
        Decision.DEGRADED_STOP: SupervisorCommand.CMD_ESTOP,
    }
)
"""The command of each decision (E04); straight ahead is no command of its own (E31)."""
