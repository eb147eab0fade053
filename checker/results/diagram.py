"""Reduced ordered binary decision diagrams: large sets of states as small graphs over bits.

Bryant, *Graph-based algorithms for Boolean function manipulation*, IEEE ToC 1986.
"""

from collections.abc import Mapping
from dataclasses import dataclass

from rovercheck.spec_model.lang.domain import Bool, Num
from rovercheck.spec_model.lang.expr import FALSE, TRUE, Apply, Const, Expr, Var
from rovercheck.spec_model.lang.operators import Op

NONE, ALL = 0, 1
"""The numbers of the two leaves: no state that gets there belongs to the set, or every one does."""


@dataclass(frozen=True)
class DiagramNode:
    """Asks for bit ``bit`` of the raw value of a variable, in two's complement, the lowest being bit 0.

    ``low`` and ``high`` are the numbers of the nodes to go on with where the bit is 0 and where it is 1.
    """

    variable: str
    bit: int
    low: int
    high: int


@dataclass(frozen=True)
class Diagram:
    """A set of states.  ``nodes[i - 2]`` is the node with number i, and ``root`` the first to ask.

    Edges lead to lower numbers, the bits are asked in one order on every path, each at most once, and
    no two nodes are alike.  Variables that no node asks may have any value.
    """

    nodes: tuple[DiagramNode, ...]
    root: int

    def __contains__(self, valuation: Mapping[str, int]) -> bool:
        """Whether the state, which names at least the variables that are asked, belongs to the set."""
        number = self.root
        while number > ALL:
            node = self.nodes[number - 2]
            number = node.high if valuation[node.variable] >> node.bit & 1 else node.low
        return number == ALL

    @property
    def variables(self) -> tuple[str, ...]:
        """The variables that are asked for, by name, in alphabetical order."""
        return tuple(sorted({node.variable for node in self.nodes}))


def formula(diagram: Diagram, variables: Mapping[str, Var]) -> Expr:
    """The set as a formula over its variables, given by name; nodes that are shared are shared in it."""
    made: list[Expr] = [FALSE, TRUE]
    for node in diagram.nodes:
        var = variables[node.variable]
        test = var if isinstance(var.sort, Bool) else Apply(Op.BIT, (var, Const(node.bit, Num())), Bool())
        made.append(Apply(Op.ITE, (test, made[node.high], made[node.low]), Bool()))
    return made[diagram.root]
