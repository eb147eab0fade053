"""Lowering remembered: the questions about a system are asked one after the other, of the same object."""

from functools import lru_cache

from rovercheck.spec_model.lang.lower import ByIdentity, lower
from rovercheck.spec_model.lang.system import System, TransitionSystem

_KEPT = 4
"""Systems remembered; the largest of the rover takes a second to lower."""


def lowered(system: System) -> TransitionSystem:
    """The transition system of a system.  Raises ``ModelError`` for an ill-formed one."""
    return _lowered(ByIdentity(system))


@lru_cache(maxsize=_KEPT)
def _lowered(key: ByIdentity[System]) -> TransitionSystem:
    return lower(key.part)
