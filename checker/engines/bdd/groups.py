"""Goals that are searched together: those that depend on nearly the same variables."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from checker.encode.bits import Circuit
from checker.encode.bits.model import cut
from checker.encode.cone import as_written, cone, constants, folded
from checker.encode.gather import gathered
from checker.encode.symbolic import transition
from spec_model.lang.expr import Var
from spec_model.lang.system import TransitionSystem

EXTRA = 8
"""Bits that a goal may add to those of others and still be searched with them."""


@dataclass(frozen=True)
class BddGroup:
    """A circuit for some goals, and the constants among the variables that the goals depend on.

    Constants keep their value in every run because all of them together do; the circuit has none.
    """

    circuit: Circuit
    constants: tuple[tuple[Var, int], ...]


def groups(system: TransitionSystem, goals: Sequence[str]) -> Iterator[BddGroup]:
    """The groups, those with few latches first."""
    whole = transition(system)
    fixed = constants(whole)
    moving = folded(whole, fixed)
    cones = {
        goal: {v.name: v for v in cone(moving, [goal]).variables if v.name not in goals} for goal in goals
    }
    for together in gathered(cones, EXTRA):
        kept = tuple((v, fixed[v.name]) for v in as_written(system, together) if v.name in fixed)
        yield BddGroup(cut(moving, together), kept)
