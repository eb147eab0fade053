"""Which obstacle chart decides, and the decision as a command for Board 1 [spec Figs 12, 24, 28]."""

from rovercheck.spec_model.lang.action import assign
from rovercheck.spec_model.lang.chart import Block, Chart, Component
from rovercheck.spec_model.lang.expr import Expr, any_of, ite, member
from rovercheck.spec_model.signals.board2 import (
    DEG_B1,
    MEANING,
    B2Dec,
    B2DecDegraded,
    B2Decision,
    command,
    prevDEG_B1,
)
from rovercheck.spec_model.signals.common import COMMAND


def selection(
    normal: Chart, degraded: Chart, *, deg_mask_b1: Expr, crit_mask_b1: Expr, autorized: Expr
) -> tuple[Component, ...]:
    """Both charts, executed in every step (E32), between the blocks that select and translate.

    ``deg_mask_b1`` and ``crit_mask_b1``: the mask last received from Board 1 is not zero;
    ``autorized``: Board 2 was authorised to move the rover at the end of the step before (E09).
    """
    select = Block("SelectState", [
        assign(prevDEG_B1, DEG_B1),
        assign(DEG_B1, any_of(deg_mask_b1, crit_mask_b1, autorized)),
    ], text="Degraded as far as obstacles go: a fault on Board 1, or Board 2 drives")  # fmt: skip
    translate = Block("TranslateDecision", [
        assign(B2Dec, ite(DEG_B1, B2DecDegraded, B2Decision)),
        assign(command, by_meaning),
    ], text="Decision 0..6 to a command of Board 1 [spec Fig 12]")  # fmt: skip
    return (select, normal, degraded, translate)


def _by_meaning() -> Expr:
    """What each decision stands for (E04); "move toward sonar 2" is CMD_NORMAL (E31)."""
    found: Expr = member(COMMAND, "CMD_NORMAL")
    for number, name in enumerate(MEANING):
        if name != "CMD_NORMAL":
            found = ite(B2Dec == number, member(COMMAND, name), found)
    return found


by_meaning = _by_meaning()
