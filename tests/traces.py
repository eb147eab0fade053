"""Traces for tests: built from loose parts, and changed wherever a field stands."""

from collections.abc import Mapping
from dataclasses import fields, replace
from typing import Any

from rovercheck.checker.results.trace import NecessaryInputs, Tick, Trace, TracedProperty, TracedSystem
from rovercheck.spec_model.lang.expr import Expr, Var

SYSTEM, PROPERTY, NECESSARY = (
    {f.name for f in fields(record)} for record in (TracedSystem, TracedProperty, NecessaryInputs)
)


def trace_of(
    system: str,
    tick_ms: int,
    variables: Mapping[str, Var],
    inputs: tuple[str, ...],
    before: Mapping[str, int],
    ticks: tuple[Tick, ...],
    false_parts: tuple[Expr, ...] = (),
    relevant: frozenset[str] = frozenset(),
    charts: frozenset[str] = frozenset(),
    **more: Any,
) -> Trace:
    """A run of a system of that name, with more fields of any of its records."""
    bare = Trace(TracedSystem(system, tick_ms, variables, inputs), before, ticks)
    return changed(bare, false_parts=false_parts, relevant=relevant, charts=charts, **more)


def changed(trace: Trace, **more: Any) -> Trace:
    """The trace with other fields, of its system and of its property too; ``id`` is the property's."""
    system = {n: more.pop(n) for n in SYSTEM & more.keys()}
    stated = {n: more.pop(n) for n in PROPERTY & more.keys()}
    found = {n: more.pop(n) for n in NECESSARY & more.keys()}
    if found:
        more["necessary"] = replace(trace.necessary or NecessaryInputs((), minimal=False), **found)
    return replace(
        trace, system=replace(trace.system, **system), property=replace(trace.property, **stated), **more
    )
