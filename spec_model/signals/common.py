"""Enumerations and domains that both boards use; the names of the members are the document's own."""

from rovercheck.spec_model.lang.domain import chosen, enumeration, fixed, integer

COMMAND = enumeration(
    "SupervisorCommand_t",
    [
        "CMD_NORMAL",
        "CMD_ROTATE_180",
        "CMD_GO_LEFT",
        "CMD_GO_RIGHT",
        "CMD_AVOID_RIGHT",
        "CMD_AVOID_LEFT",
        "CMD_STOP",
        "CMD_ESTOP",
    ],
)
"""The command of a supervisor, 0 to 7 [spec §2.2, Fig 12]."""

SAFETY_STATUS = enumeration("SafetyStatus", ["SAFETY_OK", "SAFETY_DEGRADED", "SAFETY_CRITICAL"])
"""The safety state from which the limits follow [spec §2.7, Fig 20]."""

RX_STATUS = enumeration("RxStatus", ["RX_OK", "RX_DEGRADED", "RX_CRITICAL"])
"""State of the reception from the other board [spec §2.4, Table 2]; each board has its own."""

SUP_STATUS = enumeration("SupStatus", ["SUP_OK", "SUP_DEGRADED", "SUP_CRITICAL"])
"""State of the supervisor of the other board, by its heartbeat [spec §2.4, Table 2]."""

FAULT_MASK = integer(0, 255)
"""A fault mask of 8 bits, bit 0 worth 1 [spec §2.3, Table 1]."""

B2_FAULT_MASK = integer(0, 15)
"""A fault mask of Board 2, of whose 8 bits the lowest four are used (S54, E24)."""

USER_X = chosen([-1, 0, 1])
"""The user's turning command: beyond each limit of a turn, and 0; it is scaled and compared with these."""

USER_Y = chosen([-1, "-0.5", "-0.4", 0, "0.4", 1])
"""The user's speed command; -0.5 is the limit of the 180° rotation, 0.4 a part of full speed."""

PHASE = integer(0, 19, "ms")
"""From the time of a stamp to the step that sees it, where that is always the same."""

PHASE_CLASS = chosen([0, 10], "ms")
"""One phase for each set that no limit divides: limits are multiples of 20 ms, so all phases but 0
pass them in one step."""

WHEEL_RPM = chosen([0, "2.4", "2.5", 60], "rpm")
"""A wheel speed: at rest means below 2.5 rpm."""

LINK_AGE = fixed(0, 140, 20, "ms")
"""Time since an update of the link or the heartbeat; 140 ms stands for all that exceeds 120 ms."""
