"""Runs that leave a domain: from that tick on the charts have no meaning, and the model is to be mended.

Lowering guards an assignment whose value may not fit (``spec_model.lang.lower.ranges``): where it does not,
the variable keeps its old value and a check is raised.  What a run does after that is of no account.
"""

from collections.abc import Mapping, MutableMapping
from dataclasses import dataclass

from rovercheck.checker.results.verdict import Run
from rovercheck.spec_model.lang.action import Action, Assign, If
from rovercheck.spec_model.lang.chart import Block, Chart, parts
from rovercheck.spec_model.lang.domain import Num
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.evaluate import evaluate
from rovercheck.spec_model.lang.expr import Var
from rovercheck.spec_model.lang.lower.ranges import broken, protected
from rovercheck.spec_model.lang.programmed import ProgrammedChart, is_fault
from rovercheck.spec_model.lang.system import TransitionSystem


class LeavesDomain(ModelError):
    """Some run of a model assigns a value outside the domain of a variable: the model is to be mended."""


@dataclass(frozen=True)
class DomainViolation:
    """The first assignment of a run whose value does not fit: its tick, raw value and check."""

    tick: int
    assignment: Assign
    value: int
    check: Var

    @property
    def text(self) -> str:
        """``x := x + 1 gives 4, outside integer in 0..3``."""
        var = self.assignment.var
        shown = var.domain.show(self.value) if isinstance(var.sort, Num) else str(self.value)
        return f"{self.assignment} gives {shown}, outside {var.domain}"


def stray(system: TransitionSystem, run: Run) -> DomainViolation | None:
    """Where a run first leaves a domain, by the reference semantics; None if it never does."""
    at: dict[str, int] = {**system.init, **run.frozen}
    for tick, inputs in enumerate(run.inputs if system.checks else (), start=1):
        at |= inputs
        found = _executed(system.step, at)
        if found is not None:
            return DomainViolation(tick, *found)
    return None


def leaves(system: TransitionSystem, found: DomainViolation, *, first: bool = False) -> LeavesDomain:
    """The error that a stray assignment is; ``first``: no run of the system has one earlier."""
    when = f"first in tick {found.tick}" if first else f"in tick {found.tick} of a run"
    writers = _writers(system, found.assignment.var)
    places = {part.place for part in writers}
    [place] = places if len(places) == 1 else [None]
    said, how = found.text, "Widen the domain, or limit the value with minimum() and maximum()."
    if any(isinstance(part, ProgrammedChart) for part in writers):
        how = "Give it a wider domain in the file of domains, or limit the value in the chart."
    if is_fault(found.assignment.var):
        said, how = found.assignment.var.doc, "From there on the model has no meaning: change what is drawn."
    return LeavesDomain(f"{f'{place}: ' if place else ''}{system.name}: {said}, {when}. {how}")


def _writers(system: TransitionSystem, var: Var) -> list[Chart | Block]:
    """The charts and blocks that write a variable."""
    components = system.source.components if system.source else ()
    return [part for part in parts(components) if var.name in part.written]


def stayed(system: TransitionSystem, after: Mapping[str, int]) -> bool:
    """Whether the tick that ended in a state left no domain."""
    return not any(after.get(check.name) for check, _ in system.checks)


def _executed(program: tuple[Action, ...], at: MutableMapping[str, int]) -> tuple[Assign, int, Var] | None:
    """Run statements in place, up to the first assignment whose value does not fit, if there is one."""
    for statement in program:
        if isinstance(statement, Assign):
            at[statement.var.name] = evaluate(statement.value, at)
        elif isinstance(statement, If):
            holds = evaluate(statement.condition, at)
            kept = None if holds else protected(statement)
            if kept is not None:
                return kept, evaluate(kept.value, at), broken(kept.var)
            found = _executed(statement.then if holds else statement.otherwise, at)
            if found is not None:
                return found
    return None
