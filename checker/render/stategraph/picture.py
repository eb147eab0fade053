"""A state graph drawn from left to right, starting with the initial nodes: boxes, lines and their labels."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import ceil, hypot

from rovercheck.checker.render.drawing import svg
from rovercheck.checker.render.drawing.cuts import padded
from rovercheck.checker.render.drawing.graph import DrawnNode, Edge, PlacedNode, Point
from rovercheck.checker.render.drawing.layered_layout import layered
from rovercheck.checker.render.drawing.ranks import backward
from rovercheck.checker.render.drawing.text import LINE, block, wrap
from rovercheck.checker.render.stategraph.words import behind, brief, example, short, ticks
from rovercheck.checker.results.graph import GraphEdge, GraphNode, StateGraph

# --- A quick layout for graphs that are long or dense --------------------------------------------------

GAP_X, GAP_Y, ROW = 56, 16, 46
"""Pixels between columns, between boxes of a column, and between rows."""
LONG = 26
"""Ranks from which on a graph is laid out in rows."""
DENSE = 900
"""Ranks that all lines cross together from which on it is, too."""
SHAPE = 1.7
"""Width of the picture for its height."""

Sizes = Mapping[int, tuple[int, int]]


@dataclass(frozen=True)
class GraphRows:
    """The top-left corner of each box, and the whole size."""

    at: Mapping[int, tuple[int, int]]
    width: int
    height: int


def ranks(graph: StateGraph) -> list[int]:
    """The edges from an initial node to each node, on the shortest way."""
    following: dict[int, list[int]] = {}
    for edge in graph.edges:
        following.setdefault(edge.source, []).append(edge.target)
    level = [n.number for n in graph.nodes if n.initial]
    found = dict.fromkeys(level, 0)
    rank = 0
    while level:
        rank += 1
        after = [t for n in level for t in following.get(n, ()) if t not in found]
        level = list(dict.fromkeys(after))
        found |= dict.fromkeys(level, rank)
    return [found.get(n.number, 0) for n in graph.nodes]


def too_long(graph: StateGraph) -> bool:
    """Whether the layered layout would take too long, or too much room."""
    rank = ranks(graph)
    crossed = sum(abs(rank[e.source] - rank[e.target]) for e in graph.edges)
    return max(rank, default=0) >= LONG or crossed >= DENSE


def in_rows(graph: StateGraph, sizes: Sizes) -> GraphRows:
    """Columns of boxes, as many beside each other as make the picture neither wide nor high.

    A rank of very many boxes has several columns.
    """
    most = max(8, ceil(len(graph.nodes) ** 0.5))
    columns = [one[i : i + most] for one in _ordered(graph) for i in range(0, len(one), most)]
    wide = [max(sizes[n][0] for n in column) + GAP_X for column in columns]
    high = [sum(sizes[n][1] + GAP_Y for n in column) for column in columns]
    room = max(max(wide, default=0), (sum(w * h for w, h in zip(wide, high, strict=True)) * SHAPE) ** 0.5)
    at: dict[int, tuple[int, int]] = {}
    x = y = below = right = 0
    for column, width, height in zip(columns, wide, high, strict=True):
        if x and x + width > ceil(room * 1.1):
            x, y = 0, y + below + ROW
            below = 0
        top = y
        for number in column:
            at[number] = x, top
            top += sizes[number][1] + GAP_Y
        x, below, right = x + width, max(below, height), max(right, x + width)
    return GraphRows(at, right, y + below)


def _ordered(graph: StateGraph) -> list[list[int]]:
    """The nodes by rank; those of a rank by where their neighbours in the rank before are."""
    rank = ranks(graph)
    columns: list[list[int]] = [[] for _ in range(max(rank, default=0) + 1)]
    for node in graph.nodes:
        columns[rank[node.number]].append(node.number)
    before: dict[int, list[int]] = {}
    for edge in graph.edges:
        if rank[edge.source] == rank[edge.target] - 1:
            before.setdefault(edge.target, []).append(edge.source)
    for previous, column in pairwise(columns):
        place = {number: i for i, number in enumerate(previous)}
        means = {n: sum(place[m] for m in before[n]) / len(before[n]) for n in column if n in before}
        column.sort(key=lambda n: (means.get(n, 0.0), n))
    return columns


def curve(
    source: tuple[int, int, int, int], target: tuple[int, int, int, int]
) -> tuple[str, Sequence[tuple[int, int]]]:
    """The ``d`` of a curve between two boxes (x, y, width, height), and its last stretch, for the head."""
    sx, sy, sw, sh = source
    tx, ty, tw, th = target
    if tx >= sx + sw:  # forward: from the right side to the left side
        a, b = (sx + sw, sy + sh // 2), (tx, ty + th // 2)
        bend = max(24, (b[0] - a[0]) // 2)
        c, d = (a[0] + bend, a[1]), (b[0] - bend, b[1])
    elif abs(ty - sy) < max(sh, th):  # back in the same row: below both
        a, b = (sx + sw // 2, sy + sh), (tx + tw // 2, ty + th)
        depth = 20 + min(60, abs(sx - tx) // 14)
        c, d = (a[0], a[1] + depth), (b[0], b[1] + depth)
    else:
        down = ty > sy
        a = (sx + sw // 2, sy + sh if down else sy)
        b = (tx + tw // 2, ty if down else ty + th)
        bend = (1 if down else -1) * max(20, abs(b[1] - a[1]) // 3)
        c, d = (a[0], a[1] + bend), (b[0], b[1] - bend)
    length = max(1.0, hypot(b[0] - d[0], b[1] - d[1]))
    last = round(b[0] - 20 * (b[0] - d[0]) / length), round(b[1] - 20 * (b[1] - d[1]) / length)
    return f"M{a[0]} {a[1]}C{c[0]} {c[1]} {d[0]} {d[1]} {b[0]} {b[1]}", (last, b)


LABELLED = 48
"""With more edges than this the example inputs are left out of the picture."""
WIDEST = 34
"""Characters in a line of a label."""

FAR = 2
"""Ranks beyond which a line of a long graph is drawn faintly."""

Labels = Mapping[str, tuple[str, ...]]


@dataclass(frozen=True)
class Picture:
    """The drawn elements, and the size of all of them; ``labelled``: edges show their example inputs."""

    body: tuple[str, ...]
    width: int
    height: int
    labelled: bool


def drawn(graph: StateGraph, labelled: int = LABELLED) -> Picture:
    """The picture; edges have labels where there are at most ``labelled`` of them."""
    if too_long(graph):
        return _in_rows(graph)
    all_ = len(graph.edges) <= labelled
    labels = {_name(e): _label(graph, e, all_) for e in graph.edges}
    placed, back = _placed(graph, labels)
    body = [_line(graph, e, labels[_name(e)], placed, _name(e) in back) for e in graph.edges]
    for node in graph.nodes:
        name = str(node.number)
        body.append(_box(graph, node, placed.nodes[name], placed.heights[name]))
    return Picture(tuple(filter(None, body)), placed.width, placed.height, all_)


def _in_rows(graph: StateGraph) -> Picture:
    """The picture of a long or dense graph, without labels on its lines but for the run."""
    sizes = {n.number: _size(graph, n) for n in graph.nodes}
    rows, rank = in_rows(graph, sizes), ranks(graph)
    body = []
    for edge in graph.edges:
        if edge.source != edge.target:
            ends = ((*rows.at[n], *sizes[n]) for n in (edge.source, edge.target))
            d, last = curve(*ends)
            far = abs(rank[edge.source] - rank[edge.target]) > FAR
            body.append(_edge_of(graph, edge, d, last, [], far))
    body += [_box(graph, n, rows.at[n.number], sizes[n.number][1]) for n in graph.nodes]
    return Picture(tuple(body), rows.width, rows.height, False)


def _placed(graph: StateGraph, labels: Labels) -> tuple[PlacedNode, frozenset[str]]:
    lines = [e for e in graph.edges if e.source != e.target]
    order = sorted(graph.nodes, key=lambda n: (not n.initial, n.depth, n.number))
    back = backward(
        [str(n.number) for n in order],
        [(_name(e), str(e.source), str(e.target)) for e in lines],
        breadth=True,
    )
    nodes = [DrawnNode(str(n.number), *_size(graph, n)) for n in order]
    edges = [_edge(e, labels[_name(e)], _name(e) in back) for e in lines]
    return layered(nodes, edges), back


def _name(edge: GraphEdge) -> str:
    return f"{edge.source}>{edge.target}"


def _edge(edge: GraphEdge, label: tuple[str, ...], back: bool) -> Edge:
    tail, head = (edge.target, edge.source) if back else (edge.source, edge.target)
    return Edge(_name(edge), str(tail), str(head), padded(label))


def _label(graph: StateGraph, edge: GraphEdge, all_: bool) -> tuple[str, ...]:
    """At most three lines of example inputs, the number of pairs, and when the run takes the edge."""
    lines = [line for part in example(edge) for line in wrap(brief(part), WIDEST)] if all_ else []
    shown = lines if len(lines) <= 3 else [*lines[:2], f"{len(lines) - 2} more …"]
    count = f"×{edge.steps:,}" if edge.steps > 1 and all_ else ""
    when = wrap(ticks(graph, edge.source, edge.target), WIDEST)
    if count and shown and len(shown[-1]) + len(count) < WIDEST:
        shown, count = [*shown[:-1], f"{shown[-1]}  {count}"], ""
    return (*shown, *filter(None, [count]), *when)


def _lines(graph: StateGraph, node: GraphNode) -> tuple[str, ...]:
    """The values, then the counts: of states, and of ticks that stay."""
    own = next((e for e in graph.edges if e.source == e.target == node.number), None)
    values = tuple(line for value in short(graph, node) for line in wrap(value, WIDEST, "  "))
    if own is None:
        return (*values, behind(graph, node))
    mark = "↻" if (own.source, own.target) in graph.sure else "(↻)"
    when = ticks(graph, own.source, own.target)
    stays = f"{mark} ×{own.steps:,}" if own.steps > 1 else mark
    return (*values, f"{behind(graph, node)}  {stays}", *wrap(f"↻ {when}" if when else "", WIDEST))


def _counted(graph: StateGraph, node: GraphNode) -> int:
    """How many of the lines are values."""
    return sum(len(wrap(value, WIDEST, "  ")) for value in short(graph, node))


def _size(graph: StateGraph, node: GraphNode) -> tuple[int, int]:
    wide, high = block(_lines(graph, node))
    return wide + 20, high + 10


def _box(graph: StateGraph, node: GraphNode, at: Point, high: int) -> str:
    (x, y), wide = at, _size(graph, node)[0]
    lines, split = _lines(graph, node), _counted(graph, node)
    parts = [svg.tag("rect", x=x, y=y, width=wide, height=high, rx=6, class_="box")]
    if node.dead:
        parts.append(svg.tag("rect", x=x + 3, y=y + 3, width=wide - 6, height=high - 6, rx=4, class_="inner"))
    parts += svg.lines(x + 10, y + 4, lines[:split], "value")
    parts += svg.lines(x + 10, y + 4 + LINE * split, lines[split:], "count")
    return svg.tag("g", "".join(parts), class_=_classes(graph, node), data_node=node.number)


def _classes(graph: StateGraph, node: GraphNode) -> str:
    number = node.number
    flags = [
        ("initial", node.initial),
        ("loop", node.component in graph.components),
        ("end", number in graph.absorbing | graph.dead_ends),
        ("open", node.unexpanded > 0),
        ("on-path", number in graph.path),
        ("bad", number in graph.bad),
    ]
    return " ".join(["node", *(name for name, given in flags if given)])


def _line(graph: StateGraph, edge: GraphEdge, label: tuple[str, ...], placed: PlacedNode, back: bool) -> str:
    if edge.source == edge.target:
        return ""
    points: tuple[Point, ...] = placed.routes[_name(edge)]
    points = points[::-1] if back else points
    shown = []
    if label:
        x, y = placed.labels[_name(edge)]
        shown = svg.lines(x + 5, y, label, "label")
    return _edge_of(graph, edge, svg.path(points), points, shown)


def _edge_of(
    graph: StateGraph,
    edge: GraphEdge,
    d: str,
    points: Sequence[Point],
    label: Sequence[str],
    far: bool = False,
) -> str:
    parts = [svg.tag("path", d=d, class_="line"), svg.tag("path", d=svg.arrow_head(points), class_="head")]
    ends = edge.source, edge.target
    flags = ["edge", *["some"] * (ends not in graph.sure), *["far"] * far, *["fired"] * (ends in graph.taken)]
    return svg.tag(
        "g",
        "".join([*parts, *label]),
        class_=" ".join(flags),
        data_source=edge.source,
        data_target=edge.target,
    )
