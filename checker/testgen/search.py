"""Search by the checker's engines: shortest runs to goals, and proofs that no run reaches them."""

from collections.abc import Iterator, Sequence
from contextlib import closing
from dataclasses import dataclass
from itertools import groupby

from rovercheck.checker.engines import Limits
from rovercheck.checker.process.pool import Jobs
from rovercheck.checker.results.trace import Trace
from rovercheck.checker.results.verdict import Exhausted, Inductive, Proved, Unknown, Verdict, Violated
from rovercheck.checker.system.instrument.goals import CoverGoal, GoalKind, Watched
from rovercheck.checker.system.instrument.watch import watched
from rovercheck.checker.testgen.scripts import Script, script
from rovercheck.checker.verify.searches import (
    MachineWarning,
    SearchActivity,
    SearchEnd,
    SearchSettings,
    searches,
)
from rovercheck.checker.verify.tasks import Task
from rovercheck.properties.forms import Property, reachable
from rovercheck.spec_model.abstraction import Board
from rovercheck.spec_model.abstraction.board import in_steps_of
from rovercheck.spec_model.lang.chart import parts
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.system import System, in_order

TOGETHER = 16
"""Goals in one search."""
OTHERWISE = "the model that engines search has this part in another form"
SHORTEST_FIRST = ("bmc", "bdd", "explicit")
"""Engines that try shorter runs before longer ones."""


@dataclass(frozen=True)
class CoverFound:
    """A run that reaches a goal in its last tick, as a script; ``shortest``: no shorter one reaches it."""

    goal: str
    script: Script
    engine: str
    shortest: bool


@dataclass(frozen=True)
class Uncoverable:
    """No run of a system, which has all runs of the board, reaches the goal: how that was shown."""

    goal: str
    system: str
    engine: str
    because: str

    @property
    def text(self) -> str:
        """``Relay alone: explicit, all 154 reachable states``."""
        return f"{self.system}: {self.engine}, {self.because}"

    @staticmethod
    def of(goal: str, text: str) -> "Uncoverable":
        """What was written as ``text``."""
        system, _, how = text.partition(": ")
        engine, _, because = how.partition(", ")
        return Uncoverable(goal, system, engine, because)


@dataclass(frozen=True)
class OpenGoal:
    """Not decided, and why."""

    goal: str
    reason: str


CoverAnswer = CoverFound | Uncoverable | OpenGoal


@dataclass(frozen=True)
class SearchProgress:
    """A sign of life of the search."""

    line: str


def searched(
    board: Board, system: System, goals: Sequence[CoverGoal], limits: Limits, jobs: Jobs | None = None
) -> Iterator[CoverAnswer | SearchProgress]:
    """Run the engines for goals on a system whose runs the board has: those of its model."""
    for goal, verdict in _verdicts(system, goals, limits, jobs):
        match verdict:
            case Proved(Trace() as trace, engine):
                moments = (in_steps_of(board, system, {**t.after, **t.inputs}) for t in trace.ticks)
                inputs = list(board.run(moments))
                yield CoverFound(goal, script(board, inputs), engine, engine in SHORTEST_FIRST)
            case Violated((Exhausted() | Inductive()) as because, engine):
                yield Uncoverable(goal, system.name, engine, because.how)
            case Unknown(reason, _, _):
                yield OpenGoal(goal, reason)
            case str(line):
                yield SearchProgress(line)


def refuted(
    board: Board, goals: Sequence[CoverGoal], limits: Limits, jobs: Jobs | None = None
) -> Iterator[Uncoverable | OpenGoal | SearchProgress]:
    """The goals that no run reaches even if the part they are in has free inputs, all others left out.

    It has every run that the part has inside the board.  Says nothing of a part whose values leave their
    domains for some inputs.
    """
    for part in dict.fromkeys(g.part for g in goals):
        component = next(p for p in parts(board.system.components) if p.name == part)
        system = in_order(f"{part} alone", component)
        mine = [g for g in goals if g.part == part]
        try:
            for goal, verdict in _verdicts(system, mine, limits, jobs):
                match verdict:
                    case Violated((Exhausted() | Inductive()) as because, engine):
                        yield Uncoverable(goal, system.name, engine, because.how)
                    case Proved(Trace() as trace):
                        yield OpenGoal(goal, f"{part} alone reaches it in {len(trace)} ticks")
                    case str(line):
                        yield SearchProgress(line)
        except ModelError as error:
            yield SearchProgress(f"{part} alone says nothing: {error}")


def _verdicts(
    system: System, goals: Sequence[CoverGoal], limits: Limits, jobs: Jobs | None
) -> Iterator[tuple[str, Verdict | str]]:
    """What the engines say of each goal, by id, and what they are doing."""
    looked = _looked(system, goals)
    found = {(g.id, g.text): g for g in looked.goals}
    same = [g for g in goals if (g.id, g.text) in found]
    yield from ((g.id, Unknown(OTHERWISE, 0, "none")) for g in goals if g not in same)
    todo = [
        Task(looked.system, tuple(_property(found[g.id, g.text], system) for g in together))
        for together in _together(same)
    ]
    with closing(
        searches(todo, {system.name: looked.system}, SearchSettings(limits=limits, jobs=jobs))
    ) as heard:
        for one in heard:
            match one:
                case SearchActivity(task, line):
                    yield "", f"{task.title}: {line}"
                case MachineWarning(text):
                    yield "", text
                case SearchEnd():
                    pass
                case _:
                    yield one.property.id, one.verdict


def _together(goals: Sequence[CoverGoal]) -> Iterator[Sequence[CoverGoal]]:
    """Some goals of one part at a time."""
    for _, found in groupby(goals, lambda g: g.part):
        mine = list(found)
        yield from (mine[first : first + TOGETHER] for first in range(0, len(mine), TOGETHER))


def _looked(system: System, goals: Sequence[CoverGoal]) -> Watched:
    kinds: set[GoalKind] = {g.kind for g in goals}
    return watched(system, kinds, {g.id for g in goals})


def _property(goal: CoverGoal, system: System) -> Property:
    return reachable(goal.id, goal.text, that=goal.flag, covers=["coverage"], on=system.name)
