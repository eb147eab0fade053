"""Infinite runs as finite ones: a run that comes back to an earlier state can go round for ever.

The monitored system gets an input that lets a run save its state once, before any tick.  From
then on the goal waits for a tick after which everything is again as saved, with the condition of
the loop true in every tick in between.  A run for which that condition fails ends there.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

from rovercheck.properties.reduce import Goal
from rovercheck.spec_model.lang.action import Assign, If
from rovercheck.spec_model.lang.domain import Bool, boolean, integer
from rovercheck.spec_model.lang.expr import Apply, Const, Expr, Var, all_of, implies
from rovercheck.spec_model.lang.operators import Op
from rovercheck.spec_model.lang.system import Statement, TransitionSystem

BEFORE, INSIDE, FAILED = range(3)


@dataclass(frozen=True)
class Lasso:
    """A system in which ``goal`` is 1 exactly when a loop closes that breaks the property.

    ``save`` is the input that is 1 in the first tick of the loop and in no other; ``kept`` are the variables
    that are the same before and after it.
    """

    system: TransitionSystem
    goal: Var
    save: Var
    kept: tuple[Var, ...]


def lasso(system: TransitionSystem, goal: Goal, kept: Sequence[Var]) -> Lasso:
    """The question whether some run goes round a loop that breaks the property of ``goal``.

    ``kept`` must hold every variable that decides how a run goes on, as far as the goal and the
    admissible inputs depend on it.
    """
    id = goal.property.id
    save = Var(f"{id} save", boolean, 0, "the state before this tick is saved, if none was")
    phase = Var(f"{id} phase", integer(0, FAILED), BEFORE, "before the loop, inside it, or not a loop")
    closed = Var(f"{id} loop", boolean, 0, f"a loop closes that breaks {id}")
    copies = [Var(f"{v.name} saved", v.domain, v.init, f"{v.name} where the loop starts") for v in kept]
    last, *others = goal.recurs or (goal.var,)
    seen = [Var(f"{v.name} seen", boolean, 0, f"{v.doc}, or in an earlier one of the loop") for v in others]

    # The saved state comes again at the end, where the condition of the loop is true.
    worthwhile = [v for v in kept if v.name == goal.var.name]
    start: list[Statement] = [Assign(phase, _value(phase, INSIDE))]
    start += [Assign(copy, v) for copy, v in zip(copies, kept, strict=True)]
    fail: list[Statement] = [Assign(phase, _value(phase, FAILED))]
    fail += [Assign(v, _value(v, v.init)) for v in (*copies, *seen)]
    inside = phase == INSIDE
    again = (_same(v, copy) for copy, v in zip(copies, kept, strict=True))
    step = (
        If(save, tuple(start), ()),
        *system.step,
        If(all_of(inside, ~goal.var), tuple(fail), ()),
        *(Assign(s, all_of(inside, s | v)) for s, v in zip(seen, others, strict=True)),
        Assign(closed, all_of(inside, last, *seen, *again)),
    )
    made = replace(
        system,
        inputs=(*system.inputs, save),
        variables=(*system.variables, phase, *copies, *seen, closed),
        step=step,
        assume=all_of(system.assume, phase != FAILED, implies(save, all_of(phase == BEFORE, *worthwhile))),
    )
    return Lasso(made, closed, save, tuple(kept))


def _value(variable: Var, raw: int) -> Const:
    return Const(raw, variable.sort)


def _same(left: Var, right: Var) -> Expr:
    return Apply(Op.EQ, (left, right), Bool())
