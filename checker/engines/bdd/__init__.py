"""Symbolic search: sets of states as binary decision diagrams, breadth first, until nothing is new.

Burch, Clarke, McMillan, Dill, Hwang, *Symbolic model checking: 10^20 states and beyond*, LICS 1990.
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

NAME = "bdd"
SUMMARY = "all reachable states as binary decision diagrams (OxiDD); proofs and shortest runs"

_NODE = 48
"""Bytes of a node: 36 as measured (children, count, place in the table), the rest for what Python holds."""
_STACKS = 2 << 30
"""Bytes of address space that the library reserves for the stacks of its threads, and Python's own."""


def check(
    system: "TransitionSystem", goals: Sequence["Var"], limits: Limits, progress: Progress
) -> Mapping[str, Answer]:
    """Shortest runs to the goals, or the closed set of states that shows that there is none."""
    names = tuple(g.name for g in goals)
    job = SearchJob(
        NAME, f"{__name__}.search", "search",
        (replace(system, source=None), names, limits.depth, limits.memory // _NODE),
        f"the depth limit of {counted_ticks(limits.depth or 0)}",
    )  # fmt: skip
    return job.answers(names, limits.seconds, limits.memory + _STACKS, progress)
