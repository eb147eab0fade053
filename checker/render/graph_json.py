"""A projected state graph as JSON for other programs; of any size."""

import json
from typing import Literal

from typing_extensions import TypedDict

from rovercheck.checker.io.document import Count
from rovercheck.checker.results.format import Format
from rovercheck.checker.results.graph import ProjectionKind, StateGraph

FORMAT = Format("json", "graph", ".json", "nodes, edges and what is known about them, with schema version")


class NodeRow(TypedDict):
    """A combination of values of the variables shown, and the states behind it."""

    id: int
    values: dict[str, str]
    """As people read them."""
    raw: list[int]
    valuations: Count
    """The states behind it."""
    initial: bool
    component: int
    depth: Count
    """The number of ticks after which it is first reached."""
    marked: Count
    """States behind it in which the property looked for is broken, or reached."""
    dead: Count
    """States behind it from which no input is admissible."""
    unexpanded: Count
    """States behind it whose ticks are not known."""


class EdgeRow(TypedDict):
    """Ticks that lead from one node to another."""

    source: int
    target: int
    steps: Count
    """Pairs of states."""
    sources: Count
    """States behind the source that have such a tick."""
    sure: bool
    """Whether each state behind the source has such a tick."""
    example: str
    """Inputs of one of them."""
    ticks: list[int]
    """The ticks of the path shown that take it."""


class ExactWith(TypedDict):
    """Variables with which the graph would be exact, and its nodes then."""

    variables: list[str]
    nodes: Count


class GraphDocument(TypedDict):
    """What ``rovercheck graph --format json`` writes."""

    format: Literal["rovercheck-graph"]
    version: Literal[2]
    title: str
    variables: list[str]
    kind: ProjectionKind
    exact: bool
    because: list[str]
    """Why it is not exact."""
    cut: str
    """What was left out, if something was."""
    depth: Count
    valuations: Count
    nodes: list[NodeRow]
    edges: list[EdgeRow]
    dead_ends: list[int]
    absorbing: list[int]
    path: list[int]
    bad: list[int]
    looked_for: str
    never: dict[str, list[str]]
    """Values of variables that no state has."""
    exact_with: list[ExactWith]
    notes: list[str]


def render(graph: StateGraph, indent: int = 1) -> str:
    """The whole graph as JSON text; ``checker/schemas/graph-2.json`` describes it."""
    return json.dumps(document(graph), indent=indent, ensure_ascii=False) + "\n"


def document(graph: StateGraph) -> GraphDocument:
    """The graph as plain lists and dictionaries."""
    return {
        "format": "rovercheck-graph",
        "version": 2,
        "title": graph.title,
        "variables": list(graph.variables),
        "kind": graph.kind,
        "exact": graph.exact,
        "because": list(graph.because),
        "cut": graph.cut,
        "depth": graph.depth,
        "valuations": graph.valuations,
        "nodes": [
            {"id": n.number, "values": dict(zip(graph.variables, n.shown, strict=True)), "raw": list(n.raw),
             "valuations": n.valuations, "initial": n.initial, "component": n.component, "depth": n.depth,
             "marked": n.wanted, "dead": n.dead, "unexpanded": n.unexpanded}
            for n in graph.nodes
        ],
        "edges": [
            {"source": e.source, "target": e.target, "steps": e.steps, "sources": e.sources,
             "sure": (e.source, e.target) in graph.sure, "example": e.example,
             "ticks": list(graph.taken.get((e.source, e.target), ()))}
            for e in graph.edges
        ],
        "dead_ends": sorted(graph.dead_ends),
        "absorbing": sorted(graph.absorbing),
        "path": list(graph.path),
        "bad": sorted(graph.bad),
        "looked_for": graph.looked_for,
        "never": {name: list(shown) for name, shown in graph.never.items()},
        "exact_with": [{"variables": list(names), "nodes": nodes} for names, nodes in graph.exact_with],
        "notes": list(graph.notes),
    }  # fmt: skip
