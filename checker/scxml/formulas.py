"""Expressions of a machine as formulas."""

from rovercheck.checker.drawn.lower.program import ProgramWriter
from rovercheck.checker.scxml.records import (
    Constant,
    DatumName,
    EventDatum,
    FreeGuard,
    InState,
    MachineState,
    Operation,
    ScxmlExpression,
    StateMachine,
)
from rovercheck.checker.scxml.view import MachineView
from rovercheck.spec_model.lang.domain import boolean, integer
from rovercheck.spec_model.lang.expr import Const, Expr, Var, const, ite
from rovercheck.spec_model.lang.words import absolute, maximum, minimum, modulo, quotient


class FormulaWriter:
    """What a machine reads: which states are active within a step, data, and what is delayed."""

    def __init__(
        self, machine: StateMachine, view: MachineView, data: dict[str, Var], writer: ProgramWriter
    ) -> None:
        self.machine, self.view, self.data, self.writer = machine, view, data, writer
        self.guards = {
            one: Var(f"guard.{one}", boolean, 0, f"whether the guard {one} holds in a step")
            for one in machine.guards
        }
        self.ran = {
            one: Var(f"action.{one}", boolean, 0, f"whether the action {one} ran in the last step")
            for one in machine.actions
        }
        self.active: dict[MachineState, Var] = {
            one: writer.temporary(f"in {one.id} ", boolean) for one in machine.states if one.kind != "history"
        }
        self.timers = {
            one.number: Var(
                f"{machine.name}.delay {one.event} {one.number}", integer(0, one.delay // machine.tick), 0,
                f"steps until {one.event} of line {one.line}, 0 if it was not sent",
            )
            for one in machine.sends if one.delay
        }  # fmt: skip

    def formula(self, one: ScxmlExpression) -> Expr:
        """An expression at this point of the step."""
        match one:
            case Constant(value):
                return const(value)
            case DatumName(name):
                return self.data[name]
            case EventDatum(name):
                return self.view.carried[name]
            case InState(id):
                return self.active[self.machine.named[id]]
            case FreeGuard(name):
                return self.guards[name]
            case Operation(operator, operands):
                return _applied(operator, [self.formula(inner) for inner in operands])


def _applied(operator: str, of: list[Expr]) -> Expr:
    match operator:
        case "!":
            return ~of[0]
        case "neg":
            return -of[0]
        case "?":
            return ite(of[0], of[1], of[2])
        case "&&":
            return of[0] & of[1]
        case "||":
            return of[0] | of[1]
        case "%" | "floor":
            return _divided(operator, *of)
        case "abs":
            return absolute(of[0])
        case "max":
            return maximum(of[0], of[1])
        case "min":
            return minimum(of[0], of[1])
        case "+":
            return of[0] + of[1]
        case "-":
            return of[0] - of[1]
        case "*":
            return of[0] * of[1]
        case "==":
            return of[0] == of[1]
        case "!=":
            return of[0] != of[1]
        case "<":
            return of[0] < of[1]
        case "<=":
            return of[0] <= of[1]
        case ">":
            return of[0] > of[1]
    return of[0] >= of[1]


def _divided(operator: str, number: Expr, by: Expr) -> Expr:
    """A quotient rounded down; a remainder has the sign of what is divided."""
    assert isinstance(by, Const)
    if operator == "floor":
        return quotient(number, by.value)
    return ite(number < 0, -modulo(-number, by.value), modulo(number, by.value))


__all__ = ["FormulaWriter"]
