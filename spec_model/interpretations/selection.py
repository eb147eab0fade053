"""Which obstacle chart decides, and the command, under other interpretations (E04, E05, E09, E31, E32)."""

from collections.abc import Callable

from rovercheck.spec_model.interpretations import Alternative, Change, alternative
from rovercheck.spec_model.interpretations.obstacles import moved_left
from rovercheck.spec_model.lang.action import assign
from rovercheck.spec_model.lang.change import assigned
from rovercheck.spec_model.lang.chart import Block, Chart, Enabled
from rovercheck.spec_model.lang.expr import Expr, any_of, ite, member
from rovercheck.spec_model.lang.system import System
from rovercheck.spec_model.signals import board2_supervisor as b2
from rovercheck.spec_model.signals.board2 import (
    DEG_B1,
    B2Dec,
    autorized_prev,
    command,
    own_crit_mask,
    own_deg_mask,
    x_sent,
)
from rovercheck.spec_model.signals.board2_motion import bx_norm
from rovercheck.spec_model.signals.common import COMMAND

SELECT, TRANSLATE = "SelectState", "TranslateDecision"


def selects(system: System) -> bool:
    """Both obstacle charts are there, and one of them is selected."""
    return any(block.name == SELECT for block in system.blocks)


def of_a_board(system: System) -> bool:
    """The authorisation is that of the board; else it is free, as are the masks."""
    return not of_free_masks(system)


def of_free_masks(system: System) -> bool:
    return any(block.name == SELECT and autorized_prev.name in block.read for block in system.blocks)


def by_number() -> Expr:
    """The decision is the number of the command."""
    found: Expr = member(COMMAND, "CMD_NORMAL")
    for number in range(1, 8):
        found = ite(B2Dec == number, member(COMMAND, COMMAND.show(number)), found)
    return found


avoid = ite(moved_left, member(COMMAND, "CMD_AVOID_LEFT"), member(COMMAND, "CMD_AVOID_RIGHT"))
avoiding = assigned(command, lambda drawn: ite(B2Dec == 3, avoid, drawn))
numbered = assigned(command, lambda _: by_number())


def straight(block: Block) -> Block:
    turn = assign(x_sent, ite(B2Dec == 3, 0, bx_norm))
    return Block(block.name, [*block.do, turn], text=block.text, place=block.place)


def only_while(condition: Expr) -> Change:
    def change(chart: Chart) -> Enabled:
        return Enabled(condition, chart)

    return change


def degraded_by(
    autorized: Expr, degraded: Expr, critical: Expr, among: Callable[[System], bool]
) -> tuple[Alternative, ...]:
    """Who says that the degraded chart decides, given what Board 2 knows of itself."""
    return (
        alternative("E09", "SEL-ACTUATOR", "While Board 2 drives.", SELECT,
            assigned(DEG_B1, lambda _: autorized), among=among),
        alternative("E09", "SEL-SAFETY", "With a fault of either board too.", SELECT,
            assigned(DEG_B1, lambda drawn: any_of(drawn, degraded, critical)), among=among),
        alternative("E09", "SEL-MASK", "With a degraded source of Board 2.", SELECT,
            assigned(DEG_B1, lambda _: degraded), among=among),
    )  # fmt: skip


ALTERNATIVES = (
    *degraded_by(autorized_prev, own_deg_mask, own_crit_mask, of_free_masks),
    *degraded_by(b2.autorized_to_send_command, b2.degraded_mask != 0, b2.critical_mask != 0, of_a_board),
    alternative("E05", "CENTRE-HOLD", "The turn toward the side of the object is inhibited.", TRANSLATE,
        avoiding),
    alternative("E31", "AVOID-BY-PAIR", "The turn toward the side of the object is inhibited.", TRANSLATE,
        avoiding),
    alternative("E04", "INDEX5-RAW", "The decision is the number of the command.", TRANSLATE, numbered),
    alternative("E04", "ENUM8", "The charts write commands.", TRANSLATE, numbered),
    alternative("E31", "ZERO-TURN", "The turn is 0 toward sonar 2.", TRANSLATE, straight),
    alternative("E32", "FREEZE", "Only the selected chart is executed.", "Obstacles",
        only_while(~DEG_B1), among=selects),
    alternative("E32", "FREEZE", "Only the selected chart is executed.", "ObstaclesDegraded",
        only_while(DEG_B1), among=selects),
)  # fmt: skip
