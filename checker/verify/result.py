"""Results: an answer about a goal taken home as a verdict on a property."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Protocol

from rovercheck.checker.certify.outcome import Outcome
from rovercheck.checker.results.trace import Trace
from rovercheck.checker.results.verdict import (
    Answer,
    Open,
    Proved,
    Reached,
    StoredRun,
    Unknown,
    Unreachable,
    Verdict,
    Violated,
)
from rovercheck.checker.verify.portfolio.question import Found, Prior
from rovercheck.properties.forms import Property
from rovercheck.properties.reduce import Goal
from rovercheck.spec_model.lang.expr import Var
from rovercheck.spec_model.lang.system import System, TransitionSystem


class EngineQuery(Protocol):
    """Runs the engines that the user chose; ``prior`` is what is known of the answer."""

    def __call__(self, system: TransitionSystem, goals: Sequence[Var], prior: Prior = Prior.NONE) -> Found:
        """An answer for each goal and for each check of the system."""
        ...


@dataclass(frozen=True)
class Result:
    """A property, its verdict, and the name of the system the verdict is about.

    ``in_part``: the verdict rests on having searched a system that has only some of the runs of the
    rover, so it is none about the rover.  ``certificate``: what came of checking the proof again, where
    that was asked for and the verdict rests on a proof.  ``limited_to``: what a proof is limited to, or why a
    run may be none, in a few words.  ``same_under``: names in the store that stand for all that the property
    sees.
    """

    property: Property
    verdict: Verdict
    system: str
    in_part: bool = False
    certificate: Outcome | None = None
    limited_to: str = ""
    same_under: tuple[str, ...] = field(default=(), compare=False)


def result(system: TransitionSystem, goal: Goal, answer: Answer, by: str) -> Result:
    """The result of a goal; a run is minimised and replayed first.  Raises ``ReplayError``."""
    return Result(goal.property, _verdict(system, goal, answer, by), system.name)


def _verdict(system: TransitionSystem, goal: Goal, answer: Answer, by: str) -> Verdict:
    match answer:
        case Reached(run, shortest):
            from rovercheck.checker.verify.runs.minimise import minimise_inputs
            from rovercheck.checker.verify.runs.replay import replay

            trace = replace(replay(system, goal, minimise_inputs(system, goal.var, run)), shortest=shortest)
            return Proved(trace, by) if goal.reach else Violated(trace, by)
        case Unreachable(because):
            return Violated(because, by) if goal.reach else Proved(because, by)
        case Open(reason, depth):
            return Unknown(reason, depth, by)


def check_domains(system: TransitionSystem, found: Found) -> None:
    """Raises ``LeavesDomain``, of the shortest run that leaves a domain, if one is known."""
    checks = {check.name: found[check.name][0] for check, _ in system.checks if check.name in found}
    runs = [answer for answer in checks.values() if isinstance(answer, Reached)]
    if runs:
        from rovercheck.checker.verify.runs.domains import leaves, stray

        shortest = min(runs, key=lambda answer: len(answer.run))
        at = stray(system, shortest.run)
        assert at is not None, "a check is raised by a run that leaves no domain"
        known = len(checks) == len(system.checks) and all(_none_before(a, at.tick) for a in checks.values())
        raise leaves(system, at, first=known)


def _none_before(answer: Answer, tick: int) -> bool:
    """Whether nothing is reached before a tick."""
    match answer:
        case Reached(run, shortest):
            return shortest and len(run) >= tick
        case Open(_, depth):
            return depth >= tick - 1
        case _:
            return True


def limited(one: Result, systems: Mapping[str, System]) -> Result:
    """The result with what it is limited to by the system that it is about."""
    system = systems.get(one.system, systems[one.property.on])
    return replace(one, in_part=_in_part(one, system), limited_to=_limited_to(one, system))


def _in_part(result: Result, system: System) -> bool:
    """Whether a search of too few runs was exhausted; a run found in it is a run of the rover."""
    verdict = result.verdict
    return (
        system.under
        and not isinstance(verdict, Unknown)
        and not isinstance(verdict.because, Trace | StoredRun)
    )


def _limited_to(result: Result, system: System) -> str:
    """What is said of the system beside a proof; a run is one of the rover whatever was left out of it."""
    verdict = result.verdict
    rests_on_all = not isinstance(verdict, Unknown) and not isinstance(verdict.because, Trace | StoredRun)
    if isinstance(verdict, Unknown):
        return ""
    return system.limited_to if rests_on_all else system.doubted_for
