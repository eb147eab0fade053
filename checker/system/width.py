"""How many bits a state takes, and how many of them are chosen in each tick."""

from collections.abc import Iterable

from rovercheck.spec_model.lang.expr import Var
from rovercheck.spec_model.lang.system import TransitionSystem

WIDE = 200
"""Bits of a state from which on it is wide."""

FEW = 4
"""Bits that are free in each tick: with so few a state has few successors, however wide it is."""


def driven(system: TransitionSystem) -> bool:
    """Whether little is chosen in each tick, so that most of a state follows from what was chosen."""
    return bits_of(system.inputs) <= (FEW if bits_of(system.variables) > WIDE else 1)


def bits_of(variables: Iterable[Var]) -> int:
    """The bits that all their values together take."""
    return sum((len(v.domain) - 1).bit_length() for v in variables)
