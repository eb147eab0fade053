"""k-induction with auxiliary invariants found automatically: proves that goals are never reached.

Random runs suggest invariants, Houdini keeps those that are inductive, and k-induction shows the goal
out of reach with their help.  A goal that the random runs, or the first few ticks, reach is answered
by that run.
"""

from collections.abc import Mapping, Sequence
from contextlib import closing
from dataclasses import replace
from typing import TYPE_CHECKING

from checker.engines import Limits, Progress
from checker.engines.kinduction.events import (
    Event,
    InductionBound,
    InductionClosed,
    InductionFound,
    InductionProgress,
    InductionStuck,
)
from checker.process.isolate import ChildStopped, Send, messages
from checker.results.verdict import Answer, Open, Reached, Unreachable

if TYPE_CHECKING:  # `list engines` reads this file for two lines
    from spec_model.lang.expr import Expr, Var
    from spec_model.lang.system import TransitionSystem

NAME = "kinduction"
SUMMARY = "proofs by k-induction with invariants that are found by simulation and Houdini (Z3)"


def check(
    system: "TransitionSystem", goals: Sequence["Var"], limits: Limits, progress: Progress
) -> Mapping[str, Answer]:
    """``Unreachable`` with an inductive invariant, ``Reached`` by a run (``shortest`` only where it is known
    to be), or ``Open`` with the ticks that were searched exhaustively and the reason."""
    return _answered(system, goals, limits, progress, None)


def show(
    system: "TransitionSystem",
    goals: Sequence["Var"],
    limits: Limits,
    progress: Progress,
    candidates: "Sequence[Expr]",
) -> Mapping[str, Answer]:
    """``Unreachable`` where those of the candidates that are inductive exclude a goal, otherwise ``Open``:
    neither another invariant nor a run is searched for."""
    return _answered(system, goals, limits, progress, tuple(candidates))


def _answered(
    system: "TransitionSystem",
    goals: Sequence["Var"],
    limits: Limits,
    progress: Progress,
    candidates: "tuple[Expr, ...] | None",
) -> Mapping[str, Answer]:
    names = tuple(g.name for g in goals)
    state = _Answers(names)
    job = (replace(system, source=None), names, limits.depth, candidates)
    reason = "the search ended without a word"
    try:
        with closing(messages(_work, *job, seconds=limits.seconds, memory=limits.memory)) as events:
            for event in events:
                state.note(event)
                progress(state.line())
    except ChildStopped as stopped:
        reason = str(stopped)
    return {n: state.found.get(n) or Open(state.stuck.get(n, reason), state.deep[n]) for n in names}


class _Answers:
    """What is known of the goals so far."""

    def __init__(self, goals: Sequence[str]) -> None:
        self.found: dict[str, Answer] = {}
        self.stuck: dict[str, str] = {}
        self.deep = dict.fromkeys(goals, 0)
        self._doing = "starting"

    def note(self, event: Event | None) -> None:
        """Take down what an event says; None only shows that time has passed."""
        match event:
            case InductionFound(goal, run, shortest):
                self.found[goal] = Reached(run, shortest)
            case InductionClosed(goal, because):
                self.found[goal] = Unreachable(because)
            case InductionBound(goals, depth):
                self.deep |= dict.fromkeys(goals, depth)
            case InductionStuck(goals, reason):
                self.stuck |= dict.fromkeys(goals, reason)
            case InductionProgress(text):
                self._doing = text

    def line(self) -> str:
        left = len(self.deep) - len(self.found)
        text = f"{NAME}: {self._doing}, {left} goal{'s' * (left != 1)} open"
        return text + (f", {len(self.found)} decided" if self.found else "")


def _work(
    send: Send,
    system: "TransitionSystem",
    goals: tuple[str, ...],
    depth: int | None,
    candidates: "tuple[Expr, ...] | None",
) -> None:
    """In the child: Z3 is loaded here only."""
    from checker.engines.kinduction.search import search, with_given

    events = search(system, goals, depth) if candidates is None else with_given(system, goals, candidates)
    for event in events:
        send(event)
