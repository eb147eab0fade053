"""The projection of what was explored: nodes, edges, how many states and ticks are behind them.

Whether it is exact is decided by counting: an edge is sure if as many states have it as there are
behind its source.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np

from rovercheck.checker.explore.graphs.reachable_ticks import ReachableTicks
from rovercheck.checker.explore.graphs.row_numbers import Numbers, numbered
from rovercheck.checker.results.graph import GraphEdge, GraphNode, StateGraph
from rovercheck.spec_model.lang.domain import Enum
from rovercheck.spec_model.lang.expr import Var

Inputs = Callable[[int, int], Mapping[str, int]]
"""Inputs with which a tick leads from one state to another."""

TRIED = 30_000_000
"""Pairs of states looked at to find what would make a projection exact."""
FEW = 16
"""Values that a number may have for those never reached to be named."""


@dataclass(frozen=True, eq=False)
class Projection:
    """The node of each state; the nodes by their first state; the edges, joined pairs by edge.

    ``edge`` has the number of the edge of each pair; an edge is shown by its first pair, ``example``.
    """

    node: Numbers
    first: Numbers
    behind: Numbers
    edge: Numbers
    example: Numbers
    ends: tuple[Numbers, Numbers]
    steps: Numbers
    sources: Numbers

    @property
    def mixes(self) -> bool:
        """Whether states behind a node can go to different nodes."""
        return bool((self.sources < self.behind[self.ends[0]]).any())


def projection(explored: ReachableTicks, columns: Sequence[Numbers]) -> Projection:
    """States that agree in the columns are one node."""
    first, node = numbered(columns, len(explored))
    ends = node[explored.sources], node[explored.targets]
    example, edge = numbered(ends, len(explored.sources))
    once, _ = numbered((explored.sources, ends[1]), len(explored.sources))
    return Projection(
        node, first, np.bincount(node, minlength=len(first)), edge, example,
        (ends[0][example], ends[1][example]), np.bincount(edge, minlength=len(example)),
        np.bincount(edge[once], minlength=len(example)),
    )  # fmt: skip


def project(
    title: str,
    explored: ReachableTicks,
    onto: Sequence[str],
    show: Callable[[int, int], str],
    wanted: Sequence[str] = (),
) -> StateGraph:
    """The graph on the variables named ``onto``.

    ``show`` describes the inputs of a tick between two states; a state is marked in which one
    of the variables ``wanted`` is 1.  Raises ``ModelError`` for an unknown name.
    """
    found = projection(explored, [explored.column(name) for name in onto])
    by_name = {v.name: v for v in explored.variables}
    chosen = [by_name[name] for name in onto]
    nodes = _nodes(explored, found, chosen, wanted)
    pairs = zip(*(ends.tolist() for ends in found.ends), strict=True)
    edges = [
        GraphEdge(source, target, int(steps), show(*_ends(explored, example)), int(sources))
        for (source, target), steps, example, sources in zip(
            pairs, found.steps, found.example, found.sources, strict=True
        )
    ]
    return StateGraph(
        title, tuple(onto), nodes, tuple(sorted(edges, key=lambda e: (e.source, e.target))), len(explored),
        cut=explored.stopped, depth=int(explored.depths.max(initial=0)),
        bad=frozenset(n.number for n in nodes if n.wanted), never=_never(chosen, nodes),
        exact_with=exact_with(explored, onto) if found.mixes and not explored.stopped else (),
    )  # fmt: skip


def _ends(explored: ReachableTicks, pair: int) -> tuple[int, int]:
    return int(explored.sources[pair]), int(explored.targets[pair])


def _nodes(
    explored: ReachableTicks, found: Projection, chosen: Sequence[Var], wanted: Sequence[str]
) -> tuple[GraphNode, ...]:
    count = len(found.first)
    marked = found.node[explored.any_of(wanted)]
    per_node = (
        found.behind,
        np.bincount(marked, minlength=count),
        np.bincount(found.node[explored.dead], minlength=count),
        np.bincount(found.node[explored.expanded :], minlength=count),
    )
    counts = [tuple(int(column[n]) for column in per_node) for n in range(count)]
    starts = set(found.node[: explored.initial].tolist())
    component = _components(count, found.ends)
    nodes = []
    for number, first in enumerate(found.first.tolist()):
        at = explored.at(first)
        raw = tuple(at[v.name] for v in chosen)
        shown = tuple(v.domain.show(x) for v, x in zip(chosen, raw, strict=True))
        behind, bad, dead, unexpanded = counts[number]
        depth = int(explored.depths[first])
        node = GraphNode(
            number, raw, shown, behind, number in starts, component[number], depth, bad, dead, unexpanded
        )
        nodes.append(node)
    return tuple(nodes)


def _components(count: int, ends: tuple[Numbers, Numbers]) -> list[int]:
    """The number of the strongly connected component of each node."""
    import networkx as nx  # 0.1 s that other commands need not wait for

    plain: nx.DiGraph[int] = nx.DiGraph()
    plain.add_nodes_from(range(count))
    plain.add_edges_from(zip(*(e.tolist() for e in ends), strict=True))
    component = [0] * count
    for number, members in enumerate(sorted(map(sorted, nx.strongly_connected_components(plain)))):
        for member in members:
            component[member] = number
    return component


def _never(chosen: Sequence[Var], nodes: Sequence[GraphNode]) -> dict[str, tuple[str, ...]]:
    """Values of each variable that no node has, where they have names or are few."""
    found: dict[str, tuple[str, ...]] = {}
    for place, var in enumerate(chosen):
        reached = {node.raw[place] for node in nodes}
        if isinstance(var.sort, Enum) or len(var.domain) <= FEW:
            left = tuple(var.domain.show(raw) for raw in var.domain.values if raw not in reached)
            found |= {var.name: left} if left else {}
    return found


def exact_with(
    explored: ReachableTicks, onto: Sequence[str], tried: int = TRIED
) -> tuple[tuple[tuple[str, ...], int], ...]:
    """One or two variables with which the projection would mix nothing, and the nodes it would have.

    Those with fewest nodes first; none if two do not suffice, or if looking would cost too much.
    """
    own = [explored.column(name) for name in onto]
    others = [v.name for v in explored.variables if v.name not in onto and len(v.domain) > 1]
    cost = max(1, len(explored.sources))
    for size in (1, 2):
        groups = list(combinations(others, size))
        if cost * len(groups) > tried:
            return ()
        found = []
        for group in groups:
            seen = projection(explored, [*own, *(explored.column(name) for name in group)])
            if not seen.mixes:
                found.append((group, len(seen.first)))
        if found:
            return tuple(sorted(found, key=lambda f: (f[1], f[0])))
    return ()
