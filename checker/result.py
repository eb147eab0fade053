"""Results: an answer about a goal taken home as a verdict on a property."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Protocol

from checker.certify.outcome import Outcome
from checker.portfolio.question import Found, Hint
from checker.runs.calm import calmed
from checker.runs.replay import replay
from checker.verdict import Answer, Open, Proved, Reached, Unknown, Unreachable, Verdict, Violated
from properties.forms import Property
from properties.reduce import Goal
from spec_model.lang.errors import ModelError
from spec_model.lang.expr import Var
from spec_model.lang.system import TransitionSystem

Answers = Found
"""An answer for each goal and the name of the engine that gave it."""


class Ask(Protocol):
    """Asks the engines that the user chose; the hint tells what is known of the answer."""

    def __call__(self, system: TransitionSystem, goals: Sequence[Var], hint: Hint = Hint.NONE) -> Answers:
        """An answer for each goal and for each check of the system."""
        ...


@dataclass(frozen=True)
class Result:
    """A property, its verdict, and the name of the system the verdict is about.

    ``in_part``: the verdict rests on having searched a system that has only some of the runs of the
    rover, so it is none about the rover.  ``certificate``: what came of checking the proof again, where
    that was asked for and the verdict rests on a proof.
    """

    property: Property
    verdict: Verdict
    system: str
    in_part: bool = False
    certificate: Outcome | None = None


def result(system: TransitionSystem, goal: Goal, answer: Answer, by: str) -> Result:
    """The result of a goal; a run is calmed and replayed first.  Raises ``ReplayError``."""
    return Result(goal.property, _verdict(system, goal, answer, by), system.name)


def _verdict(system: TransitionSystem, goal: Goal, answer: Answer, by: str) -> Verdict:
    match answer:
        case Reached(run, shortest):
            trace = replace(replay(system, goal, calmed(system, goal.var, run)), shortest=shortest)
            return Proved(trace, by) if goal.reach else Violated(trace, by)
        case Unreachable(because):
            return Violated(because, by) if goal.reach else Proved(because, by)
        case Open(reason, depth):
            return Unknown(reason, depth, by)


def check_domains(system: TransitionSystem, found: Answers) -> None:
    """Raises ``ModelError`` if some run is known that takes a variable out of its domain."""
    for check, text in system.checks:
        answer, _ = found.get(check.name, (None, ""))
        if isinstance(answer, Reached):
            raise ModelError(
                f"{system.name}: {text}, first in tick {len(answer.run)}. "
                "Widen the domain or saturate the assignment."
            )
