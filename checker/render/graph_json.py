"""A projected state graph as JSON for other programs; of any size."""

import json
from typing import Any

from rovercheck.checker.results.format import Format
from rovercheck.checker.results.graph import ProjectionKind, StateGraph

FORMAT = Format("json", "graph", ".json", "nodes, edges and what is known about them, with schema version")

VERSION = 2


def render(graph: StateGraph, indent: int = 1) -> str:
    """The whole graph as JSON text; ``SCHEMA`` describes it."""
    return json.dumps(document(graph), indent=indent, ensure_ascii=False) + "\n"


def document(graph: StateGraph) -> dict[str, Any]:
    """The graph as plain lists and dictionaries."""
    return {
        "format": "rovercheck-graph",
        "version": VERSION,
        "title": graph.title,
        "variables": list(graph.variables),
        "kind": str(graph.kind),
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


_NUMBERS = {"type": "array", "items": {"type": "integer"}}
_TEXT = {"type": "string"}


def _object(**properties: Any) -> dict[str, Any]:
    return {
        "type": "object", "required": list(properties), "properties": properties,
        "additionalProperties": False,
    }  # fmt: skip


_WHOLE = {"type": "integer"}
_TEXTS = {"type": "array", "items": _TEXT}

SCHEMA: dict[str, Any] = {
    "$schema": "https://json-schema.org/draft/2020-12/schema",
    "title": "rovercheck state graph",
    **_object(
        format={"const": "rovercheck-graph"}, version={"const": VERSION}, title=_TEXT, variables=_TEXTS,
        kind={"enum": [str(kind) for kind in ProjectionKind]}, exact={"type": "boolean"}, because=_TEXTS,
        cut=_TEXT, depth=_WHOLE, valuations=_WHOLE,
        nodes={
            "type": "array",
            "items": _object(
                id=_WHOLE, values={"type": "object"}, raw=_NUMBERS, valuations=_WHOLE,
                initial={"type": "boolean"}, component=_WHOLE, depth=_WHOLE, marked=_WHOLE, dead=_WHOLE,
                unexpanded=_WHOLE,
            ),
        },
        edges={
            "type": "array",
            "items": _object(
                source=_WHOLE, target=_WHOLE, steps=_WHOLE, sources=_WHOLE, sure={"type": "boolean"},
                example=_TEXT, ticks=_NUMBERS,
            ),
        },
        dead_ends=_NUMBERS, absorbing=_NUMBERS, path=_NUMBERS, bad=_NUMBERS, looked_for=_TEXT,
        never={"type": "object", "additionalProperties": _TEXTS},
        exact_with={"type": "array", "items": _object(variables=_TEXTS, nodes=_WHOLE)},
        notes=_TEXTS,
    ),
}  # fmt: skip
"""JSON Schema (2020-12) of the document."""
