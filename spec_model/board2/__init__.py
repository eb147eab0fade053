"""The supervisor of Board 2: its charts and function blocks in execution order [spec §3.1].

Obstacle decision, monitors, masks, classes, authorisation; then, if Board 2 is authorised, safety state,
obstacle command and references; at last the coherence of IMU and odometry.  A block sees in the same
step what the blocks before it produced, and the decision the authorisation of the step before.
"""

from collections.abc import Sequence

from rovercheck.spec_model.board2.actuation import actuation
from rovercheck.spec_model.board2.backward import toggle_2
from rovercheck.spec_model.board2.classify import process_masks
from rovercheck.spec_model.board2.coherence import COHERENCE
from rovercheck.spec_model.board2.failure_check import check_board1
from rovercheck.spec_model.board2.heading import FREE, Heading
from rovercheck.spec_model.board2.masks import fault_masks_2
from rovercheck.spec_model.board2.monitors import monitors
from rovercheck.spec_model.board2.motion import check_stop_2, motion_supervision_2
from rovercheck.spec_model.board2.obstacle_command import obstacle_command, obstacles_driving
from rovercheck.spec_model.board2.obstacles import obstacles_n
from rovercheck.spec_model.board2.obstacles_degraded import obstacles_degraded
from rovercheck.spec_model.board2.safety import safety_state_2
from rovercheck.spec_model.board2.selection import selection
from rovercheck.spec_model.board2.slow2 import Record, exact
from rovercheck.spec_model.lang.chart import Component, Enabled
from rovercheck.spec_model.signals.board2_supervisor import (
    SOURCES,
    SourceSignals,
    autorized_to_send_command,
    crit_mask_b1,
    degr_mask_b1,
)


def obstacle_decision(heading: Heading = FREE) -> tuple[Component, ...]:
    """F-SEL2: both obstacle charts, executed in every step, and the selection between them."""
    return selection(
        obstacles_n(heading),
        obstacles_degraded(),
        deg_mask_b1=degr_mask_b1 != 0,
        crit_mask_b1=crit_mask_b1 != 0,
        autorized=autorized_to_send_command,
    )


DRIVING = Enabled(
    autorized_to_send_command,
    safety_state_2,
    obstacles_driving,
    obstacle_command,
    toggle_2,
    motion_supervision_2,
)
"""Actuation decision and motion state, executed only while Board 2 is authorised."""


def supervisor(
    record: Record = exact, heading: Heading = FREE, sources: Sequence[SourceSignals] = SOURCES
) -> tuple[Component, ...]:
    """The whole supervisor of Board 2, exact or with over-approximated records and heading."""
    notes, monitor_sources = monitors(record, sources)
    return (
        check_stop_2,  # read by the motion chart, and by the obstacle chart under E10 LATCH-STANDSTILL
        *obstacle_decision(heading),
        *notes,
        monitor_sources,
        fault_masks_2,
        process_masks,
        check_board1,
        DRIVING,
        *COHERENCE,
    )


SUPERVISOR: tuple[Component, ...] = supervisor()
"""The whole supervisor of Board 2, as drawn."""

ACTUATION = actuation
"""The motor commands, in the activation of the supervisor after all its blocks."""
