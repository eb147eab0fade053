"""Properties decided on the system whose timers run out at will, as far as that goes (docs/timers.md)."""

from collections.abc import Callable, Sequence
from dataclasses import replace

from checker.results.verdict import Reached, Unreachable
from checker.system.lowered import lowered
from checker.verify.portfolio import PortfolioQuestion
from checker.verify.portfolio.shape import shape
from checker.verify.result import Answers, Result, result
from checker.verify.runs.reproduce import moved
from properties.forms import Property
from properties.reduce import reduce
from spec_model.lang.expiry import free_timers
from spec_model.lang.expr import Var
from spec_model.lang.system import System, TransitionSystem

Ask = Callable[[TransitionSystem, Sequence[Var]], Answers]
"""An answer for each goal, and for each check of the system."""


def freely(system: System, properties: Sequence[Property], ask: Ask) -> tuple[list[Result], list[Property]]:
    """Results that hold for ``system``, and the properties that are left for an exact search.

    What is unreachable with free timers is unreachable.  A run with free timers counts if the system
    itself reaches the goal with the same inputs; as no run of it is shorter, that one is a shortest.
    """
    loose = free_timers(system)
    if loose is system:
        return [], list(properties)
    here = reduce(lowered(system), properties)
    if shape(PortfolioQuestion(here.system, tuple(g.var for g in here.goals))).kind == "driven":
        return [], list(properties)  # free timers would be most of what is free
    there = reduce(lowered(loose), [replace(p, on=loose.name) for p in properties])
    found = ask(there.system, [g.var for g in there.goals])
    if not all(isinstance(found[check.name][0], Unreachable) for check, _ in there.system.checks):
        return [], list(properties)  # a value may leave its domain only because a timer ends early
    done: list[Result] = []
    left: list[Property] = []
    for goal, same in zip(there.goals, here.goals, strict=True):
        answer, by = found[goal.var.name]
        run = None
        if isinstance(answer, Reached) and not system.over:
            run = moved(there, goal, answer, here, same)
        if isinstance(answer, Unreachable):
            done.append(replace(result(there.system, goal, answer, by), property=same.property))
        elif run is not None:
            done.append(result(here.system, same, run, by))
        else:
            left.append(same.property)
    return done, left
