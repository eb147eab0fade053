"""k-induction with auxiliary invariants found automatically: proves that goals are never reached.

Random runs suggest invariants, Houdini keeps those that are inductive, and k-induction shows the goal
out of reach with their help.  A goal that the random runs, or the first few ticks, reach is answered
by that run.
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

from rovercheck.checker.engines import Limits, Progress
from rovercheck.checker.results.verdict import Answer
from rovercheck.checker.search.runner import SearchJob

if TYPE_CHECKING:  # `list engines` reads this file for two lines
    from rovercheck.spec_model.lang.expr import Expr, Var
    from rovercheck.spec_model.lang.system import TransitionSystem

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
    own = replace(system, source=None)
    function = "search" if candidates is None else "with_given"
    given = limits.depth if candidates is None else candidates
    ended = "the search ended without a word"
    job = SearchJob(NAME, f"{__name__}.search", function, (own, names, given), ended)
    return job.answers(names, limits.seconds, limits.memory, progress)
