"""Counters of a step: variables that a tick moves on by a constant, such as timers and ages.

They are found by the shape of their assignments, ``c := min(c + k, top)`` under any conditions.  Nothing
rests on finding all of them, or only them: they say which successor of a state is *expected*, the
one in which every running counter has moved on and nothing else has changed (see ``quiet``).
"""

from collections.abc import Iterator
from dataclasses import dataclass

from rovercheck.spec_model.lang.action import Assign, each_action
from rovercheck.spec_model.lang.expr import Apply, Const, Expr, Named, Var
from rovercheck.spec_model.lang.operators import Op
from rovercheck.spec_model.lang.system import TransitionSystem


@dataclass(frozen=True)
class Counter:
    """A variable and the raw steps by which ticks move it on, up or down.

    It runs while it is neither at its lowest value nor at the end it moves to.
    """

    var: Var
    by: int


def counters(system: TransitionSystem) -> tuple[Counter, ...]:
    """The variables of the state that count in steps of one length."""
    steps: dict[str, set[int]] = {v.name: set() for v in system.variables}
    for action in each_action(system.step):
        if isinstance(action, Assign) and action.var.name in steps:
            steps[action.var.name] |= set(_steps(action.var.name, action.value))
    return tuple(Counter(v, *steps[v.name]) for v in system.variables if len(steps[v.name]) == 1)


def _steps(name: str, expr: Expr) -> Iterator[int]:
    """What the expression may add to the variable."""
    match expr:
        case Named(_, body):
            yield from _steps(name, body)
        case Apply(Op.ITE | Op.MIN | Op.MAX, args, _):
            for arg in args:
                yield from _steps(name, arg)
        case Apply(Op.ADD, (Var(own), Const(by)) | (Const(by), Var(own)), _) if own == name and by:
            yield by
        case Apply(Op.SUB, (Var(own), Const(by)), _) if own == name and by:
            yield -by


__all__ = ["Counter", "counters"]
