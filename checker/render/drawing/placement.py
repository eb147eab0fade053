"""Third step of a layered layout: how high everything lies, so that lines are short and straight."""

import itertools
from collections.abc import Mapping, Sequence

from rovercheck.checker.render.drawing.graph import Chain, DrawnNode, Item
from rovercheck.checker.render.drawing.min_cost_flow import Bound, least_stretch

PITCH = 18
"""Least distance between two lines that meet one side of a node, in pixels."""

EDGE = 11
"""Least distance between such a line and the corner of the node, in pixels."""

LEFT, RIGHT = 0, 1

Port = tuple[Item, str, int]
"""A node's item, an edge and the side of the node on which they meet."""

Place = tuple[int, int]
"""An unknown and a distance to be added to it."""


def room(labels: Sequence[int]) -> int:
    """The height a node needs for lines with labels of these heights on one side, in pixels."""
    return sum(max(PITCH, label + 10) for label in labels[1:]) + 2 * EDGE if labels else 0


class _Places:
    """The unknowns of the linear programme and its bounds, while they are collected."""

    def __init__(self, layers: Sequence[Sequence[Item]]) -> None:
        self.of: dict[Item, int] = {item: i for i, item in enumerate(i for layer in layers for i in layer)}
        self.count = len(self.of)
        self.bounds: list[Bound] = []
        self.ports: dict[Port, Place] = {}

    def new(self) -> int:
        self.count += 1
        return self.count - 1


def heights(
    layers: Sequence[Sequence[Item]], chains: Mapping[str, Chain]
) -> tuple[dict[Item, int], dict[Port, int]]:
    """The top of each node, the line of each other item, and where each edge meets its nodes."""
    places = _Places(layers)
    for layer in layers:
        for upper, lower in itertools.pairwise(layer):
            gap = upper.below + _gap(upper, lower) + lower.above
            places.bounds.append((places.of[upper], places.of[lower], gap, 0))
    _ports(places, layers, chains)
    for name, chain in chains.items():
        for a, b in itertools.pairwise(chain):
            _straighten(places, a, b, name)
    values = least_stretch(places.count, places.bounds)
    met = {port: values[u] + offset for port, (u, offset) in places.ports.items()}
    return {item: values[u] for item, u in places.of.items()}, met


def _gap(upper: Item, lower: Item) -> int:
    nodes = (upper.node is not None) + (lower.node is not None)
    return (10, 16, 26)[nodes]


def _ports(places: _Places, layers: Sequence[Sequence[Item]], chains: Mapping[str, Chain]) -> None:
    index = {item: i for layer in layers for i, item in enumerate(layer)}
    sides: dict[tuple[Item, int], list[tuple[float, str]]] = {}
    for name, chain in chains.items():
        head, tail = chain[-1], chain[0]
        sides.setdefault((tail, RIGHT), []).append((_aim(chain[1], name, index), name))
        sides.setdefault((head, LEFT), []).append((_aim(chain[-2], name, index), name))
    for (item, side), ends in sides.items():
        assert item.node is not None
        names = [name for _, name in sorted(ends, key=lambda end: end[0])]
        _side(places, item, item.node, side, names)


def _aim(item: Item, edge: str, index: Mapping[Item, int]) -> float:
    node = item.node
    return index[item] + (node.ports[edge] / (node.height + 1) if node and edge in node.ports else 0.5)


def _side(places: _Places, item: Item, node: DrawnNode, side: int, names: Sequence[str]) -> None:
    """Lines with a port of their own meet the node there; the others above those, in order."""
    top = places.of[item]
    fixed = [n for n in names if n in node.ports]
    free = [n for n in names if n not in node.ports]
    for name in fixed:
        places.ports[item, name, side] = (top, node.ports[name])
    if node.round and len(free) == 1:
        places.ports[item, free[0], side] = (top, node.height // 2)
        return
    limit = min((node.ports[n] for n in fixed), default=node.height - EDGE + PITCH)
    before: int | None = None
    for name in free:
        port = places.new()
        places.ports[item, name, side] = (port, 0)
        places.bounds.append((top, port, node.lead + EDGE, 0) if before is None else (before, port, PITCH, 0))
        before = port
    if before is not None:
        places.bounds.append((before, top, PITCH - limit, 0))


def _straighten(places: _Places, a: Item, b: Item, edge: str) -> None:
    (u, du), (v, dv) = _end(places, a, edge, RIGHT), _end(places, b, edge, LEFT)
    weight = (1, 2, 8)[(a.node is None) + (b.node is None)]
    low = places.new()
    places.bounds += [(low, u, -du, weight), (low, v, -dv, weight)]


def _end(places: _Places, item: Item, edge: str, side: int) -> Place:
    return places.ports[item, edge, side] if item.node is not None else (places.of[item], 0)
