"""Each board in a plain scene: few runs, all of them runs of the board, in which findings are reproduced.

A chart alone may meet inputs that never meet in its board.  A violation found there counts when the
board has one, and is looked for where everything that does not matter to it stands still.
"""

from collections.abc import Callable
from dataclasses import replace

from rovercheck.spec_model.board1.systems import board1
from rovercheck.spec_model.board2.supervisor_systems import board2
from rovercheck.spec_model.environment import board2 as env2
from rovercheck.spec_model.lang.expr import Expr, all_of
from rovercheck.spec_model.lang.system import System
from rovercheck.spec_model.signals import board1 as b1
from rovercheck.spec_model.signals import board2_supervisor as b2
from rovercheck.spec_model.system_table import SystemTable


def _plain(
    board: Callable[[], System], name: str, scene: str, assume: Expr
) -> tuple[str, Callable[[], System]]:
    """A board in a scene that leaves few runs."""

    def built() -> System:
        system = board()
        return replace(
            system,
            name=name,
            text=f"{system.name} in a plain scene.",
            assume=all_of(system.assume, assume),
            notes=(*system.notes, scene),
            under=True,
        )

    return name, built


first, *others = (b1.wheel_speed_rpm[wheel] for wheel in b1.WHEELS)

board1_plain = _plain(
    board1,
    "board1_plain",
    "Temperature 25 °C, battery 80 %, encoders with feedback, four equal wheel speeds, a frame with a new "
    "heartbeat in every step; what the frames carry and how fast the wheels turn is free.",
    all_of(
        b1.temp_update,
        b1.temp_reading == 25,
        b1.batt_update,
        b1.batt_reading == 80,
        b1.rx_update,
        b1.heartbeat_update,
        b1.sent(b1.is_motion_consistent),
        *(~lost for lost in b1.has_no_feedback.values()),
        *(other == first for other in others),
    ),
)

STILL = (b1.x_norm, b1.y_norm, b1.crit_mask_b2, b1.degr_mask_b2, b1.current_yaw)

board1_buttons = _plain(
    board1,
    "board1_buttons",
    "As board1_plain with wheels at rest, where frames may be missing and carry nothing but buttons: stick "
    "at rest, CMD_NORMAL, no fault of Board 2.",
    all_of(
        b1.temp_update,
        b1.temp_reading == 25,
        b1.batt_update,
        b1.batt_reading == 80,
        b1.rx_update == b1.heartbeat_update,
        b1.sent(b1.is_motion_consistent),
        *(~lost for lost in b1.has_no_feedback.values()),
        *(speed == 0 for speed in b1.wheel_speed_rpm.values()),
        b1.sent(b1.cmd) == "CMD_NORMAL",
        *(b1.sent(field) == 0 for field in STILL),
    ),
)

first_2, *others_2 = map(env2.arriving, b2.wheel_speed_rpm.values())

board2_plain = _plain(
    board2,
    "board2_plain",
    "All sources deliver in every step, the yaw rate is 0, four equal wheel speeds; the masks of Board 1, "
    "distances, heading, stick and buttons are free.",
    all_of(
        *(source.update for source in b2.SOURCES),
        b2.sonar_update,
        env2.arriving(b2.gz_dps) == 0,
        *(other == first_2 for other in others_2),
    ),
)

SYSTEMS = SystemTable(board1_plain, board1_buttons, board2_plain)
