"""Faults put by hand into the reference charts of both boards; each changes the verdict of a property."""

from collections.abc import Callable
from dataclasses import replace

from benchmarks.faults.edits import ChartEdit
from rovercheck.spec_model.lang.action import Action
from rovercheck.spec_model.lang.edit import (
    constant,
    drop,
    edit_state,
    edit_transition,
    entry,
    guard,
    in_expressions,
    operator,
    swap,
    timer,
)
from rovercheck.spec_model.lang.expr import Apply, Expr, all_of
from rovercheck.spec_model.lang.operators import Op
from rovercheck.spec_model.lang.time import sec
from tests.chart_faults.faults import ChartFaults, in_charts


def _without(position: int) -> Callable[[Expr], Expr]:
    """A conjunction without one of its parts, counted from 0."""

    def change(expr: Expr) -> Expr:
        assert isinstance(expr, Apply) and expr.op is Op.AND
        return all_of(*(part for i, part in enumerate(expr.args) if i != position))

    return change


def _no_exit(name: str) -> ChartEdit:
    return lambda c: edit_state(c, name, lambda s: replace(s, exit=()))


def _no_turning_stop(actions: tuple[Action, ...]) -> tuple[Action, ...]:
    """The entry of the brake without ``omega_ref := 0``."""
    return (*actions[:2], *actions[3:])


def _toggle(board: int, too_long: str) -> list[tuple[str, str, ChartEdit]]:
    reach = f"REACH{board}-COMBO"
    return [
        ("1 s becomes 1.02 s", too_long, lambda c: guard(c, "Step3", 2, timer(1.02 * sec))),
        ("the stick does not end it", f"{reach}-TOUCHED", lambda c: drop(c, "Combo_toggle_backward", 1)),
        (
            "nothing is toggled",
            f"{reach}-ON",
            lambda c: edit_transition(c, "Step4", 1, lambda t: replace(t, do=())),
        ),
        ("no limit for the last press", f"{reach}-LATE-4", lambda c: drop(c, "Step4", 2)),
    ]


CHARTS: dict[str, list[tuple[str, str, ChartEdit]]] = {
    "Backward_mode_toggle": [
        *_toggle(1, "PB1-27f"),
        ("too late for a press only", "PB1-27e",
         lambda c: edit_transition(c, "Step4", 2, lambda t: replace(t, target="Step3"))),
        ("the stick does not end it", "PB1-27h", lambda c: drop(c, "Combo_toggle_backward", 1)),
    ],
    "Backward_mode_toggle_2": _toggle(2, "PB2-16k"),
    "Motion_Supervision": [
        ("7.5 becomes 10", "PB1-26g", lambda c: in_expressions(c, constant(7.5, 10))),
        ("45 becomes 30", "PB1-26e", lambda c: in_expressions(c, constant(45, 30))),
        ("the flag outlives the rotation", "PB1-26h", _no_exit("Retromarcia_180")),
        ("a rotation in backward mode too", "PB1-26i", lambda c: guard(c, "Normale_marcia", 5, _without(1))),
        ("the junction tested the other way round", "REACH1-ROTATED-INVERTED", lambda c: swap(c, "turned")),
        ("a released stop without rest", "PB1-24a",
         lambda c: guard(c, "Procedura_emergency_stop", 1, operator(Op.AND, Op.OR))),
    ],
    "Motion_Supervision_2": [
        ("full speed", "PB2-16a", lambda c: in_expressions(c, constant(0.5, 1))),
        ("2 s become 2.02 s", "PB2-16i", lambda c: guard(c, "In_frenata_di_emergenza", 1, timer(2.02 * sec))),
        ("turning kept in the brake", "PB2-16c",
         lambda c: entry(c, "In_frenata_di_emergenza", _no_turning_stop)),
        ("a released stop without rest", "PB2-16h",
         lambda c: guard(c, "Procedura_emergency_stop", 1, operator(Op.AND, Op.OR))),
        ("an obstacle and a critical cause", "PB2-18a",
         lambda c: guard(c, "Stato_marcia_rover", 1, operator(Op.OR, Op.AND))),
    ],
}  # fmt: skip

FAULTS = in_charts(CHARTS)


class TestMotion(ChartFaults):
    FAULTS = FAULTS
