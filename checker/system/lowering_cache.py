"""Lowering remembered: the questions about a system are asked one after the other, of the same object."""

from functools import lru_cache

from rovercheck.spec_model.lang.lower import lower
from rovercheck.spec_model.lang.system import System, TransitionSystem

_KEPT = 4
"""Systems remembered; the largest of the rover takes a second to lower."""


def lowered(system: System) -> TransitionSystem:
    """The transition system of a system.  Raises ``ModelError`` for an ill-formed one."""
    return _lowered(ByIdentity(system))


class ByIdentity:
    """A system as a key of what is remembered: equal to itself alone (formulas cannot be compared)."""

    def __init__(self, system: System) -> None:
        self.system = system

    def __hash__(self) -> int:
        return id(self.system)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, ByIdentity) and other.system is self.system


@lru_cache(maxsize=_KEPT)
def _lowered(key: ByIdentity) -> TransitionSystem:
    return lower(key.system)
