"""Explicit search: every reachable state is visited, breadth first, by compiled code.

One search decides all goals that depend on nearly the same variables; the first hit of a goal ends a
shortest run.  It stops when every goal is reached or nothing new appears.
"""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

from rovercheck.checker.engines import Limits, Progress
from rovercheck.checker.results.verdict import Answer

if TYPE_CHECKING:  # `list engines` reads this file for two lines
    from rovercheck.spec_model.lang.expr import Var
    from rovercheck.spec_model.lang.system import TransitionSystem

NAME = "explicit"
SUMMARY = "breadth-first search of all reachable states, compiled to native code"


def check(
    system: "TransitionSystem", goals: Sequence["Var"], limits: Limits, progress: Progress
) -> Mapping[str, Answer]:
    """An answer for each goal, by name.

    Raises ``OutsideDomain`` when a tick gives a variable of the state a value outside its domain, and
    ``ModelError`` for a goal that no tick leads to: one that is no variable of the system.
    """
    from rovercheck.checker.engines.explicit.answers import answers  # with numpy and LLVM

    return answers(system, goals, limits, progress)
