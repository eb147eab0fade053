"""A projected state graph as an SVG picture, laid out from left to right from the initial nodes."""

from checker.graph import GraphEdge, GraphNode, StateGraph, drawable
from checker.render.drawing import svg
from checker.render.drawing.cuts import padded
from checker.render.drawing.graph import Edge, Node, Placed, Point
from checker.render.drawing.layered import layered
from checker.render.drawing.ranking import backward
from checker.render.drawing.text import LINE, block, wrap
from spec_model.lang.chart import NOWHERE

NAME = "svg"
KIND = "graph"
SUFFIX = ".svg"
SUMMARY = "picture of a small projected graph; refuses what cannot be read"

MARGIN = 24
LABELLED = 80
"""With more edges than this the example inputs are left out of the picture, which then says so."""

STYLE = """
.node{fill:#fffdf6;stroke:#5b5b66;stroke-width:1.3}
.initial{stroke-width:2.6}
.loop{fill:#eef4ec}
.end{fill:#ececec}
.on-path{stroke:#b86a00;stroke-width:2.6}
.bad{fill:#ffd9d4;stroke:#c3241c;stroke-width:2.6}
.chart{font-size:17px;font-weight:bold;fill:#1d2433}
.value{fill:#1d2433}
.count,.note{fill:#6a7080}
.line{fill:none;stroke:#35507a;stroke-width:1.2}
.head{fill:#35507a}
.label{fill:#1f3558}
.fired .line{stroke:#c3241c;stroke-width:2.4}
.fired .head{fill:#c3241c}
"""
LEGEND = (
    "thick border: initial; green: in a cycle of several nodes; grey: never left; orange: on the run shown; "
    "red: violates; ×n: valuations behind a node, or steps behind an edge; labels: one example of inputs; "
    "↻: stays for some inputs; charts without an active state are left out"
)


def render(graph: StateGraph) -> str:
    """The picture.  Raises ``ModelError`` when it has more nodes than can be read."""
    drawable(graph)
    labels = {_name(e): _label(e) if len(graph.edges) <= LABELLED else () for e in graph.edges}
    placed, back = _placed(graph, labels)
    notes = [*wrap(graph.summary, 110), *(line for note in graph.notes for line in wrap(note, 110))]
    top = MARGIN + 20 + LINE * len(notes) + 14
    foot = list(wrap(LEGEND, max(60, placed.width // 7)))
    if not any(labels.values()) and graph.edges:
        foot.append(f"Example inputs are left out: {len(graph.edges)} edges; see the JSON export.")
    body = [svg.text(MARGIN, MARGIN + 14, graph.title, "chart")]
    body += svg.lines(MARGIN, MARGIN + 24, notes, "note")
    body.append(f'<g transform="translate({MARGIN},{top})">')
    body += [_drawn(graph, e, labels[_name(e)], placed, _name(e) in back) for e in graph.edges]
    body += [_box(graph, node, placed) for node in graph.nodes]
    body.append("</g>")
    body += svg.lines(MARGIN, top + placed.height + 18, foot, "note")
    wide = max(placed.width, 800) + 2 * MARGIN
    high = top + placed.height + 18 + LINE * len(foot) + MARGIN
    return svg.document(wide, high, STYLE, f"{graph.title}: state graph", body)


def _placed(graph: StateGraph, labels: dict[str, tuple[str, ...]]) -> tuple[Placed, frozenset[str]]:
    lines = [e for e in graph.edges if e.source != e.target]
    order = sorted(graph.nodes, key=lambda n: (not n.initial, n.number))
    back = backward(
        [str(n.number) for n in order],
        [(_name(e), str(e.source), str(e.target)) for e in lines],
        breadth=True,
    )
    nodes = [Node(str(n.number), *_size(graph, n)) for n in order]
    edges = [_edge(e, labels[_name(e)], _name(e) in back) for e in lines]
    return layered(nodes, edges), back


def _name(edge: GraphEdge) -> str:
    return f"{edge.source}>{edge.target}"


def _edge(edge: GraphEdge, label: tuple[str, ...], back: bool) -> Edge:
    tail, head = (edge.target, edge.source) if back else (edge.source, edge.target)
    return Edge(_name(edge), str(tail), str(head), padded(label))


def _label(edge: GraphEdge) -> tuple[str, ...]:
    """At most three lines of example inputs, the last ones read as they decide, and the number of steps."""
    lines = [line for part in edge.example.split(", ") for line in wrap(part, 34)]
    shown = lines if len(lines) <= 3 else [f"{len(lines) - 2} more …", *lines[-2:]]
    count = [f"×{edge.steps}"] * (edge.steps > 1)
    return (*shown[:-1], " ".join([*shown[-1:], *count])) if shown or count else ()


def _lines(graph: StateGraph, node: GraphNode) -> tuple[str, ...]:
    stays = any(e.source == e.target == node.number for e in graph.edges)
    values = [f"{n} = {v}" for n, v in zip(graph.variables, node.shown, strict=True) if v != NOWHERE]
    return (*(values or [NOWHERE]), f"×{node.valuations}{' ↻' if stays else ''}")


def _size(graph: StateGraph, node: GraphNode) -> tuple[int, int]:
    wide, high = block(_lines(graph, node))
    return wide + 20, high + 10


def _box(graph: StateGraph, node: GraphNode, placed: Placed) -> str:
    x, y = placed.nodes[str(node.number)]
    lines = _lines(graph, node)
    wide, high = _size(graph, node)[0], placed.heights[str(node.number)]
    rect = svg.tag("rect", x=x, y=y, width=wide, height=high, rx=6, class_=_classes(graph, node))
    texts = svg.lines(x + 10, y + 4, lines[:-1], "value")
    texts += svg.lines(x + 10, y + 4 + LINE * (len(lines) - 1), lines[-1:], "count")
    return rect + "".join(texts)


def _classes(graph: StateGraph, node: GraphNode) -> str:
    number = node.number
    flags = [
        ("initial", node.initial),
        ("loop", node.component in graph.components),
        ("end", number in graph.absorbing | graph.dead_ends),
        ("on-path", number in graph.path),
        ("bad", number in graph.bad),
    ]
    return " ".join(["node", *(name for name, given in flags if given)])


def _drawn(graph: StateGraph, edge: GraphEdge, label: tuple[str, ...], placed: Placed, back: bool) -> str:
    if edge.source == edge.target:
        return ""
    points: tuple[Point, ...] = placed.routes[_name(edge)]
    points = points[::-1] if back else points
    parts = [svg.tag("path", d=svg.path(points), class_="line")]
    parts.append(svg.tag("path", d=svg.arrow_head(points), class_="head"))
    if label:
        x, y = placed.labels[_name(edge)]
        parts += svg.lines(x + 5, y, label, "label")
    taken = (edge.source, edge.target) in set(zip(graph.path, graph.path[1:], strict=False))
    return svg.tag("g", "".join(parts), class_="fired" if taken else "edge")
