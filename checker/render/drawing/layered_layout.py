"""A layered layout of boxes and labelled lines, from left to right, with right-angled lines.

The steps of Sugiyama, Tagawa and Toda (1981): ranks, order in the ranks, coordinates, routes.
Labels take part as items of their own, so that nothing is ever drawn over them.
"""

import itertools
from bisect import bisect_right, insort
from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace

from rovercheck.checker.render.drawing.graph import Chain, DrawnNode, Edge, Item, PlacedNode, Point
from rovercheck.checker.render.drawing.placement import LEFT, RIGHT, Port, heights, room
from rovercheck.checker.render.drawing.ranks import chains, ranks
from rovercheck.checker.render.drawing.routing import MARGIN, TRACK, Jog, channel, tracks

# --- second step of a layered layout -------------------------------------------------------------------

SWEEPS = 24

Layers = list[list[Item]]
Links = dict[Item, list[tuple[Item, float, float]]]
"""For an item its neighbours in the next rank: the neighbour, and where each end meets its item (0..1)."""


def untangled(layers: Layers, chains: Mapping[str, Chain]) -> Layers:
    """The layers in the best order found: barycentre sweeps in both directions, then exchanges."""
    right, left = links(chains)
    best, fewest = [list(layer) for layer in layers], crossings(layers, right)
    current = best
    for sweep in range(SWEEPS):
        if fewest == 0:
            break
        current = [list(layer) for layer in (best if sweep % 8 == 0 else current)]
        _sweep(current, right if sweep % 2 else left, backwards=bool(sweep % 2))
        _exchange(current, right, left)
        count = crossings(current, right)
        if count < fewest:
            best, fewest = [list(layer) for layer in current], count
    return best


def links(chains: Mapping[str, Chain]) -> tuple[Links, Links]:
    """The neighbours of each item in the next rank, and in the rank before."""
    right: Links = {}
    left: Links = {}
    for name, chain in chains.items():
        for a, b in itertools.pairwise(chain):
            pa, pb = _meets(a, name), _meets(b, name)
            right.setdefault(a, []).append((b, pa, pb))
            left.setdefault(b, []).append((a, pb, pa))
    return right, left


def _meets(item: Item, edge: str) -> float:
    if item.node is None or edge not in item.node.ports:
        return 0.5
    return min(0.95, max(0.05, item.node.ports[edge] / max(1, item.node.height)))


def _index(layer: Sequence[Item]) -> dict[Item, int]:
    return {item: i for i, item in enumerate(layer)}


def crossings(layers: Layers, right: Links) -> int:
    """The number of pairs of lines that cross between neighbouring ranks."""
    total = 0
    for layer, following in itertools.pairwise(layers):
        place = _index(following)
        lines = sorted((i + pa, place[b] + pb) for i, a in enumerate(layer) for b, pa, pb in right.get(a, ()))
        seen: list[float] = []
        for _, end in lines:
            total += len(seen) - bisect_right(seen, end)
            insort(seen, end)
    return total


def _sweep(layers: Layers, towards: Links, backwards: bool) -> None:
    numbers = range(len(layers) - 2, -1, -1) if backwards else range(1, len(layers))
    for number in numbers:
        fixed = _index(layers[number + (1 if backwards else -1)])
        key: dict[Item, float] = {}
        for i, item in enumerate(layers[number]):
            ends = [fixed[b] + pb - pa + 0.5 for b, pa, pb in towards.get(item, ())]
            key[item] = sum(ends) / len(ends) if ends else float(i)
        layers[number].sort(key=key.__getitem__)


def _exchange(layers: Layers, right: Links, left: Links) -> None:
    """Swap neighbours in a rank as long as that removes crossings."""
    index: dict[Item, int] = {}
    for layer in layers:
        index |= _index(layer)
    for _ in range(4):
        swapped = False
        for layer in layers:
            for i in range(len(layer) - 1):
                a, b = layer[i], layer[i + 1]
                gain = _between(a, b, right, left, index) - _between(b, a, right, left, index)
                if gain > 0:
                    layer[i], layer[i + 1] = b, a
                    index[a], index[b] = i + 1, i
                    swapped = True
        if not swapped:
            return


def _between(upper: Item, lower: Item, right: Links, left: Links, index: Mapping[Item, int]) -> int:
    """Crossings among the lines of two items when ``upper`` lies above ``lower``."""
    total = 0
    for side in (right, left):
        ends = sorted(index[b] + pb for b, _, pb in side.get(lower, ()))
        for b, _, pb in side.get(upper, ()):
            total += bisect_right(ends, index[b] + pb - 1e-9)
    return total


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
