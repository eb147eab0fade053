"""Property directed reachability: proves by an inductive invariant, or finds a run, bit by bit.

Works on the circuit of a system with an incremental SAT solver, without unrolling (Bradley, VMCAI 2011).
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

from rovercheck.checker.engines import Limits, Progress
from rovercheck.checker.results.trace import counted_ticks
from rovercheck.checker.results.verdict import Answer
from rovercheck.checker.search.runner import SearchJob

if TYPE_CHECKING:  # `list engines` reads this file for two lines
    from rovercheck.spec_model.lang.expr import Var
    from rovercheck.spec_model.lang.system import TransitionSystem

NAME = "pdr"
SUMMARY = "proofs by inductive invariants over bits, and runs, not always the shortest (IC3 over MiniSat)"


def check(
    system: "TransitionSystem", goals: Sequence["Var"], limits: Limits, progress: Progress
) -> Mapping[str, Answer]:
    """Invariants and runs; ``Open`` with the ticks known to be free of a goal where neither was found.

    Bounded by ``limits.depth``, the search may still find a proof, or a run that is longer.
    """
    names = tuple(g.name for g in goals)
    job = SearchJob(
        NAME, f"{__name__}.groups", "decisions", (replace(system, source=None), names, limits.depth),
        f"no run of at most {counted_ticks(limits.depth or 0)} reaches it", limits.depth,
    )  # fmt: skip
    return job.answers(names, limits.seconds, limits.memory, progress)
