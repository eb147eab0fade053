"""Bounded model checking: is there a run of 1, 2, ... ticks that reaches a goal?  Finds, never proves.

The step is unrolled over bit-vectors and Z3 searches; runs come shortest first.
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

NAME = "bmc"
SUMMARY = "shortest runs by unrolling the step over bit-vectors (Z3); a bounded search, never a proof"
DEPTH = 300
"""Ticks searched when the limits name no depth; the answer says so."""


def check(
    system: "TransitionSystem", goals: Sequence["Var"], limits: Limits, progress: Progress
) -> Mapping[str, Answer]:
    """Shortest runs to the goals; ``Open`` with the depth searched for those not reached."""
    depth = DEPTH if limits.depth is None else limits.depth
    names = tuple(g.name for g in goals)
    job = SearchJob(
        NAME, f"{__name__}.search", "search", (replace(system, source=None), names, depth),
        _searched(limits.depth), depth,
    )  # fmt: skip
    return job.answers(names, limits.seconds, limits.memory, progress)


def _searched(wanted: int | None) -> str:
    """What is said of a goal when all ticks were searched; a depth that nobody asked for is named as ours."""
    if wanted is None:
        return f"no run of at most {DEPTH} ticks reaches it, and no other depth was asked for"
    return f"no run of at most {counted_ticks(wanted)} reaches it"
