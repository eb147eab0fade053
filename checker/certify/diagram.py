"""Decision diagrams: a set of states as a small graph.

A node asks for the value of one variable.  Each of its edges is an interval of values and leads to another
node; a value on no edge is in no state of the set.  Variables are asked in one order on every
path, and two nodes with the same edges are one: the diagram of a set in an order is unique
(Bryant, *Graph-based algorithms for Boolean function manipulation*, IEEE ToC 1986; Srinivasan et al.,
*Algorithms for discrete function manipulation*, ICCAD 1990, for many values).
"""

from bisect import bisect_left, bisect_right
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import islice
from math import prod
from typing import Any, overload

import numpy as np
from numpy.typing import NDArray

from rovercheck.spec_model.lang.domain import Domain

TRUE = 0
"""The number of the node at which a path of the set ends."""

Column = NDArray[Any]
Edge = tuple[int, int, int]
"""Lowest value, highest value, number of the node it leads to."""


@dataclass(frozen=True)
class CertifiedNode:
    """A question: the position of its variable, and edges with ascending values."""

    variable: int
    edges: tuple[Edge, ...]


@dataclass(frozen=True, eq=False)
class Nodes(Sequence[CertifiedNode]):
    """Nodes as columns, for there may be millions: number i is at place i - 1.

    ``variable`` has a place for each node, ``owner`` (the place of the node), ``low``, ``high`` and ``to``
    one for each edge, node after node.
    """

    variable: Column
    owner: Column
    low: Column
    high: Column
    to: Column

    @classmethod
    def of(cls, nodes: Iterable[CertifiedNode]) -> "Nodes":
        """The same nodes.  Raises ``OverflowError`` for a number of more than 64 bits."""
        if isinstance(nodes, Nodes):
            return nodes
        nodes = tuple(nodes)
        edges = np.array([edge for node in nodes for edge in node.edges], dtype=np.int64).reshape(-1, 3)
        owner = np.repeat(np.arange(len(nodes)), [len(node.edges) for node in nodes])
        return cls(np.array([n.variable for n in nodes], dtype=np.int64), owner, *edges.T)

    @overload
    def __getitem__(self, at: int) -> CertifiedNode: ...
    @overload
    def __getitem__(self, at: slice) -> tuple[CertifiedNode, ...]: ...
    def __getitem__(self, at: int | slice) -> CertifiedNode | tuple[CertifiedNode, ...]:
        if isinstance(at, slice):
            return tuple(self)[at]
        first, last = np.searchsorted(self.owner, at), np.searchsorted(self.owner, at, "right")
        columns = (column[first:last].tolist() for column in (self.low, self.high, self.to))
        return CertifiedNode(int(self.variable[at]), tuple(zip(*columns, strict=True)))

    def __len__(self) -> int:
        return len(self.variable)

    def __iter__(self) -> Iterator[CertifiedNode]:
        edges = zip(self.low.tolist(), self.high.tolist(), self.to.tolist(), strict=True)
        sizes = np.bincount(self.owner, minlength=len(self)).tolist()
        return (
            CertifiedNode(v, tuple(islice(edges, n)))
            for v, n in zip(self.variable.tolist(), sizes, strict=True)
        )

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Nodes) and all(map(np.array_equal, self._columns, other._columns))

    __hash__ = None  # type: ignore[assignment]

    @property
    def _columns(self) -> tuple[Column, ...]:
        return self.variable, self.owner, self.low, self.high, self.to


@dataclass(frozen=True)
class CertifiedDiagram:
    """A set of states of ``variables``, asked in this order.

    ``nodes[i - 1]`` is the node with number i; edges lead to lower numbers.  A variable that a path does
    not ask may have any value of its domain.  ``root`` is the node to begin with.
    """

    variables: tuple[str, ...]
    nodes: Nodes
    root: int

    def __contains__(self, valuation: Mapping[str, int]) -> bool:
        """Whether the state, which names at least the variables, belongs to the set."""
        number = self.root
        while number != TRUE:
            node = self.nodes[number - 1]
            value = valuation[self.variables[node.variable]]
            found = next((to for low, high, to in node.edges if low <= value <= high), None)
            if found is None:
                return False
            number = found
        return True


def size(diagram: CertifiedDiagram) -> int:
    """The number of nodes and edges."""
    return len(diagram.nodes) + len(diagram.nodes.to)


def count(diagram: CertifiedDiagram, domains: Sequence[Domain]) -> int:
    """How many states belong to the set, the variables having these domains."""
    nodes, sizes = diagram.nodes, [len(domain) for domain in domains]
    level = positions(diagram)
    total = np.ones(len(nodes) + 1)
    by_variable = np.argsort(nodes.variable[nodes.owner], kind="stable")
    ends = np.searchsorted(nodes.variable[nodes.owner][by_variable], np.arange(len(sizes) + 1))
    for position in reversed(range(len(sizes))):
        edges = by_variable[ends[position] : ends[position + 1]]
        values = np.array(domains[position].values)
        first = np.searchsorted(values, nodes.low[edges])
        within = np.searchsorted(values, nodes.high[edges], "right") - first
        skipped = np.cumprod([1.0, *sizes[position + 1 :]])[level[nodes.to[edges]] - position - 1]
        found = np.bincount(nodes.owner[edges], within * total[nodes.to[edges]] * skipped, len(nodes))
        own = nodes.variable == position
        total[1:][own] = found[own]
    if total.max() < EXACT:
        return int(total[diagram.root]) * prod(sizes[: level[diagram.root]])
    return counted(diagram, domains)


EXACT = 2.0**53
"""Whole numbers below this are exact as floating-point numbers."""


def positions(diagram: CertifiedDiagram) -> Column:
    """The position of the variable that each node asks, by number; after all others for the end."""
    return np.concatenate([[len(diagram.variables)], diagram.nodes.variable])


def counted(diagram: CertifiedDiagram, domains: Sequence[Domain]) -> int:
    """The same with numbers of any size."""
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


def members(diagram: CertifiedDiagram, domains: Sequence[Domain]) -> Iterator[dict[str, int]]:
    """The states of the set, one after the other."""
    return _members(diagram, domains, diagram.root, 0)


def _members(
    diagram: CertifiedDiagram, domains: Sequence[Domain], number: int, position: int
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
