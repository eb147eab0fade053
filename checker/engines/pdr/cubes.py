"""Cubes: conjunctions of literals over the latches, the language of frames and obligations.

A literal is the number of a latch (the first is 1), negative where the latch is false.
"""

from collections.abc import Iterable
from dataclasses import dataclass


@dataclass(frozen=True, slots=True, eq=False)
class Cube:
    """A conjunction of literals, in ascending order of latches.

    ``mask`` has the bit of every latch that occurs, ``value`` of every one that is to be true: cubes
    and states are compared by a few operations on whole numbers.
    """

    literals: tuple[int, ...]
    mask: int
    value: int

    def __len__(self) -> int:
        return len(self.literals)

    def covers(self, other: "Cube") -> bool:
        """Whether every state of the other cube lies in this one."""
        return self.mask & other.mask == self.mask and other.value & self.mask == self.value


def cube(literals: Iterable[int]) -> Cube:
    """The cube of these literals, which do not contradict each other."""
    mask = value = 0
    ordered = tuple(sorted(literals, key=abs))
    for literal in ordered:
        bit = 1 << abs(literal)
        mask |= bit
        if literal > 0:
            value |= bit
    return Cube(ordered, mask, value)
