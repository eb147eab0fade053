"""Loops: a run that breaks a property about infinite runs, found as a lasso and replayed twice round.

A run that comes back to an earlier state can go round for ever.  The monitored system gets an input that
lets a run save its state once, before any tick.  From then on the goal waits for a tick after which
everything is again as saved, with the condition of the loop true in every tick in between.  A run for which
that condition fails ends there.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

from rovercheck.checker.results.trace import Trace
from rovercheck.checker.results.verdict import Run
from rovercheck.checker.system.slice import sliced
from rovercheck.checker.verify.runs.minimise import minimise_inputs
from rovercheck.checker.verify.runs.replay import ReplayError, followed, traced
from rovercheck.properties.reduce import Goal, Question
from rovercheck.spec_model.lang.action import Assign, If
from rovercheck.spec_model.lang.domain import Bool, boolean, integer
from rovercheck.spec_model.lang.expr import Apply, Const, Expr, Var, all_of, implies
from rovercheck.spec_model.lang.operators import Op
from rovercheck.spec_model.lang.system import Statement, TransitionSystem
from rovercheck.spec_model.lang.walk import variables

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


@dataclass(frozen=True)
class LoopQuery:
    """The question for a loop, beside the monitored system and the goal it is about."""

    question: Question
    goal: Goal
    lasso: Lasso


def loop_query(question: Question, goal: Goal) -> LoopQuery:
    """What to ask an engine about a goal that only a loop can break."""
    return LoopQuery(question, goal, lasso(question.system, goal, _deciding(question, goal)))


def _deciding(question: Question, goal: Goal) -> tuple[Var, ...]:
    """The variables that decide how the goal goes on, and which inputs are admissible."""
    system = question.system
    read = [v for v in system.variables if v.name in variables(system.assume)]
    live = sliced(system, [goal.var, *goal.recurs, *read]).variables
    names = {v.name for v in (*live, *read)}
    return tuple(v for v in system.variables if v.name in names)


def looped(asked: LoopQuery, run: Run) -> Trace:
    """The trace of a run of the lasso system that closes a loop.

    Raises ``ReplayError`` unless the same inputs take the charts round the loop once more, tick by
    tick through the same states.  The interpreter, which counts time on its own, goes along.
    """
    calm = minimise_inputs(asked.lasso.system, asked.lasso.goal, run)
    save = asked.lasso.save.name
    start = next(i for i, inputs in enumerate(calm.inputs) if inputs[save])
    inputs = tuple({n: v for n, v in tick.items() if n != save} for tick in calm.inputs)
    return repeated(asked, Run(calm.frozen, inputs), start)


def repeated(asked: LoopQuery, run: Run, start: int) -> Trace:
    """The trace of a run of the system that repeats for ever what follows tick ``start``.

    Raises ``ReplayError`` unless it does.
    """
    system, goal = asked.question.system, asked.goal
    twice = Run(run.frozen, run.inputs + run.inputs[start:])
    ticks, _ = followed(system, twice, goal.var.name)
    once = traced(system, goal, run, ticks[: len(run)])
    _check(asked, traced(system, goal, twice, ticks), start, len(run))
    return replace(once, loop=start)


def _check(asked: LoopQuery, twice: Trace, start: int, end: int) -> None:
    """Both rounds are the same, the condition of the loop is always true in them, the others recur."""
    id, goal = asked.goal.property.id, asked.goal
    at = [twice.before, *(tick.after for tick in twice.ticks)]
    for k in range(start, end + 1):
        for variable in asked.lasso.kept:
            if at[k][variable.name] != at[k + end - start][variable.name]:
                raise ReplayError(
                    f"{id}: {variable.name} differs between the two rounds of the loop after tick {k}."
                )
    loop = twice.ticks[start:end]
    if not all(tick.after[goal.var.name] for tick in loop):
        raise ReplayError(f"{id}: the loop from tick {start + 1} to {end} does not break it.")
    for recurring in goal.recurs:
        if not any(tick.after[recurring.name] for tick in loop):
            raise ReplayError(f"{id}: {recurring.doc} does not recur in the loop.")


__all__ = ["LoopQuery", "loop_query", "looped", "repeated"]
