"""A state graph drawn from left to right, starting with the initial nodes: boxes, lines and their labels."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from checker.render.drawing import svg
from checker.render.drawing.cuts import padded
from checker.render.drawing.graph import DrawnNode, Edge, PlacedNode, Point
from checker.render.drawing.layered import layered
from checker.render.drawing.ranking import backward
from checker.render.drawing.text import LINE, block, wrap
from checker.render.stategraph.rows import curve, in_rows, ranks, too_long
from checker.render.stategraph.words import behind, brief, example, short, ticks
from checker.results.graph import GraphEdge, GraphNode, StateGraph

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
    """The values, then the counts: of valuations, and of ticks that stay."""
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
