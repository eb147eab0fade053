"""Forty faults put in by hand: a chart is varied, and the unchanged supervisor must be found to differ.

What a chart cannot express, such as a buffer that two monitors share, is put into the supervisor instead.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

from benchmarks.faults.edits import BlockEdit, ChartEdit, PartEdit, no_entry, no_exit, of_block, of_chart
from benchmarks.faults.inside import IMPLEMENTATIONS
from rovercheck.checker.adapters.python_calls import Instance
from rovercheck.spec_model.abstraction import Board, boards
from rovercheck.spec_model.lang.action import assign
from rovercheck.spec_model.lang.chart import Block
from rovercheck.spec_model.lang.edit import (
    constant,
    drop,
    edit_transition,
    everywhere,
    guard,
    in_block,
    in_expressions,
    in_system,
    operator,
    swap,
    timer,
)
from rovercheck.spec_model.lang.expr import Expr, Var
from rovercheck.spec_model.lang.operators import Op
from rovercheck.spec_model.lang.time import sec
from rovercheck.spec_model.signals import board1 as b1
from rovercheck.spec_model.signals import board2_motion as motion
from rovercheck.spec_model.signals import board2_supervisor as b2
from rovercheck.spec_model.signals.board2 import objDetected


@dataclass(frozen=True)
class Fault:
    """One fault: its kind, the board and the part that has it, and what is wrong.

    Exactly one of ``edit``, for the chart or block, and ``make``, for the supervisor, is there.
    """

    kind: str
    board: str
    part: str
    text: str
    edit: PartEdit | None = None
    make: Callable[[], Instance] | None = None

    def __str__(self) -> str:
        return f"{self.kind}, {self.board}, {self.part}: {self.text}"

    def varied(self) -> Board:
        """The board whose charts have the fault, or the board as it is if the supervisor has it."""
        board = boards()[self.board]
        if self.edit is None:
            return board
        return replace(board, system=in_system(board.system, self.part, self.edit))


# --- edits ------------------------------------------------------------------------------------------


def _exchanged(one: Var, other: Var) -> Callable[[Expr], Expr]:
    swapped = {one.name: other, other.name: one}

    def change(node: Expr) -> Expr:
        return swapped.get(node.name, node) if isinstance(node, Var) else node

    return lambda expr: everywhere(expr, change)


def _without(position: int) -> BlockEdit:
    return lambda block: Block(block.name, (*block.do[:position], *block.do[position + 1 :]), text=block.text)


# --- the faults ---------------------------------------------------------------------------------------

RUNNING, BRAKE = "Stato_marcia_rover", "In_frenata_di_emergenza"
Row = tuple[str, str, str, ChartEdit]
CHARTS: dict[str, Sequence[Row]] = {
    "boundary": [
        ("board1", "Monitor_battery", "< 23 becomes <= 23",
         lambda c: guard(c, "decide", 2, operator(Op.LT, Op.LE))),
        ("board1", "Monitor_temperature", "60 becomes 61", lambda c: in_expressions(c, constant(60, 61))),
        ("board1", "Monitor_reception", "> 120 becomes >= 120",
         lambda c: guard(c, "decide", 1, operator(Op.GT, Op.GE))),
        ("board1", "Motion_Supervision", "a half turn ends at 10 degrees",
         lambda c: in_expressions(c, constant(7.5, 10))),
        ("board2", "Obstacles", "70 becomes 71", lambda c: in_expressions(c, constant(70, 71))),
        ("board2", "ObstaclesDriving", "<= 300 becomes < 300",
         lambda c: in_expressions(c, operator(Op.LE, Op.LT))),
        ("board2", "Motion_Supervision_2", "< -0.5 becomes <= -0.5",
         lambda c: guard(c, f"{RUNNING}.Normale_marcia", 1, operator(Op.LT, Op.LE))),
    ],
    "timer": [
        ("board1", "Monitor_temperature", "4 s become 4.02 s",
         lambda c: guard(c, "decide", 1, timer(4.02 * sec))),
        ("board1", "Relay", "> 3 s becomes >= 3 s",
         lambda c: guard(c, "B2_actuating", 1, timer(strict=False))),
        ("board1", "Backward_mode_toggle", "1 s becomes 1.02 s",
         lambda c: guard(c, "Step3", 2, timer(1.02 * sec))),
        ("board2", "Monitors_2", "2 s become 1.98 s",
         lambda c: guard(c, "Board1Supervisor.CRIT", 1, timer(1.98 * sec))),
        ("board2", "Obstacles", "0.5 s become 0.48 s", lambda c: guard(c, "MoveToS2", 2, timer(0.48 * sec))),
        ("board2", "Motion_Supervision_2", "2 s become 2.02 s",
         lambda c: guard(c, BRAKE, 1, timer(2.02 * sec))),
    ],
    "priority": [
        ("board1", "Monitor_battery", "degraded before critical", lambda c: swap(c, "decide")),
        ("board1", "Safety_state", "degraded before critical", lambda c: swap(c, "Rover_Safe_State")),
        ("board1", "Motion_Supervision", "the end of a half turn the other way round",
         lambda c: swap(c, "turned")),
        ("board2", "Obstacles", "confirmation before the end of the window",
         lambda c: swap(c, "timerSonar12.Fall1Detected")),
        ("board2", "Monitors_2", "silence before recovery of the joystick", lambda c: swap(c, "BLE.DEG")),
    ],
    "latch": [
        ("board1", "Monitor_battery", "critical is never left", lambda c: drop(c, "Batt_CRIT", 1)),
        ("board2", "Safety_state_2", "critical is never left", lambda c: drop(c, "Rover_Critical_State", 1)),
        ("board2", "Backward_mode_toggle_2", "backward mode cannot be switched off",
         lambda c: edit_transition(c, "Step4", 1,
                                   lambda t: replace(t, do=(assign(motion.backward_enabled, True),)))),
    ],
    "reset": [
        ("board1", "Motion_Supervision", "the inversion outlives an emergency stop", no_exit(RUNNING)),
        ("board1", "Motion_Supervision", "the recovery of the last stop counts again",
         lambda c: edit_transition(c, RUNNING, 1, lambda t: replace(t, do=()))),
        ("board2", "Motion_Supervision_2", "turning kept in the brake", no_entry(BRAKE, 2)),
    ],
    "missing return": [
        ("board1", "Motion_Supervision", "an avoidance does not end", lambda c: drop(c, "Evita_destra", 1)),
        ("board2", "Backward_mode_toggle_2", "the stick does not end the combination",
         lambda c: drop(c, "Combo_toggle_backward", 1)),
        ("board2", "Monitors_2", "no way back from a degraded IMU", lambda c: drop(c, "IMU.DEG", 1)),
    ],
    "swapped signals": [
        ("board1", "Backward_mode_toggle", "the two buttons",
         lambda c: in_expressions(c, _exchanged(b1.btn1, b1.btn2))),
        ("board2", "Obstacles", "the neighbours of the centre sonar",
         lambda c: in_expressions(c, _exchanged(objDetected[0], objDetected[2]))),
    ],
}  # fmt: skip

BLOCKS: dict[str, Sequence[tuple[str, str, str, BlockEdit]]] = {
    "swapped signals": [
        ("board1", "Fault_masks", "front left and front right wheel",
         lambda b: in_block(b, _exchanged(b1.wheel_status["FL"], b1.wheel_status["FR"]))),
        ("board1", "Process_B2_masks", "the two masks of Board 2",
         lambda b: in_block(b, _exchanged(b1.crit_mask_b2, b1.degr_mask_b2))),
        ("board2", "Actuation", "each side is ramped from the other",
         lambda b: in_block(b, _exchanged(b2.left_rpm, b2.right_rpm))),
    ],
    "reset": [
        ("board2", "Actuation", "the ramp goes on after a pause", _without(0)),
        ("board2", "Coherence.clear", "a long window begins with the rotation of the last one", _without(1)),
    ],
}  # fmt: skip


def faults() -> list[Fault]:
    """All faults, by kind."""
    charts = [Fault(kind, *row[:3], edit=of_chart(row[3])) for kind, rows in CHARTS.items() for row in rows]
    blocks = [Fault(kind, *row[:3], edit=of_block(row[3])) for kind, rows in BLOCKS.items() for row in rows]
    inside = [Fault(*about, make=make) for about, make in IMPLEMENTATIONS.items()]
    return charts + blocks + inside
