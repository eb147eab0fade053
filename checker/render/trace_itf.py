"""A trace in the Informal Trace Format of Apalache (its ADR-015), for tools that read that.

State 0 is the state before the first tick; state k holds the inputs of tick k and the state after
it.  Whole numbers are ``{"#bigint": "5"}``, as the format wants them; a number with decimals, which it does
not have, is counted in the steps that ``#meta`` names.
"""

import json
from collections.abc import Mapping
from typing import Any

from rovercheck.checker.render.reasons import determined_by
from rovercheck.checker.render.trace_json import shows
from rovercheck.checker.results.format import Format
from rovercheck.checker.results.trace import Trace
from rovercheck.spec_model.lang.domain import Bool, Enum, Num, show

FORMAT = Format(
    "itf", "trace", ".itf.json", "Informal Trace Format (Apalache, Quint), all variables in all states"
)

_UNSET = {"#unserializable": "an input before the first tick"}


def render(trace: Trace) -> str:
    """The trace as JSON text, a state a line; ``SCHEMA`` describes it."""
    whole = document(trace)
    states = ",\n".join(json.dumps(state, ensure_ascii=False) for state in whole.pop("states"))
    head = json.dumps(whole, indent=1, ensure_ascii=False).removesuffix("\n}")
    return f'{head},\n "states": [\n{states}\n ]\n}}\n'


def document(trace: Trace) -> dict[str, Any]:
    """The trace as plain lists and dictionaries."""
    held = {*trace.before, *trace.system.inputs, *(n for t in trace.ticks for n in t.after)}
    names = [n for n in trace.system.variables if n in held]
    fixed = {n for n in trace.before if trace.ticks and n not in trace.ticks[0].after}
    start = dict(trace.before)
    return {
        "#meta": _about(trace, names),
        "params": [_written(n) for n in names if n in fixed],
        "vars": [_written(n) for n in names if n not in fixed],
        **({"loop": trace.loop + 1} if trace.loop is not None else {}),
        "states": [
            _state(trace, names, 0, start),
            *(_state(trace, names, t.number, {**start, **t.after, **t.inputs}) for t in trace.ticks),
        ],
    }


def _about(trace: Trace, names: list[str]) -> dict[str, Any]:
    sorts = {n: trace.system.variables[n].sort for n in names}
    scaled = {n: s for n, s in sorts.items() if isinstance(s, Num) and (s.resolution != 1 or str(s.unit))}
    return {
        "format": "ITF",
        "format-description": "https://apalache-mc.org/docs/adr/015adr-trace.html",
        "source": trace.system.name,
        "description": f"{trace.property.id}: {trace.property.text}" if trace.property.id else "",
        "because": trace.property.because,
        "cause": determined_by(trace),
        "tick_ms": trace.system.tick_ms,
        **shows(trace),
        "varTypes": {_written(n): _type(trace, n) for n in names},
        "steps": {_written(n): f"{show(s.resolution)} {s.unit}".rstrip() for n, s in scaled.items()},
    }


def _written(name: str) -> str:
    """The name as a key: those that begin with ``#`` belong to the format."""
    return f"_{name}" if name.startswith("#") else name


def _type(trace: Trace, name: str) -> str:
    match trace.system.variables[name].sort:
        case Bool():
            return "Bool"
        case Enum():
            return "Str"
        case _:
            return "Int"


def _state(trace: Trace, names: list[str], index: int, at: Mapping[str, int]) -> dict[str, Any]:
    values = {_written(n): _value(trace, n, at[n]) if n in at else _UNSET for n in names}
    return {"#meta": {"index": index}, **values}


def _value(trace: Trace, name: str, raw: int) -> bool | str | dict[str, str]:
    match trace.system.variables[name].sort:
        case Bool():
            return bool(raw)
        case Enum():
            return trace.show(name, raw)
        case _:
            return {"#bigint": str(raw)}


_EXPRESSION = {
    "anyOf": [
        {"type": ["boolean", "string"]},
        {
            "type": "object",
            "required": ["#bigint"],
            "properties": {"#bigint": {"type": "string", "pattern": "^-?[0-9]+$"}},
            "additionalProperties": False,
        },
        {
            "type": "object",
            "required": ["#unserializable"],
            "properties": {"#unserializable": {"type": "string"}},
            "additionalProperties": False,
        },
    ]
}
_NAMES = {"type": "array", "items": {"type": "string", "pattern": "^[^#]"}, "uniqueItems": True}

SCHEMA: dict[str, Any] = {
    "$schema": "https://json-schema.org/draft/2020-12/schema",
    "title": "Informal Trace Format, as rovercheck writes it",
    "type": "object",
    "required": ["#meta", "vars", "states"],
    "properties": {
        "#meta": {
            "type": "object",
            "required": ["violated", "shortest"],
            "properties": {
                "violated": {"type": ["boolean", "null"]},  # false: a witness; null: a run of no property
                "shortest": {"type": "boolean"},  # false: a shorter run may end so, too
            },
        },
        "params": _NAMES,
        "vars": _NAMES,
        "loop": {"type": "integer", "minimum": 0},  # after the last state comes this one
        "states": {
            "type": "array",
            "minItems": 1,
            "items": {
                "type": "object",
                "required": ["#meta"],
                "properties": {
                    "#meta": {
                        "type": "object",
                        "required": ["index"],
                        "properties": {"index": {"type": "integer", "minimum": 0}},
                    }
                },
                "additionalProperties": _EXPRESSION,
            },
        },
    },
    "additionalProperties": False,
}
"""JSON Schema (2020-12) of the document."""
