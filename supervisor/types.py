"""The enumerations that both boards exchange, with the numbers they have on the wire."""

from enum import IntEnum

STEP_MS = 20
"""Milliseconds from one execution of a supervisor to the next."""


class Level(IntEnum):
    """How well a component works: every status signal of both boards [spec Table 2]."""

    OK = 0
    DEGRADED = 1
    CRITICAL = 2


class SafetyState(IntEnum):
    """``rover_safety_state`` [spec Fig 20]."""

    SAFETY_OK = 0
    SAFETY_DEGRADED = 1
    SAFETY_CRITICAL = 2


class SupervisorCommand(IntEnum):
    """What a board does, or asks the other to do [spec Fig 12]."""

    CMD_NORMAL = 0
    CMD_ROTATE_180 = 1
    CMD_GO_LEFT = 2
    CMD_GO_RIGHT = 3
    CMD_AVOID_RIGHT = 4
    CMD_AVOID_LEFT = 5
    CMD_STOP = 6
    CMD_ESTOP = 7
