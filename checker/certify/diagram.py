"""Decision diagrams: a set of valuations as a small graph.

A node asks for the value of one variable.  Each of its edges is an interval of values and leads to another
node; a value on no edge is in no valuation of the set.  Variables are asked in one order on every
path, and two nodes with the same edges are one: the diagram of a set in an order is unique
(Bryant, *Graph-based algorithms for Boolean function manipulation*, IEEE ToC 1986; Srinivasan et al.,
*Algorithms for discrete function manipulation*, ICCAD 1990, for many values).
"""

from bisect import bisect_left, bisect_right
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from math import prod

from spec_model.lang.domain import Domain

TRUE = 0
"""The number of the node at which a path of the set ends."""

Edge = tuple[int, int, int]
"""Lowest value, highest value, number of the node it leads to."""


@dataclass(frozen=True)
class Node:
    """A question: the position of its variable, and edges with ascending values."""

    variable: int
    edges: tuple[Edge, ...]


@dataclass(frozen=True)
class Diagram:
    """A set of valuations of ``variables``, asked in this order.

    ``nodes[i - 1]`` is the node with number i; edges lead to lower numbers.  A variable that a path does
    not ask may have any value of its domain.  ``root`` is the node to begin with.
    """

    variables: tuple[str, ...]
    nodes: tuple[Node, ...]
    root: int

    def __contains__(self, valuation: Mapping[str, int]) -> bool:
        """Whether the valuation, which names at least the variables, belongs to the set."""
        number = self.root
        while number != TRUE:
            node = self.nodes[number - 1]
            value = valuation[self.variables[node.variable]]
            found = next((to for low, high, to in node.edges if low <= value <= high), None)
            if found is None:
                return False
            number = found
        return True


def size(diagram: Diagram) -> int:
    """The number of nodes and edges."""
    return len(diagram.nodes) + sum(len(node.edges) for node in diagram.nodes)


def count(diagram: Diagram, domains: Sequence[Domain]) -> int:
    """How many valuations belong to the set, the variables having these domains."""
    sizes = [len(domain) for domain in domains]
    total, level = [1], [len(domains)]
    for node in diagram.nodes:
        values = domains[node.variable].values
        total.append(
            sum(
                _between(values, low, high) * total[to] * prod(sizes[node.variable + 1 : level[to]])
                for low, high, to in node.edges
            )
        )
        level.append(node.variable)
    return total[diagram.root] * prod(sizes[: level[diagram.root]])


def _between(values: Sequence[int], low: int, high: int) -> int:
    return bisect_right(values, high) - bisect_left(values, low)


def members(diagram: Diagram, domains: Sequence[Domain]) -> Iterator[dict[str, int]]:
    """The valuations of the set, one after the other."""
    return _members(diagram, domains, diagram.root, 0)


def _members(
    diagram: Diagram, domains: Sequence[Domain], number: int, position: int
) -> Iterator[dict[str, int]]:
    """Values for the variables from ``position`` on that lead from a node to the end."""
    if position == len(domains):
        yield {}
        return
    edges: tuple[Edge, ...] = ((domains[position].low, domains[position].high, number),)
    if number != TRUE and diagram.nodes[number - 1].variable == position:
        edges = diagram.nodes[number - 1].edges
    values = domains[position].values
    for low, high, to in edges:
        for value in values[bisect_left(values, low) : bisect_right(values, high)]:
            for rest in _members(diagram, domains, to, position + 1):
                yield {diagram.variables[position]: value, **rest}
