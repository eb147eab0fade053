"""A model that was read as a text: everything in it but where it is drawn, an element on each line."""

from collections.abc import Iterator

from rovercheck.checker.drawn.records import (
    DrawnChart,
    DrawnContent,
    DrawnData,
    DrawnModel,
    DrawnState,
    DrawnSystem,
    DrawnTransition,
)

UNSAID = {"Position", "ZOrder", "Location"}
"""Parameters of blocks that only the editor needs."""


def outline(model: DrawnModel) -> str:
    """The model, its diagram, its charts, and what is defined beside it."""
    return "\n".join(_lines(model)) + "\n"


def _lines(model: DrawnModel) -> Iterator[str]:
    yield f"{model.name}: {model.release}, step {model.step}, solver {model.solver}"
    for enumeration in model.enumerations:
        members = ", ".join(f"{name} = {value}" for name, value in enumeration.members.items())
        yield f"enumeration {enumeration.name} of {enumeration.file}: {members}; {enumeration.default}"
    for bus in model.buses:
        elements = ", ".join(f"{one.name} {one.type} {one.dimensions}" for one in bus.elements)
        yield f"bus {bus.name} of {bus.file}: {elements}"
    yield from _system(model.system, "")
    for chart in model.charts:
        yield from chart_lines(chart)


def _system(system: DrawnSystem, indent: str) -> Iterator[str]:
    for block in system.blocks:
        shown = {name: text for name, text in block.parameters.items() if name not in UNSAID}
        told = ", ".join(f"{name}={text}" for name, text in shown.items()) or "-"
        chart = f" chart {block.chart!r}" if block.chart else ""
        signals = "".join(f" {port}:{name}" for port, name in block.signals.items())
        yield f"{indent}block {block.id} {block.kind} {block.path!r}{chart}: {told}{signals}"
        if block.system is not None:
            yield from _system(block.system, f"{indent}  ")
    for line in system.lines:
        yield f"{indent}line {line.source}.{line.from_port} -> {line.target}.{line.to_port}"


def chart_lines(chart: DrawnChart) -> Iterator[str]:
    """A chart with its properties, and what is in it."""
    flags = {
        "parallel": chart.parallel, "explicit order": chart.explicit_order, "saturates": chart.saturates,
        "at initialization": chart.at_initialization, "initializes outputs": chart.initializes_outputs,
        "super step": chart.super_step, "exports functions": chart.exports_functions,
    }  # fmt: skip
    told = ", ".join([chart.update, chart.machine, *(name for name, on in flags.items() if on)])
    yield f"chart {chart.path!r}: {chart.language} {chart.kind}, {told}"
    yield from _content(chart.content, "  ")


def _content(content: DrawnContent, indent: str) -> Iterator[str]:
    for state in content.states:
        yield f"{indent}{_state(state)}"
        yield from _content(state.content, f"{indent}  ")
    for junction in content.junctions:
        yield f"{indent}{junction.ssid} junction{' of history' if junction.history else ''}"
    for transition in content.transitions:
        yield f"{indent}{_transition(transition)}"
    for datum in content.data:
        yield f"{indent}{_datum(datum)}"
    for event in content.events:
        yield f"{indent}{event.ssid} event {event.name}: {event.scope} {event.trigger}".rstrip()


def _state(state: DrawnState) -> str:
    flags = {"subchart": state.subchart, "regions": state.parallel, "atomic": state.atomic}
    told = "".join(f", {name}" for name, on in flags.items() if on)
    script = f", script of {len(state.script.splitlines())} lines" if state.script else ""
    kind = f"{state.function} function" if state.function else state.kind
    return f"{state.ssid} {kind} {state.name!r}: order {state.order}{told}, {state.label!r}{script}"


def _transition(one: DrawnTransition) -> str:
    ends = f"{one.source or 'default'} -> {one.target or 'nowhere'}"
    return f"{one.ssid} {ends}: order {one.order}{', inner' if one.inner else ''}, {one.label!r}"


def _datum(one: DrawnData) -> str:
    limits = f", {one.minimum} to {one.maximum}" if one.minimum or one.maximum else ""
    return f"{one.ssid} {one.scope} {one.name}: {one.type}, size {one.size}, initial {one.initial!r}{limits}"


__all__ = ["chart_lines", "outline"]
