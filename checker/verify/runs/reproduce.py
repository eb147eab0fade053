"""A run of an over-approximation counts only if the system it stands for has one too."""

from collections.abc import Mapping
from dataclasses import replace

from rovercheck.checker.results.trace import counted_ticks
from rovercheck.checker.results.verdict import Reached, Unknown
from rovercheck.checker.system.lowering_cache import lowered
from rovercheck.checker.verify.portfolio.question import PortfolioQuestion, Prior
from rovercheck.checker.verify.portfolio.shape import shape
from rovercheck.checker.verify.result import EngineQuery, Result, check_domains, result
from rovercheck.checker.verify.runs.minimise import minimise_inputs, transferred
from rovercheck.properties.reduce import Goal, Question, reduce
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.system import System

Runs = Mapping[str, tuple[Reached, str]]
"""The goals that were reached, with the engine that did."""


def reproduced(question: Question, runs: Runs, concrete: System, query: EngineQuery) -> list[Result]:
    """A result about ``concrete`` for each goal reached on the over-approximation in ``question``.

    The same inputs are tried first: a run of the concrete system as short as the shortest of the
    over-approximation is a shortest one.  What is left is searched for, all goals together.
    """
    found: list[Result] = []
    reached: list[Goal] = []
    for goal in (g for g in question.goals if g.var.name in runs):
        why = _meaningless(goal, concrete)
        if why:
            found.append(_only_here(question.system.name, goal, runs[goal.var.name], concrete.name, why))
        else:
            reached.append(goal)
    if not reached:
        return found
    there = reduce(lowered(concrete), [replace(g.property, on=concrete.name) for g in reached])
    asked = PortfolioQuestion(there.system, ())
    if there.system.checks and shape(asked).enumerable:  # else it costs too much
        check_domains(there.system, query(there.system, []))
    left: list[tuple[Goal, Goal]] = []
    for goal, same in zip(reached, there.goals, strict=True):
        answer, by = runs[goal.var.name]
        run = moved(question, goal, answer, there, same)
        if run is None:
            left.append((goal, same))
        else:
            found.append(result(there.system, same, run, by))
    return found + (_searched(question, runs, there, left, query) if left else [])


def _meaningless(goal: Goal, concrete: System) -> str:
    """Why a property has no meaning on a concrete system: it may speak of a value that is free elsewhere."""
    try:
        reduce(lowered(concrete), [replace(goal.property, on=concrete.name)])
    except ModelError as error:
        return str(error)
    return ""


def _only_here(name: str, goal: Goal, reached: tuple[Reached, str], concrete: str, why: str) -> Result:
    answer, by = reached
    reason = (
        f"reached after {counted_ticks(len(answer.run))} on {name}, an over-approximation; {concrete}, on "
        f"which it would be reproduced, cannot be asked: {why}"
    )
    return Result(goal.property, Unknown(reason, len(answer.run) - 1, by), name)


def not_reproducible(question: Question, runs: Runs) -> list[Result]:
    """What can be said of a run of an over-approximation that stands for no system of ours: nothing."""
    name = question.system.name
    return [
        Result(goal.property, Unknown(only_there(name, len(answer.run)), len(answer.run) - 1, by), name)
        for goal in question.goals
        if goal.var.name in runs
        for answer, by in [runs[goal.var.name]]
    ]


def only_there(name: str, ticks: int) -> str:
    """Why a run of an over-approximation that stands for no system of ours decides nothing."""
    return (
        f"reached after {counted_ticks(ticks)} on {name}, which has more runs than the rover; "
        "no system is named on which to reproduce it"
    )


def moved(question: Question, goal: Goal, answer: Reached, there: Question, same: Goal) -> Reached | None:
    """The run with the same inputs on the system of ``there``, if it reaches the same goal."""
    for run in (answer.run, minimise_inputs(question.system, goal.var, answer.run)):
        moved = transferred(run, there.system, same.var)
        if moved is not None:
            return Reached(moved, answer.shortest)
    return None


def _searched(
    question: Question,
    runs: Runs,
    there: Question,
    left: list[tuple[Goal, Goal]],
    query: EngineQuery,
) -> list[Result]:
    answers = query(there.system, [same.var for _, same in left], Prior.CONCRETE)
    check_domains(there.system, answers)
    found = []
    for goal, same in left:
        outcome = result(there.system, same, *answers[same.var.name])
        if isinstance(outcome.verdict, Unknown):
            ticks = len(runs[goal.var.name][0].run)
            reason = (
                f"reached after {counted_ticks(ticks)} on {question.system.name}, an over-approximation; "
                f"not reproduced on {there.system.name}: {outcome.verdict.reason}"
            )
            outcome = replace(outcome, verdict=replace(outcome.verdict, reason=reason))
        found.append(outcome)
    return found
