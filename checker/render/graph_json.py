"""A projected state graph as JSON for other programs; of any size."""

import json
from typing import Any

from checker.graph import StateGraph

NAME = "json"
KIND = "graph"
SUFFIX = ".json"
SUMMARY = "nodes, edges and what is known about them, with schema version"

VERSION = 1


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
        "exact": graph.exact,
        "valuations": graph.valuations,
        "nodes": [
            {"id": n.number, "values": dict(zip(graph.variables, n.shown, strict=True)), "raw": list(n.raw),
             "valuations": n.valuations, "initial": n.initial, "component": n.component}
            for n in graph.nodes
        ],
        "edges": [
            {"source": e.source, "target": e.target, "steps": e.steps, "example": e.example}
            for e in graph.edges
        ],
        "dead_ends": sorted(graph.dead_ends),
        "absorbing": sorted(graph.absorbing),
        "path": list(graph.path),
        "bad": sorted(graph.bad),
        "notes": list(graph.notes),
    }  # fmt: skip


_NUMBERS = {"type": "array", "items": {"type": "integer"}}
_TEXT = {"type": "string"}


def _object(**properties: Any) -> dict[str, Any]:
    return {
        "type": "object", "required": list(properties), "properties": properties,
        "additionalProperties": False,
    }  # fmt: skip


SCHEMA: dict[str, Any] = {
    "$schema": "https://json-schema.org/draft/2020-12/schema",
    "title": "rovercheck state graph",
    **_object(
        format={"const": "rovercheck-graph"},
        version={"const": VERSION},
        title=_TEXT,
        variables={"type": "array", "items": _TEXT},
        exact={"type": "boolean"},
        valuations={"type": "integer"},
        nodes={
            "type": "array",
            "items": _object(
                id={"type": "integer"}, values={"type": "object"}, raw=_NUMBERS,
                valuations={"type": "integer"}, initial={"type": "boolean"}, component={"type": "integer"},
            ),
        },
        edges={
            "type": "array",
            "items": _object(
                source={"type": "integer"},
                target={"type": "integer"},
                steps={"type": "integer"},
                example=_TEXT,
            ),
        },
        dead_ends=_NUMBERS, absorbing=_NUMBERS, path=_NUMBERS, bad=_NUMBERS,
        notes={"type": "array", "items": _TEXT},
    ),
}  # fmt: skip
"""JSON Schema (2020-12) of the document."""
