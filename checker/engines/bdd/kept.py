"""The set of valuations reached, as a diagram over bits that other tools can read."""

from checker.encode.bits.blast import bits_needed
from checker.engines.bdd.groups import BddGroup
from checker.engines.bdd.layers import Layers
from checker.engines.bdd.space import Function
from checker.results.diagram import ALL, NONE, Diagram, DiagramNode

MOST = 100_000
"""Nodes of the largest diagram that is kept: a certificate is read by people's solvers, too."""


def diagram(group: BddGroup, layers: Layers) -> Diagram | None:
    """The valuations reached, constants among them; None if there are too many nodes."""
    if 2 * layers.reached.node_count() > MOST:
        return None
    bits = {layers.space.current[x.literal]: x.bit for x in group.circuit.latches}
    nodes: list[DiagramNode] = []
    numbers: dict[Function, int] = {}

    def number(function: Function) -> int:
        """A node without complement; the recursion is as deep as there are bits."""
        if function not in numbers:
            parts = function.cofactors()
            if parts is None:
                return ALL if function.valid() else NONE
            high, low = map(number, parts)
            bit = bits[_variable(function)]
            nodes.append(DiagramNode(bit.var.name, bit.number, low, high))
            numbers[function] = len(nodes) + 1
        return numbers[function]

    root = number(layers.reached)
    for var, value in group.constants:
        for i in range(bits_needed(var)):
            low, high = (NONE, root) if value >> i & 1 else (root, NONE)
            nodes.append(DiagramNode(var.name, i, low, high))
            root = len(nodes) + 1
    return Diagram(tuple(nodes), root)


def _variable(function: Function) -> int:
    variable = function.node_var()
    assert variable is not None
    return variable
