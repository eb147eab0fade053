"""A state graph as a part of a page: a picture to move about in, and what is behind each node."""

from collections.abc import Mapping, Sequence
from importlib.resources import files
from typing import Any

from markupsafe import Markup

from rovercheck.checker.render import story
from rovercheck.checker.render.page import Part, data, templates
from rovercheck.checker.render.stategraph.findings import findings
from rovercheck.checker.render.stategraph.picture import LABELLED, drawn
from rovercheck.checker.render.stategraph.words import LEGEND, named, values
from rovercheck.checker.results.graph import GraphNode, GraphWay, StateGraph

TEMPLATES = templates("stategraph")
PANZOOM = (
    files("rovercheck.checker.render")
    .joinpath("vendor", "panzoom", "panzoom.min.js")
    .read_text(encoding="utf-8")
)
MOST_ROWS = 120
"""Rows of a run that are shown; the page says how many it leaves out."""


def own(name: str) -> str:
    """The text of a file beside this one."""
    return files(__name__.rpartition(".")[0]).joinpath(name).read_text(encoding="utf-8")


Row = tuple[str, str, list[str]]
"""Ticks, milliseconds, and what happened."""


BESIDE = 12
"""Edges with labels in a picture among others, which has to be read without zooming."""
STYLES = (own("stategraph.css"),)
SCRIPTS = (PANZOOM, own("stategraph.js"))
TRUST = ("size", "kind", "because")
"""Headings of what ``trust`` says, too, or what is said of it elsewhere."""


def trust(graph: StateGraph) -> Part:
    """How far the graph can be trusted, in sentences."""
    return _words("trust.html", graph)


def shows(graph: StateGraph) -> Part:
    """What the graph shows, in sentences, without how large it is and how far it can be trusted."""
    return _words("findings.html", graph, findings=[f for f in findings(graph) if f[0] not in TRUST])


def _words(template: str, graph: StateGraph, **more: object) -> Part:
    body = TEMPLATES.get_template(template).render(graph=graph, **more)
    return Part(Markup('<div class="sg-words">\n{}</div>').format(Markup(body)), STYLES)


def part(graph: StateGraph, runs: Mapping[str, Sequence[int]] = {}, alone: bool = True) -> Part:
    """The picture; nodes can be searched for, chosen and filtered.

    ``runs`` are sequences of nodes by the names of their traces; the reader chooses which one is shown.
    ``alone``: with its title and all that is said of it.
    """
    picture = drawn(graph, LABELLED if alone else BESIDE)
    body = TEMPLATES.get_template("stategraph.html").render(
        graph=graph,
        findings=findings(graph),
        alone=alone,
        runs=list(runs),
        picture=Markup("\n".join(picture.body)),
        width=picture.width,
        height=picture.height,
        labelled=picture.labelled,
        legend=LEGEND,
        filters=_filters(graph),
        rows=[(node, ", ".join(values(graph, node)), _flags(graph, node)) for node in graph.nodes],
        data=data(document(graph) | {"runs": runs}, "stategraph-data"),
    )
    return Part(Markup(body), STYLES, SCRIPTS)


def document(graph: StateGraph) -> dict[str, Any]:
    """What the script needs to know of nodes and edges."""
    return {
        "nodes": [_node(graph, node) for node in graph.nodes],
        "edges": [
            {"from": e.source, "to": e.target, "steps": e.steps, "sources": e.sources,
             "sure": (e.source, e.target) in graph.sure, "inputs": e.example,
             "ticks": list(graph.taken.get((e.source, e.target), ()))}
            for e in graph.edges
        ],
        "path": list(graph.path),
        "filters": _parts(graph),
    }  # fmt: skip


def _node(graph: StateGraph, node: GraphNode) -> dict[str, Any]:
    way = graph.ways.get(node.number)
    return {
        "name": named(graph, node.number),
        "values": list(zip(graph.variables, node.shown, strict=True)),
        "valuations": node.valuations,
        "depth": node.depth,
        "flags": _flags(graph, node),
        "component": node.component,
        "size": len(graph.members(node.component)),
        "wanted": node.wanted,
        "dead": node.dead,
        "unexpanded": node.unexpanded,
        "example": list(way.valuation) if way else [],
        "way": rows(way) if way else [],
        "ticks": len(way.trace) if way else 0,
        "tick_ms": way.trace.system.tick_ms if way else 0,
    }


def rows(way: GraphWay, most: int = MOST_ROWS) -> list[Row]:
    """The run to a node as a story; of a very long one the middle is left out, and the gap says so."""
    found = [_row(one) for one in story.rows(way.trace)]
    left = len(found) - most
    if left <= 0:
        return found
    half = most // 2
    return [*found[:half], ("…", "", [f"{left:,} rows are left out here"]), *found[-half:]]


def _row(one: story.Row) -> Row:
    match one:
        case story.StoryEvent(number, ms, changes, transitions):
            told = [f"in {change}" if change.is_input else str(change) for change in changes]
            fired = [f"▸ {a.chart}: {story.start_of(a)} {a.label}".rstrip() for a in transitions]
            return str(number), str(ms), [*told, *fired] or ["nothing changes"]
        case story.Quiet():
            return "·", "", [one.what]
        case _:
            return "↻", "", [one.what]


def _flags(graph: StateGraph, node: GraphNode) -> list[str]:
    """What is special about a node, in words."""
    number = node.number
    flags = [
        ("initial", node.initial),
        ("marked", number in graph.bad),
        ("on the run", number in graph.path),
        ("dead end", node.dead > 0),
        ("never left", number in graph.absorbing),
        ("mixed", number in graph.mixed),
        ("not explored to its end", node.unexpanded > 0),
    ]
    return [name for name, given in flags if given]


def _parts(graph: StateGraph) -> dict[str, list[int]]:
    """The nodes that filters leave, by the name of the filter."""
    found: dict[str, list[int]] = {}
    for node in graph.nodes:
        for flag in _flags(graph, node):
            found.setdefault(flag, []).append(node.number)
    several = sorted(graph.components.values(), key=lambda members: (-len(members), members))
    for place, members in enumerate(several, start=1):
        found[f"strongly connected {place}"] = list(members)
    return found


def _filters(graph: StateGraph) -> Sequence[tuple[str, int]]:
    return [(name, len(numbers)) for name, numbers in _parts(graph).items()]
