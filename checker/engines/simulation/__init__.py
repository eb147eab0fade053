"""Simulation: runs with inputs that are held constant, then in blocks; finds runs, proves nothing.

A run of a thousand ticks in which nobody touches anything is found at once by leaving the inputs alone; a
breadth-first search first visits all that could happen in the meantime.
"""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

from rovercheck.checker.engines import Limits, Progress
from rovercheck.checker.results.verdict import Answer

if TYPE_CHECKING:  # as in `explicit`
    from rovercheck.spec_model.lang.expr import Var
    from rovercheck.spec_model.lang.system import TransitionSystem

NAME = "simulation"
SUMMARY = "runs with inputs held constant, then in blocks; finds long runs quickly, proves nothing"
SAMPLES = True


def check(
    system: "TransitionSystem", goals: Sequence["Var"], limits: Limits, progress: Progress
) -> Mapping[str, Answer]:
    """``Reached`` by a run, ``shortest`` only of one tick, or ``Open``: of no tick all is searched."""
    from rovercheck.checker.engines.simulation.batches import answers  # numpy

    return answers(system, goals, limits, progress)
