"""Reduced ordered binary decision diagrams: large sets of valuations as small graphs over bits.

Bryant, *Graph-based algorithms for Boolean function manipulation*, IEEE ToC 1986.
"""

from collections.abc import Mapping
from dataclasses import dataclass

NONE, ALL = 0, 1
"""The numbers of the two leaves: no valuation that gets there belongs to the set, or every one does."""


@dataclass(frozen=True)
class Node:
    """Asks for bit ``bit`` of the raw value of a variable, in two's complement, the lowest being bit 0.

    ``low`` and ``high`` are the numbers of the nodes to go on with where the bit is 0 and where it is 1.
    """

    variable: str
    bit: int
    low: int
    high: int


@dataclass(frozen=True)
class Diagram:
    """A set of valuations.  ``nodes[i - 2]`` is the node with number i, and ``root`` the first to ask.

    Edges lead to lower numbers, the bits are asked in one order on every path, each at most once, and
    no two nodes are alike.  Variables that no node asks may have any value.
    """

    nodes: tuple[Node, ...]
    root: int

    def __contains__(self, valuation: Mapping[str, int]) -> bool:
        """Whether the valuation, which names at least the variables that are asked, belongs to the set."""
        number = self.root
        while number > ALL:
            node = self.nodes[number - 2]
            number = node.high if valuation[node.variable] >> node.bit & 1 else node.low
        return number == ALL

    @property
    def variables(self) -> tuple[str, ...]:
        """The variables that are asked for, by name, in alphabetical order."""
        return tuple(sorted({node.variable for node in self.nodes}))
