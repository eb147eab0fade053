"""What the blocks of charts say of them: the order of their ports, and which are commented out."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from itertools import pairwise

from rovercheck.checker.drawn.records import DrawnBlock, DrawnChart, DrawnContent, DrawnData, DrawnSystem
from rovercheck.spec_model.lang.errors import ModelError

ARGUMENTS = {"Inport": "Inherit: auto", "ArgIn": "double"}
"""The ports that are arguments of a Simulink function, and the types of those that say none."""
Numbers = Mapping[str, int]
"""Ports by their names."""


def without(charts: Iterable[DrawnChart], commented: Sequence[str]) -> tuple[DrawnChart, ...]:
    """The charts that are in none of the blocks that are commented out, which are paths."""
    return tuple(one for one in charts if not any(f"{one.path}/".startswith(f"{c}/") for c in commented))


def in_order_of_ports(charts: Iterable[DrawnChart], system: DrawnSystem) -> tuple[DrawnChart, ...]:
    """The charts with their inputs and outputs in the order of the ports, which a file may not keep.

    Raises ``ModelError`` for an output that stands behind an event to other blocks.
    """
    inside = {one.chart: one.system for one in system.every_block() if one.chart and one.system is not None}
    return tuple(_ordered(one, inside[one.path]) if one.path in inside else one for one in charts)


def _ordered(chart: DrawnChart, inside: DrawnSystem) -> DrawnChart:
    ins, outs = (_numbers(inside.blocks, kind) for kind in ("Inport", "Outport"))
    _refuse_mixed(chart, outs)
    data = _sorted(_sorted(chart.content.data, "input", ins), "output", outs)
    events = sorted(chart.content.events, key=lambda one: outs.get(f"{one.name}()", 0))
    ordered = tuple(events) if all(f"{e.name}()" in outs for e in events) else chart.content.events
    content: DrawnContent = replace(chart.content, data=data, events=ordered)
    return replace(chart, content=_typed(content, inside))


def _typed(content: DrawnContent, inside: DrawnSystem) -> DrawnContent:
    """What is drawn with the types of arguments of Simulink functions, which their ports say."""
    states = []
    for one in content.states:
        inner = _typed(one.content, inside)
        if one.function == "Simulink":
            name = " ".join((one.block or one.name.partition("(")[0].rpartition("=")[2]).split())
            systems = (b.system for b in inside.blocks if b.shown == name and b.system is not None)
            ports = {_argument(p): p for system in systems for p in system.blocks if p.kind in ARGUMENTS}
            data = tuple(_as_port(d, ports[d.name]) if d.name in ports else d for d in inner.data)
            inner = replace(inner, data=data)
        states.append(replace(one, content=inner))
    return replace(content, states=tuple(states))


def _argument(port: DrawnBlock) -> str:
    return port.parameters.get("ArgumentName", port.shown)


def _as_port(one: DrawnData, port: DrawnBlock) -> DrawnData:
    """An argument in the type and size of its port, where it has none of its own."""
    type_ = port.parameters.get("OutDataTypeStr", ARGUMENTS[port.kind])
    size = port.parameters.get("PortDimensions", "-1")
    type_ = type_ if one.type.startswith("Inherit") or not one.type else one.type
    return replace(one, type=type_, size=size if one.size in ("", "-1") else one.size)


def _numbers(blocks: Iterable[DrawnBlock], kind: str) -> Numbers:
    written = {one.name: one.parameters.get("Port", "1").strip() for one in blocks if one.kind == kind}
    return {name: int(number) for name, number in written.items() if number.isdigit()}


def _sorted(data: tuple[DrawnData, ...], scope: str, numbers: Numbers) -> tuple[DrawnData, ...]:
    """The data of a scope by their ports, in the places of these; all others stay where they are."""
    places = [at for at, one in enumerate(data) if one.scope == scope]
    if any(data[at].name not in numbers for at in places):
        return data
    found = list(data)
    for at, one in zip(places, sorted(places, key=lambda at: numbers[data[at].name]), strict=True):
        found[at] = data[one]
    return tuple(found)


def _refuse_mixed(chart: DrawnChart, outs: Numbers) -> None:
    names = sorted(outs, key=lambda name: outs[name])
    for event, name in pairwise(names):
        if event.endswith("()") and not name.endswith("()"):
            raise ModelError(
                f"{chart.path}: the output {name} is behind the event {event.removesuffix('()')}. Move the "
                "ports of data before those of events."
            )


__all__ = ["in_order_of_ports", "without"]
