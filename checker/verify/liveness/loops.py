"""Loops: a run that breaks a property about infinite runs, found as a lasso and replayed twice round."""

from dataclasses import dataclass, replace

from rovercheck.checker.results.trace import Trace
from rovercheck.checker.results.verdict import Run
from rovercheck.checker.system.slice import sliced
from rovercheck.checker.verify.liveness.lasso import Lasso, lasso
from rovercheck.checker.verify.runs.minimise import minimise_inputs
from rovercheck.checker.verify.runs.replay import ReplayError, replay
from rovercheck.properties.reduce import Goal, Question
from rovercheck.spec_model.lang.expr import Var
from rovercheck.spec_model.lang.walk import variables


@dataclass(frozen=True)
class LoopHunt:
    """The question for a loop, beside the monitored system and the goal it is about."""

    question: Question
    goal: Goal
    lasso: Lasso


def hunt(question: Question, goal: Goal) -> LoopHunt:
    """What to ask an engine about a goal that only a loop can break."""
    return LoopHunt(question, goal, lasso(question.system, goal, _deciding(question, goal)))


def _deciding(question: Question, goal: Goal) -> tuple[Var, ...]:
    """The variables that decide how the goal goes on, and which inputs are admissible."""
    system = question.system
    read = [v for v in system.variables if v.name in variables(system.assume)]
    live = sliced(system, [goal.var, *goal.recurs, *read]).variables
    names = {v.name for v in (*live, *read)}
    return tuple(v for v in system.variables if v.name in names)


def looped(hunt: LoopHunt, run: Run) -> Trace:
    """The trace of a run of the lasso system that closes a loop.

    Raises ``ReplayError`` unless the same inputs take the charts round the loop once more, tick by
    tick through the same states.  The interpreter, which counts time on its own, goes along.
    """
    calm = minimise_inputs(hunt.lasso.system, hunt.lasso.goal, run)
    save = hunt.lasso.save.name
    start = next(i for i, inputs in enumerate(calm.inputs) if inputs[save])
    inputs = tuple({n: v for n, v in tick.items() if n != save} for tick in calm.inputs)
    return repeated(hunt, Run(calm.frozen, inputs), start)


def repeated(hunt: LoopHunt, run: Run, start: int) -> Trace:
    """The trace of a run of the system that repeats for ever what follows tick ``start``.

    Raises ``ReplayError`` unless it does.
    """
    once = replay(hunt.question.system, hunt.goal, run)
    twice = replay(hunt.question.system, hunt.goal, Run(run.frozen, run.inputs + run.inputs[start:]))
    _check(hunt, twice, start, len(run))
    return replace(once, loop=start)


def _check(hunt: LoopHunt, twice: Trace, start: int, end: int) -> None:
    """Both rounds are the same, the condition of the loop is always true in them, the others recur."""
    id, goal = hunt.goal.property.id, hunt.goal
    at = [twice.before, *(tick.after for tick in twice.ticks)]
    for k in range(start, end + 1):
        for variable in hunt.lasso.kept:
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


__all__ = ["LoopHunt", "hunt", "looped", "repeated"]
