"""A layered layout of boxes and labelled lines, from left to right, with right-angled lines.

The steps of Sugiyama, Tagawa and Toda (1981): ranks, order in the ranks, coordinates, routes.
Labels take part as items of their own, so that nothing is ever drawn over them.
"""

import itertools
from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace

from checker.render.drawing.graph import Chain, DrawnNode, Edge, Item, PlacedNode, Point
from checker.render.drawing.ordering import untangled
from checker.render.drawing.placing import LEFT, RIGHT, Port, heights, room
from checker.render.drawing.ranking import chains, ranks
from checker.render.drawing.routing import MARGIN, TRACK, Jog, channel, tracks


def layered(
    nodes: Sequence[DrawnNode],
    edges: Sequence[Edge],
    first: Collection[str] = (),
    last: Collection[str] = (),
    upright: bool = False,
) -> PlacedNode:
    """Place the nodes and route the edges.

    The edges must be free of cycles; see ``ranking.backward``.  Nodes in ``first`` and ``last`` get
    the leftmost and the rightmost rank to themselves.  Nodes are made high enough for the lines that
    meet them and for their labels above them.  With ``upright``, meant to be mirrored, labels lie below
    their lines, and nodes are not made larger for them.
    """
    nodes = [_roomy(node, edges, not upright) for node in nodes]
    layers, links = chains(nodes, edges, ranks(nodes, edges, first, last), upright)
    layers = untangled(layers, links)
    y, met = heights(layers, links)
    jogs = _jogs(layers, links, y, met)
    used = [tracks(channel_jogs) for channel_jogs in jogs]
    columns = _columns(layers, used)
    return _placed(nodes, layers, links, y, met, used, columns)


def _roomy(node: DrawnNode, edges: Sequence[Edge], straight: bool) -> DrawnNode:
    """The node, made high enough for the lines that meet it."""
    leaving = [straight * e.label[1] for e in edges if e.tail == node.name and e.name not in node.ports]
    coming = [straight * e.label[1] for e in edges if e.head == node.name and e.name not in node.ports]
    if node.ports or (node.round and max(len(leaving), len(coming)) < 2):
        return node
    return replace(node, height=max(node.height, node.lead + max(room(leaving), room(coming))))


def _jogs(
    layers: Sequence[Sequence[Item]],
    links: Mapping[str, Chain],
    y: Mapping[Item, int],
    met: Mapping[Port, int],
) -> list[list[Jog]]:
    """The lines in the channel after each rank."""
    found: list[list[Jog]] = [[] for _ in layers]
    for name, chain in links.items():
        for a, b in itertools.pairwise(chain):
            start = met[a, name, RIGHT] if a.node else y[a]
            end = met[b, name, LEFT] if b.node else y[b]
            found[a.rank].append(Jog(name, start, end))
    return found


def _columns(layers: Sequence[Sequence[Item]], used: Sequence[dict[str, int]]) -> list[tuple[int, int]]:
    """The left end and the width of each rank's column."""
    columns: list[tuple[int, int]] = []
    x = 0
    for layer, taken in zip(layers, used, strict=True):
        wide = max((item.width for item in layer), default=0)
        columns.append((x, wide))
        x += wide + channel(taken)
    return columns


def _placed(
    nodes: Sequence[DrawnNode],
    layers: Sequence[Sequence[Item]],
    links: Mapping[str, Chain],
    y: Mapping[Item, int],
    met: Mapping[Port, int],
    used: Sequence[dict[str, int]],
    columns: Sequence[tuple[int, int]],
) -> PlacedNode:
    top = min((y[i] - i.above for layer in layers for i in layer), default=0)
    corner = {i: (_left(i, columns), y[i] - i.above - top) for layer in layers for i in layer}
    boxes = {i.node.name: corner[i] for layer in layers for i in layer if i.node}
    labels = {i.edge.name: corner[i] for layer in layers for i in layer if i.edge and i.labelled}
    routes = {
        name: tuple((x, v - top) for x, v in _route(name, chain, y, met, used, columns))
        for name, chain in links.items()
    }
    right = max((x + w for x, w in columns), default=0)
    bottom = max((y[i] + i.below for layer in layers for i in layer), default=0) - top
    return PlacedNode(boxes, {n.name: n.height for n in nodes}, labels, routes, right, bottom)


def _left(item: Item, columns: Sequence[tuple[int, int]]) -> int:
    x, wide = columns[item.rank]
    return x + (wide - item.width) // 2


def _route(
    name: str,
    chain: Chain,
    y: Mapping[Item, int],
    met: Mapping[Port, int],
    used: Sequence[dict[str, int]],
    columns: Sequence[tuple[int, int]],
) -> list[Point]:
    tail, head = chain[0], chain[-1]
    start, end = met[tail, name, RIGHT], met[head, name, LEFT]
    points = _stub(tail, y[tail], start, _left(tail, columns) + tail.width, 1)
    level = start
    for a, b in itertools.pairwise(chain):
        goal = end if b is head else y[b]
        if goal != level:
            x, wide = columns[a.rank]
            turn = x + wide + MARGIN + TRACK * used[a.rank][name]
            points += [(turn, level), (turn, goal)]
            level = goal
    return points + _stub(head, y[head], end, _left(head, columns), -1)[::-1]


def _stub(item: Item, top: int, at: int, side: int, outward: int) -> list[Point]:
    """Where a line leaves a node; from a round node it slants away from the centre first."""
    assert item.node is not None
    middle = top + item.node.height // 2
    if not item.node.round or at == middle:
        return [(side, at)]
    radius = item.width // 2
    centre = side - outward * radius
    dx, dy = outward * (radius + 6), at - middle
    length = max(1.0, float(dx * dx + dy * dy) ** 0.5)
    return [(centre + round(radius * dx / length), middle + round(radius * dy / length)), (centre + dx, at)]
