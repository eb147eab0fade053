"""k-induction: the goal, false for some ticks from any valuation of the invariant, stays false.

See Sheeran, Singh and Stålmarck, Checking Safety Properties Using Induction and a SAT-Solver (2000).
"""

from collections.abc import Sequence
from dataclasses import dataclass

import z3

from checker.encode.invariants import TemplateCube
from checker.engines.kinduction.ticks import Scope, Ticks
from spec_model.lang.expr import Expr

WINDOW = 6
"""Ticks of the longest induction that is tried at first; half of the goals never reached need three."""


@dataclass(frozen=True)
class InductionStep:
    """The goal is not true after ``ticks`` ticks, by the conjuncts named; ``simple`` as in ``Inductive``."""

    ticks: int
    conjuncts: tuple[Expr, ...]
    simple: bool


def induction(
    scope: Scope, goal: str, invariant: Sequence[Expr], window: int, patience: int, *, simple: bool = False
) -> InductionStep | TemplateCube:
    """Whether the goal is inductive in at most ``window`` ticks, or else where the longest one fails.

    ``simple`` takes the valuations before the ticks to differ from each other.  Raises ``GaveUp``.
    """
    ticks = Ticks(scope, patience)
    literals = ticks.assumed(invariant)
    cube = TemplateCube({}, frozenset())
    for length in range(1, window + 1):
        ticks.tick()
        if simple:
            _differ(ticks, length - 1)
        hit = ticks.after(length, goal)
        if not ticks.sat(ticks.mark(hit), *map(z3.Bool, literals)):
            return InductionStep(length, tuple(literals[name] for name in ticks.core(literals)), simple)
        if length == window:
            cube = ticks.cube(ticks.reading(), hit)
        ticks.solver.add(z3.Not(hit))
    return cube


def _differ(ticks: Ticks, last: int) -> None:
    """The valuation after the last tick is none of those before it."""
    state = ticks.valuation(last)
    for tick in range(last):
        earlier = ticks.valuation(tick)
        ticks.solver.add(z3.Or([earlier[name] != state[name] for name in state]))
