"""First steps of a layered layout: which arrows point back, the rank of each node, the items."""

from collections.abc import Collection, Mapping, Sequence

from rovercheck.checker.render.drawing.graph import Chain, DrawnNode, Edge, Item
from rovercheck.checker.render.drawing.min_cost_flow import Bound, least_stretch


def backward(
    nodes: Sequence[str], arrows: Sequence[tuple[str, str, str]], breadth: bool = False
) -> frozenset[str]:
    """Names of the arrows (name, source, target) to be drawn from right to left.

    They are those that lead back when the arrows are followed from the first node on, depth first
    (long chains run from left to right) or breadth first (near nodes stay near), in the order given.
    """
    leaving: dict[str, list[str]] = {n: [] for n in nodes}
    for _, source, target in arrows:
        leaving[source].append(target)
    place: dict[str, int] = {}
    for start in nodes:
        _breadth(start, leaving, place) if breadth else _depth(start, leaving, place)
    return frozenset(name for name, source, target in arrows if place[target] < place[source])


def _breadth(start: str, leaving: Mapping[str, list[str]], place: dict[str, int]) -> None:
    """Number what is reached from ``start`` in the order in which it is met."""
    queue = [] if start in place else [start]
    place.setdefault(start, len(place))
    for node in queue:
        for target in leaving[node]:
            if target not in place:
                place[target] = len(place)
                queue.append(target)


def _depth(start: str, leaving: Mapping[str, list[str]], place: dict[str, int]) -> None:
    """Number what is reached from ``start`` downwards, a node after all it leads to."""
    if start in place:
        return
    stack, met = [(start, iter(leaving[start]))], {start}
    while stack:
        node, rest = stack[-1]
        following = next((t for t in rest if t not in met and t not in place), None)
        if following is None:
            stack.pop()
            place[node] = -len(place)
        else:
            met.add(following)
            stack.append((following, iter(leaving[following])))


def ranks(
    nodes: Sequence[DrawnNode], edges: Sequence[Edge], first: Collection[str], last: Collection[str]
) -> dict[str, int]:
    """The rank of each node from 0; labels get a rank of their own between two nodes."""
    number = {node.name: i for i, node in enumerate(nodes)}
    start, end = len(nodes), len(nodes) + 1
    bounds: list[Bound] = [(start, end, 0, 1)]
    for edge in edges:
        span = 2 if any(edge.label) else 1
        bounds.append((number[edge.tail], number[edge.head], span, edge.weight))
    for node in nodes:
        u = number[node.name]
        bounds.append((start, u, 0 if node.name in first else bool(first), 0))
        bounds.append((u, end, 0 if node.name in last else bool(last), 0))
        bounds += [(u, start, 0, 1)] if node.name in first else []
        bounds += [(end, u, 0, 1)] if node.name in last else []
    found = _packed(least_stretch(len(nodes) + 2, bounds)[: len(nodes)])
    return {node.name: rank for node, rank in zip(nodes, found, strict=True)}


def _packed(values: list[int]) -> list[int]:
    low = min(values, default=0)
    return [v - low for v in values]


def chains(
    nodes: Sequence[DrawnNode], edges: Sequence[Edge], rank: Mapping[str, int], under: bool = False
) -> tuple[list[list[Item]], dict[str, Chain]]:
    """The items of each rank in a first order, and the chain of each edge by name.

    Labels lie above their lines, or ``under`` them.
    """
    layers: list[list[Item]] = [[] for _ in range(max(rank.values(), default=-1) + 1)]
    item = {n.name: Item(rank[n.name], n.width, 0, n.height, node=n) for n in nodes}
    for node in nodes:
        layers[rank[node.name]].append(item[node.name])
    wide = [max((i.width for i in layer), default=0) for layer in layers]
    made: dict[str, Chain] = {}
    for edge in edges:
        points = _points(edge, range(rank[edge.tail] + 1, rank[edge.head]), wide, under)
        for point in points:
            layers[point.rank].append(point)
        made[edge.name] = [item[edge.tail], *points, item[edge.head]]
    return layers, made


def _points(edge: Edge, between: range, wide: Sequence[int], under: bool) -> list[Item]:
    """One item per rank passed; the label sits where a column is wide enough already, or midway."""
    points = [Item(r, 0, 0, 0, edge=edge) for r in between]
    if any(edge.label):
        middle = (between.start + between.stop - 1) / 2
        seat = min(points, key=lambda p: (wide[p.rank] < edge.label[0], abs(p.rank - middle), p.rank))
        seat.width, seat.labelled = edge.label[0], True
        seat.above, seat.below = (0, edge.label[1]) if under else (edge.label[1], 0)
    return points
