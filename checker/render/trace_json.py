"""A trace as JSON for other programs: readable values beside raw ones, with a published schema.

The shape follows Apalache's Informal Trace Format: names of variables, then one object per state.
"""

import json
from collections.abc import Mapping
from typing import Literal, NotRequired

from typing_extensions import TypedDict

from rovercheck.checker.io.document import Count, Ordinal, PlaceRow, place_row
from rovercheck.checker.render.story import false_parts
from rovercheck.checker.results.format import Format
from rovercheck.checker.results.trace import Needed, TakenTransition, Tick, Trace
from rovercheck.spec_model.lang.domain import Bool, Enum
from rovercheck.spec_model.lang.expr import Var

FORMAT = Format("json", "trace", ".json", "all values of all ticks, readable and raw, with schema version")


class ValueRow(TypedDict):
    """A value as people read it, and as the engines hold it."""

    value: bool | int | str
    raw: int


ValueRows = dict[str, ValueRow]


class Shows(TypedDict):
    """What a run is of its property."""

    violated: bool | None
    """False: a witness; null: a run of no property."""
    shortest: bool
    """False: a shorter run may end so, too."""


class TraceAbout(Shows):
    """What a trace is about."""

    format: Literal["rovercheck-trace"]
    version: Literal[3]
    system: str
    property: str
    text: str
    because: str
    """Why it is violated, or true, as it is written beside the expected verdict; blank if it is not."""
    place: PlaceRow | None
    tick_ms: int
    ticks: Count


class VariableRow(TypedDict):
    """A variable; members, or resolution and unit, are there for its type alone."""

    name: str
    input: bool
    type: Literal["boolean", "enum", "number"]
    members: NotRequired[dict[str, int]]
    resolution: NotRequired[str]
    unit: NotRequired[str]
    doc: str


class FiredRow(TypedDict):
    """A transition that was taken."""

    chart: str
    source: str
    target: str
    label: str
    order: Count
    event: str | None
    place: PlaceRow | None


class TickAbout(TypedDict):
    """The number of a tick from 1, and when it is."""

    tick: Ordinal
    ms: int


class StateRow(TypedDict("StateMeta", {"#meta": TickAbout})):
    """A tick: its inputs, the state after it, and the transitions that were taken."""

    inputs: ValueRows
    after: ValueRows
    fired: list[FiredRow]


class NeededRow(TypedDict):
    """An input that had to be so, and the values that it may have had."""

    tick: Ordinal
    input: str
    values: list[ValueRow]


class FalseRow(TypedDict):
    """A part of the property that is false at the end."""

    name: str
    formula: str
    values: dict[str, str]


class TraceDocument(TypedDict("TraceMeta", {"#meta": TraceAbout})):
    """What ``rovercheck trace --format json`` writes."""

    params: list[str]
    """Frozen variables."""
    vars: list[VariableRow]
    before: ValueRows
    """The state before the first tick, with the values of frozen variables."""
    states: list[StateRow]
    needed: list[NeededRow] | None
    """Null: not examined."""
    false: list[FalseRow]
    loop: NotRequired[Count]
    """After the last tick it is again as after this one."""
    trapped: NotRequired[Ordinal]
    """States that can follow, all of which break the property."""


def render(trace: Trace, indent: int = 1) -> str:
    """The whole trace as JSON text; ``checker/schemas/trace-3.json`` describes it."""
    return json.dumps(document(trace), indent=indent, ensure_ascii=False) + "\n"


def document(trace: Trace) -> TraceDocument:
    """The trace as plain lists and dictionaries."""
    stated = trace.property
    found: TraceDocument = {
        "#meta": {"format": "rovercheck-trace", "version": 3, "system": trace.system.name,
                  "property": stated.id, "text": stated.text, "because": stated.because,
                  "place": place_row(stated.place),
                  "tick_ms": trace.system.tick_ms, "ticks": len(trace), **shows(trace)},
        "params": [n for n in trace.before if trace.ticks and n not in trace.ticks[0].after],
        "vars": [_variable(n, v, n in trace.system.inputs) for n, v in trace.system.variables.items()],
        "before": _values(trace, trace.before),
        "states": [_state(trace, tick) for tick in trace.ticks],
        "needed": None if trace.necessary is None else [_needed(trace, one) for one in trace.needed()],
        "false": [
            {"name": p.name, "formula": p.formula, "values": dict(p.values)} for p in false_parts(trace)
        ],
    }  # fmt: skip
    if trace.loop is not None:
        found["loop"] = trace.loop
    if trace.trapped is not None:
        found["trapped"] = trace.trapped
    return found


def shows(trace: Trace) -> Shows:
    """What the run is of its property: a violation or else a witness, and whether no shorter run ends so.

    ``violated`` is None where no property, or nothing of it, is known; ``shortest`` is False where a shorter
    run may exist.
    """
    of_none = trace.property.violated is None and not trace.breaks()
    return {"violated": None if of_none else trace.breaks(), "shortest": trace.shortest}


def _variable(name: str, variable: Var, is_input: bool) -> VariableRow:
    row: VariableRow = {"name": name, "input": is_input, "type": "boolean", "doc": variable.doc}
    match variable.sort:
        case Bool():
            return row
        case Enum(_, members):
            return {**row, "type": "enum", "members": dict(members)}
        case number:
            steps, unit = str(number.resolution), str(number.unit)
            return {**row, "type": "number", "resolution": steps, "unit": unit}


def _state(trace: Trace, tick: Tick) -> StateRow:
    return {
        "#meta": {"tick": tick.number, "ms": trace.ms(tick.number)},
        "inputs": _values(trace, tick.inputs),
        "after": _values(trace, tick.after),
        "fired": [_transition(transition) for transition in tick.transitions],
    }


def _values(trace: Trace, at: Mapping[str, int]) -> ValueRows:
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


def _transition(transition: TakenTransition) -> FiredRow:
    return {
        "chart": transition.chart, "source": transition.source, "target": transition.target,
        "label": transition.label, "order": transition.order, "event": transition.event,
        "place": place_row(transition.place),
    }  # fmt: skip


def _needed(trace: Trace, one: Needed) -> NeededRow:
    """An input that had to be so, and the values that it may have had."""
    return {
        "tick": one.number,
        "input": one.name,
        "values": [{"value": _value(trace, one.name, raw), "raw": raw} for raw in sorted(one.values)],
    }
