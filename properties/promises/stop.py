"""Obstacle => stop: from the sonars to the command for Board 1, and to the references of who drives."""

from rovercheck.properties.areas.composition_fine import driven_forward
from rovercheck.properties.document.distances import within
from rovercheck.properties.forms import costly, holds_after
from rovercheck.properties.promises import steered, weather
from rovercheck.properties.promises.driving import drives_1, drives_2, zero_1
from rovercheck.properties.promises.promise import Chain, Promise
from rovercheck.spec_model.lang.expr import Expr
from rovercheck.spec_model.lang.time import tick, ticks
from rovercheck.spec_model.lang.words import named
from rovercheck.spec_model.signals import board1 as b1
from rovercheck.spec_model.signals import board2 as sonar
from rovercheck.spec_model.signals import board2_supervisor as b2

COMMANDED = sonar.command == "CMD_ESTOP"
OF_BOARD_2 = named("a fault in a mask of Board 2", (b2.critical_mask != 0) | (b2.degraded_mask != 0))

NEAR = costly(holds_after(
    "P-STOP-NEAR",
    "An obstacle at 70 cm or less in two successive steps: Board 2 commands CMD_ESTOP in the second.",
    premise=within(70), for_=1 * tick, then=COMMANDED,
    covers=["B2-OBS-01", "B2-OBS-11"], on="board2_ms", from_tick=2, interpretations=["E02", "E12"],
))  # fmt: skip
DEGRADED = costly(holds_after(
    "P-STOP-DEGRADED",
    "An obstacle at 300 cm or less in two successive steps, a fault of Board 1 received in both: Board 2 "
    "commands CMD_ESTOP in the second.",
    premise=within(300) & ((b2.crit_mask_b1 != 0) | (b2.degr_mask_b1 != 0)), for_=1 * tick, then=COMMANDED,
    covers=["B2-OBS-04", "B2-OBS-22"], on="board2_ms", from_tick=2, interpretations=["E09", "E12"],
))  # fmt: skip
DEGRADED_BY_2 = costly(holds_after(
    "P-STOP-DEGRADED-BY-2",
    "An obstacle at 300 cm or less in two successive steps, a fault in a mask of Board 2 in both: Board 2 "
    "commands CMD_ESTOP in the second.",
    premise=within(300) & OF_BOARD_2, for_=1 * tick, then=COMMANDED,
    covers=["B2-OBS-04", "B2-OBS-22"], on="board2_ms", from_tick=2, interpretations=["E09", "E12"],
))  # fmt: skip
WHILE_2_DRIVES = costly(holds_after(
    "P-STOP-WHILE-2-DRIVES",
    "An obstacle at 300 cm or less while Board 2 is authorised, in three successive steps: Board 2 commands "
    "CMD_ESTOP in the last.",
    premise=within(300) & drives_2, for_=2 * ticks, then=COMMANDED,
    covers=["B2-OBS-04", "B2-OBS-22"], on="board2_ms", from_tick=2, interpretations=["E09", "E12"],
))  # fmt: skip
OBEYED = costly(holds_after(
    "P-STOP-OBEYED",
    "CMD_ESTOP received in two successive steps of actuation, stick forward, no 180° rotation: zero "
    "references in the second.",
    premise=(b1.cmd == "CMD_ESTOP") & (b1.y_norm > 0) & ~b1.is_rotating180 & drives_1, for_=1 * tick,
    then=zero_1,
    covers=["B1-EST-01", "B2-OBS-01"], on="board1_ms", from_tick=2, interpretations=["S63", "E11"],
))  # fmt: skip


def _chain(across: str, near: Expr, decided: str, contract: str, obeyed: str, under: str = "") -> Chain:
    """From an obstacle, decided by Board 2, to what Board 1 does of the command."""
    return Chain(
        across,
        stands={
            "near": near,
            "estop_decided": COMMANDED,
            "estop_received": b1.cmd == "CMD_ESTOP",
            "forward": driven_forward,
            "actuates": drives_1,
            "v_positive": b1.v_ref > 0,
            "references_nonzero": ~zero_1,
        },
        by={"SUP2.contract": decided, contract: obeyed},
        under=under,
    )


STOP = Promise(
    "STOP",
    "Obstacle: stop",
    "With an obstacle at 70 cm or less, degraded at 300 cm or less, the rover must stop immediately.",
    "§3.4, §3.4.1, §3.4.2",
    "at once",
    "commanded in the second step; obeyed by Board 1 one step after it has the command, stick forward; "
    "with the stick forward and no half turn the motors stand 80 ms after the step that sees the obstacle, "
    "500 ms with a second fault; a rover that turns does not stop, and each push of the stick is a step at "
    "full speed",
    (
        "PB2-01", "PB2-12", "PB2-13a-0", "PB1-23f", DEGRADED_BY_2.id, "PSY-10a", "PSY-11",
        *(prop.id for prop in (steered.NEAR, steered.PUSHED, steered.CALM)),
    ),
    (
        NEAR, DEGRADED, WHILE_2_DRIVES, OBEYED, weather.NEAR, weather.NEAR_2, steered.NEAR_LINK21,
        steered.FORWARD,
    ),
    (
        _chain("PSY-10e", within(70), NEAR.id, "SUP1.contract", "PSY-10m"),
        _chain("PSY-10o", within(70), NEAR.id, "SUP1.obeys", OBEYED.id),
        _chain("PSY-10u", within(70), NEAR.id, "SUP1.stops", "PB1-23f", "stop-unconditional"),
        _chain(
            "PSY-10d",
            within(300) & OF_BOARD_2,
            DEGRADED_BY_2.id,
            "SUP1.obeys",
            OBEYED.id,
            "degraded-by-either",
        ),
    ),
)  # fmt: skip
