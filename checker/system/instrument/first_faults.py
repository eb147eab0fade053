"""Values outside their domains, and steps without a meaning, as goals: what a run of a system meets first."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

from rovercheck.spec_model.lang.action import Action, Assign, If
from rovercheck.spec_model.lang.domain import boolean
from rovercheck.spec_model.lang.expr import TRUE, Var
from rovercheck.spec_model.lang.lower.ranges import checked
from rovercheck.spec_model.lang.programmed import is_fault
from rovercheck.spec_model.lang.system import Statement, TransitionSystem

ENDED = Var("goal ended", boolean, 0, hidden=True)
"""True once something has no meaning: what comes then means nothing either."""


@dataclass(frozen=True)
class FaultGoal:
    """Something that may have no meaning; its ``flag`` is true after the step of a run that first shows it.

    ``var`` leaves its domain, or only says why a step has no meaning, which is a ``fault`` then.
    """

    var: Var
    flag: Var
    fault: bool

    @property
    def text(self) -> str:
        """What happens, as a sentence without its end."""
        return self.var.doc if self.fault else f"{self.var.name} gets a value outside {self.var.domain}"


def with_first_faults(system: TransitionSystem) -> tuple[TransitionSystem, tuple[FaultGoal, ...]]:
    """The system, whose checks of domains are goals of which a run raises one at most, and the goals."""
    flags = {check.name for check, _ in system.checks}
    known = {var.name: var for var in system.variables}
    made = replace(system, step=_first(system.step, flags), variables=(*system.variables, ENDED), checks=())
    every = ((check, known[checked(check)]) for check, _ in system.checks)
    return made, tuple(FaultGoal(var, check, is_fault(var)) for check, var in every)


def _first(statements: Sequence[Action], flags: set[str]) -> tuple[Statement, ...]:
    made: list[Statement] = []
    for one in statements:
        if isinstance(one, If):
            made.append(If(one.condition, _first(one.then, flags), _first(one.otherwise, flags)))
        elif isinstance(one, Assign) and one.var.name in flags and one.value is TRUE:
            made.append(If(ENDED, (), (one, Assign(ENDED, TRUE))))
        elif isinstance(one, Assign):
            made.append(one)
    return tuple(made)


__all__ = ["FaultGoal", "with_first_faults"]
