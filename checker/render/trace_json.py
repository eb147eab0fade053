"""A trace as JSON for other programs: readable values beside raw ones, with a published schema.

The shape follows Apalache's Informal Trace Format: names of variables, then one object per state.
"""

import json
from collections.abc import Mapping
from typing import Any

from rovercheck.checker.render.story import false_parts
from rovercheck.checker.results.format import Format
from rovercheck.checker.results.trace import Needed, TakenTransition, Tick, Trace
from rovercheck.spec_model.lang.domain import Bool, Enum
from rovercheck.spec_model.lang.expr import Var
from rovercheck.spec_model.lang.place import Place

FORMAT = Format("json", "trace", ".json", "all values of all ticks, readable and raw, with schema version")

VERSION = 3


def render(trace: Trace, indent: int = 1) -> str:
    """The whole trace as JSON text; ``SCHEMA`` describes it."""
    return json.dumps(document(trace), indent=indent, ensure_ascii=False) + "\n"


def document(trace: Trace) -> dict[str, Any]:
    """The trace as plain lists and dictionaries."""
    stated = trace.property
    return {
        "#meta": {"format": "rovercheck-trace", "version": VERSION, "system": trace.system.name,
                  "property": stated.id, "text": stated.text, "place": _place(stated.place),
                  "tick_ms": trace.system.tick_ms, "ticks": len(trace), **shows(trace)},
        "params": [n for n in trace.before if trace.ticks and n not in trace.ticks[0].after],
        "vars": [_variable(n, v, n in trace.system.inputs) for n, v in trace.system.variables.items()],
        "before": _values(trace, trace.before),
        "states": [_state(trace, tick) for tick in trace.ticks],
        "needed": None if trace.necessary is None else [_needed(trace, one) for one in trace.needed()],
        **({"loop": trace.loop} if trace.loop is not None else {}),
        **({"trapped": trace.trapped} if trace.trapped is not None else {}),
        "false": [
            {"name": p.name, "formula": p.formula, "values": dict(p.values)} for p in false_parts(trace)
        ],
    }  # fmt: skip


def shows(trace: Trace) -> dict[str, bool | None]:
    """What the run is of its property: a violation or else a witness, and whether no shorter run ends so.

    ``violated`` is None where no property, or nothing of it, is known; ``shortest`` is False where a shorter
    run may exist.
    """
    of_none = trace.property.violated is None and not trace.breaks()
    return {"violated": None if of_none else trace.breaks(), "shortest": trace.shortest}


def _variable(name: str, variable: Var, is_input: bool) -> dict[str, Any]:
    match variable.sort:
        case Bool():
            kind: dict[str, Any] = {"type": "boolean"}
        case Enum(_, members):
            kind = {"type": "enum", "members": dict(members)}
        case number:
            kind = {"type": "number", "resolution": str(number.resolution), "unit": str(number.unit)}
    return {"name": name, "input": is_input, **kind, "doc": variable.doc}


def _state(trace: Trace, tick: Tick) -> dict[str, Any]:
    return {
        "#meta": {"tick": tick.number, "ms": trace.ms(tick.number)},
        "inputs": _values(trace, tick.inputs),
        "after": _values(trace, tick.after),
        "fired": [_transition(transition) for transition in tick.transitions],
    }


def _values(trace: Trace, at: Mapping[str, int]) -> dict[str, dict[str, Any]]:
    return {
        n: {"value": _value(trace, n, raw), "raw": raw}
        for n, raw in at.items()
        if n in trace.system.variables
    }


def _value(trace: Trace, name: str, raw: int) -> bool | int | str:
    """A truth value, a whole number, else text: a member's name or an exact decimal."""
    shown = trace.show(name, raw)
    if isinstance(trace.system.variables[name].sort, Bool):
        return bool(raw)
    return int(shown) if shown.lstrip("-").isdigit() else shown


def _transition(transition: TakenTransition) -> dict[str, Any]:
    return {
        "chart": transition.chart, "source": transition.source, "target": transition.target,
        "label": transition.label, "order": transition.order, "event": transition.event,
        "place": _place(transition.place),
    }  # fmt: skip


def _needed(trace: Trace, one: Needed) -> dict[str, Any]:
    """An input that had to be so, and the values that it may have had."""
    return {
        "tick": one.number,
        "input": one.name,
        "values": [{"value": _value(trace, one.name, raw), "raw": raw} for raw in sorted(one.values)],
    }


def _place(place: Place | None) -> dict[str, Any] | None:
    """Where something is written, if that is known."""
    return None if place is None else {"file": place.path, "line": place.line}


_VALUE = {
    "type": "object",
    "required": ["value", "raw"],
    "properties": {"value": {"type": ["boolean", "integer", "string"]}, "raw": {"type": "integer"}},
    "additionalProperties": False,
}
_VALUES = {"type": "object", "additionalProperties": _VALUE}
_TEXT = {"type": "string"}
_PLACE = {
    "type": ["object", "null"],
    "required": ["file", "line"],
    "properties": {"file": _TEXT, "line": {"type": "integer", "minimum": 1}},
    "additionalProperties": False,
}
_NEEDED = {
    "type": "object",
    "required": ["tick", "input", "values"],
    "properties": {
        "tick": {"type": "integer", "minimum": 1}, "input": _TEXT,
        "values": {"type": "array", "items": _VALUE},
    },
    "additionalProperties": False,
}  # fmt: skip
_FIRED = {
    "type": "object",
    "required": ["chart", "source", "target", "label", "order", "event", "place"],
    "properties": {
        "chart": _TEXT, "source": _TEXT, "target": _TEXT, "label": _TEXT,
        "order": {"type": "integer", "minimum": 0}, "event": {"type": ["string", "null"]},
        "place": _PLACE,
    },
    "additionalProperties": False,
}  # fmt: skip

SCHEMA: dict[str, Any] = {
    "$schema": "https://json-schema.org/draft/2020-12/schema",
    "title": "rovercheck trace",
    "type": "object",
    "required": ["#meta", "params", "vars", "before", "states", "needed", "false"],
    "properties": {
        "#meta": {
            "type": "object",
            "required": [
                "format",
                "version",
                "system",
                "property",
                "text",
                "place",
                "tick_ms",
                "ticks",
                "violated",
                "shortest",
            ],
            "properties": {
                "format": {"const": "rovercheck-trace"},
                "version": {"const": VERSION},
                "place": _PLACE,
                "violated": {"type": ["boolean", "null"]},  # false: a witness; null: a run of no property
                "shortest": {"type": "boolean"},  # false: a shorter run may end so, too
            },
        },
        "params": {"type": "array", "items": _TEXT},
        "vars": {"type": "array", "items": {"type": "object", "required": ["name", "input", "type"]}},
        "before": _VALUES,
        "states": {
            "type": "array",
            "items": {
                "type": "object",
                "required": ["#meta", "inputs", "after", "fired"],
                "properties": {
                    "inputs": _VALUES,
                    "after": _VALUES,
                    "fired": {"type": "array", "items": _FIRED},
                },
            },
        },
        "needed": {"type": ["array", "null"], "items": _NEEDED},  # null: not examined
        "loop": {"type": "integer", "minimum": 0},  # after the last tick it is again as after this one
        "trapped": {"type": "integer", "minimum": 1},  # states that can follow, all false
        "false": {"type": "array", "items": {"type": "object", "required": ["name", "formula", "values"]}},
    },
    "additionalProperties": False,
}
"""JSON Schema (2020-12) of the document."""
