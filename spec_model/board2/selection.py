"""Which obstacle chart decides, and the decision as a command for Board 1 [seed Figs 12, 24, 28]."""

from rovercheck.spec_model.board2.obstacle_readings import moved_left
from rovercheck.spec_model.lang.action import assign, when
from rovercheck.spec_model.lang.chart import Block, Chart, Component, Enabled
from rovercheck.spec_model.lang.expr import TRUE, Expr, any_of, ite, member
from rovercheck.spec_model.readings import choose, under
from rovercheck.spec_model.signals.board2 import (
    DEG_B1,
    MEANING,
    B2Dec,
    B2DecDegraded,
    B2Decision,
    command,
    prevDEG_B1,
    x_sent,
)
from rovercheck.spec_model.signals.board2_motion import bx_norm
from rovercheck.spec_model.signals.common import COMMAND


def selection(
    normal: Chart,
    degraded: Chart,
    *,
    deg_mask_b1: Expr,
    crit_mask_b1: Expr,
    autorized: Expr,
    deg_mask_b2: Expr,
    crit_mask_b2: Expr,
) -> tuple[Component, ...]:
    """Both charts, executed in every step (E32), between the blocks that select and translate.

    ``deg_mask_b1`` and ``crit_mask_b1``: the mask last received from Board 1 is not zero;
    ``autorized``: Board 2 was authorised to move the rover at the end of the step before (E09);
    ``deg_mask_b2`` and ``crit_mask_b2``: its own mask was not zero then.
    """
    board1 = any_of(deg_mask_b1, crit_mask_b1, autorized)
    select = Block("SelectState", [
        assign(prevDEG_B1, DEG_B1),
        assign(DEG_B1, choose("E09", {
            "SEL-B1FLAG": board1,
            "SEL-ACTUATOR": autorized,
            "SEL-SAFETY": any_of(board1, deg_mask_b2, crit_mask_b2),
            "SEL-MASK": deg_mask_b2,
        })),
    ], text="Degraded as far as obstacles go: a fault on Board 1, or Board 2 drives")  # fmt: skip
    translate = Block("TranslateDecision", [
        assign(B2Dec, ite(DEG_B1, B2DecDegraded, B2Decision)),
        assign(command, _command()),
        when(under("E31", "ZERO-TURN"), [assign(x_sent, ite(B2Dec == 3, 0, bx_norm))]),
    ], text="Decision 0..6 to a command of Board 1 [seed Fig 12]")  # fmt: skip
    runs = choose("E32", {"RUN-ALWAYS": TRUE, "FREEZE": ~DEG_B1})
    runs_degraded = choose("E32", {"RUN-ALWAYS": TRUE, "FREEZE": DEG_B1})
    return (select, Enabled(runs, normal), Enabled(runs_degraded, degraded), translate)


def _command() -> Expr:
    """By meaning, or the number as it is (E04); "move toward sonar 2" is CMD_NORMAL (E31).

    CENTRE-HOLD and AVOID-BY-PAIR inhibit the turn toward the side to which the object went (E05, E31).
    """
    by_number: Expr = member(COMMAND, "CMD_NORMAL")
    for number in range(1, 8):
        by_number = ite(B2Dec == number, member(COMMAND, COMMAND.show(number)), by_number)
    by_meaning: Expr = member(COMMAND, "CMD_NORMAL")
    for number, name in enumerate(MEANING):
        if name != "CMD_NORMAL":
            by_meaning = ite(B2Dec == number, member(COMMAND, name), by_meaning)
    inhibits = under("E05", "CENTRE-HOLD") | under("E31", "AVOID-BY-PAIR")
    avoid = ite(moved_left, member(COMMAND, "CMD_AVOID_LEFT"), member(COMMAND, "CMD_AVOID_RIGHT"))
    return choose("E04", {
        "INDEX5-MAPPED": ite(inhibits & (B2Dec == 3), avoid, by_meaning),
        "INDEX5-RAW": by_number,
        "ENUM8": by_number,
    })  # fmt: skip
