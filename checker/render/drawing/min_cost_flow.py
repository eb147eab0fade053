"""Least total stretch under minimum distances: the linear programme behind ranks and coordinates.

Minimise the sum of ``weight * (y[v] - y[u])`` where every ``y[v] - y[u] >= gap``.  The dual is a
minimum-cost flow; the values are read off its residual network (Gansner et al., "A technique for
drawing directed graphs", 1993, solve the same programme).
"""

from collections import deque
from collections.abc import Iterable

import networkx as nx

Bound = tuple[int, int, int, int]
"""(u, v, gap, weight): v lies at least ``gap`` after u, and the distance costs ``weight`` per unit."""


def least_stretch(count: int, bounds: Iterable[Bound]) -> list[int]:
    """Optimal whole values of ``count`` unknowns, the smallest 0; free ones are put in the middle.

    Raises ``networkx.NetworkXUnbounded`` where the gaps contradict each other.
    """
    merged: dict[tuple[int, int], tuple[int, int]] = {}
    for u, v, gap, weight in bounds:
        old_gap, old_weight = merged.get((u, v), (gap, 0))
        merged[u, v] = max(gap, old_gap), weight + old_weight
    flow = _flow(count, merged)
    steps = [(u, v, gap) for (u, v), (gap, _) in merged.items()]
    steps += [(v, u, -gap) for (u, v), (gap, _) in merged.items() if flow[u].get(v, 0) > 0]
    low = _longest(count, steps, [0] * count)
    top = max(low, default=0)
    high = _longest(count, [(v, u, gap) for u, v, gap in steps], [-top] * count)
    return [(a - b) // 2 for a, b in zip(low, high, strict=True)]


def _flow(count: int, merged: dict[tuple[int, int], tuple[int, int]]) -> dict[int, dict[int, int]]:
    graph = nx.DiGraph()
    demand = [0] * count
    for (u, v), (gap, weight) in merged.items():
        graph.add_edge(u, v, weight=-gap)
        demand[u] -= weight
        demand[v] += weight
    for node in range(count):
        graph.add_node(node, demand=demand[node])
    flow: dict[int, dict[int, int]] = nx.network_simplex(graph)[1]
    return flow


def _longest(count: int, steps: list[tuple[int, int, int]], start: list[int]) -> list[int]:
    """The least values from ``start`` up that satisfy every step (Bellman-Ford with a queue)."""
    leaving: list[list[tuple[int, int]]] = [[] for _ in range(count)]
    for u, v, gap in steps:
        leaving[u].append((v, gap))
    values, queue, waiting = list(start), deque(range(count)), [True] * count
    while queue:
        u = queue.popleft()
        waiting[u] = False
        for v, gap in leaving[u]:
            if values[u] + gap > values[v]:
                values[v] = values[u] + gap
                if not waiting[v]:
                    waiting[v] = True
                    queue.append(v)
    return values
