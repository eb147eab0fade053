"""What stands in a file of charts and has no meaning here, each with its place and the way around it."""

from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass
from typing import Literal

from rovercheck.checker.drawn.activity import tells_of_regions
from rovercheck.checker.drawn.atomic import Parts, why_not
from rovercheck.checker.drawn.calls import SPLIT
from rovercheck.checker.drawn.records import (
    DrawnBlock,
    DrawnChart,
    DrawnContent,
    DrawnData,
    DrawnModel,
    DrawnState,
    DrawnSystem,
    DrawnTransition,
)
from rovercheck.checker.drawn.resets import states_refused
from rovercheck.checker.drawn.type_names import plain_type
from rovercheck.checker.drawn.wiring import CONTROL


@dataclass(frozen=True)
class DrawingNote:
    """What is to be known of an element: it is ``refused``, or read ``otherwise`` than it is drawn.

    ``where`` is a path of names below the model, ``what`` the element there.
    """

    kind: Literal["refused", "otherwise"]
    where: str
    what: str
    text: str
    part: str
    ssid: int | None = None
    line: int = 0

    def __str__(self) -> str:
        number = "" if self.ssid is None else f" (SSID {self.ssid})"
        return f"{self.where}, {self.what}{number}: {self.text}"


LONGEST = 100
"""Letters of the name of a state in a note."""
GENERATES = (
    "a generator of function calls that is no link to the library of Simulink. Draw the block of the library"
)
BLOCKS: Mapping[str, str] = {
    "Reference": "a link to a library, which is in no file beside the model. Put it there, or break the link",
    "ModelReference": "another model. Import that model by itself",
    "S-Function": "C code, which is not read. Put a MATLAB function in its place",
    "MATLABFcn": "an interpreted function of MATLAB. Put a MATLAB Function block in its place",
    "FunctionCallFeedbackLatch": "a latch of a function call. Put a Unit Delay in its place",
    "FunctionCaller": "a call of a Simulink function. Call it in a chart",
    "Integrator": "continuous time. Use a discrete-time block",
    "TransferFcn": "continuous time. Use a discrete-time block",
    "StateSpace": "continuous time. Use a discrete-time block",
    "Derivative": "continuous time. Use a discrete-time block",
}
"""Blocks without a meaning here, and the way around them."""
CALLS = ("FunctionCallFeedbackLatch", "FunctionCaller", "ModelReference")
"""Those of them that do more than give values."""
LINKS: Mapping[str, str] = {
    "known": "a link to a block of Simulink's library that is not known here. Draw what it does in its place",
    "changed": "a link to a library that is changed here. Restore it, or break it",
    "plain": "a link to a block of a library that is no subsystem. Break the link, and save the model again",
    "itself": "a link to a library in which the same link is. Break it, and save the library again",
}
"""Links that are not followed, though it is known to what they lead."""
FREE = "`free` in the file of domains, to have any value"
SELECTED = "Index vector (dialog)"
"""How a Selector names elements: by numbers that are written in it."""


def notes_of(model: DrawnModel) -> Iterator[DrawingNote]:
    """Everything in a model that is refused, or read otherwise, in the order of the file."""
    parts = {one.path: one for one in model.charts}
    for chart in model.charts:
        yield from _chart(chart, parts)
    yield from _blocks(model.system, False, parts)
    for one in model.data:
        text = "it is of all charts together. Give each chart its own, and connect them."
        yield DrawingNote("refused", model.name, f"the datum {one.name}", text, "", one.ssid, one.line)


def _blocks(system: DrawnSystem, controlled: bool, parts: Parts) -> Iterator[DrawingNote]:
    """What is refused in a system, which is executed in some steps only if it is ``controlled``."""
    controlled = controlled or any(one.kind in CONTROL for one in system.blocks)
    for block in system.blocks:
        name, what = block.shown_path, f"{block.kind} block {block.id}"
        for text in (*_of_block(block, system), *states_refused(block, controlled, parts)):
            yield DrawingNote("refused", name, what, text, system.part, None, block.line)
        for inner in block.systems():
            yield from _blocks(inner, controlled, parts)


def _of_block(block: DrawnBlock, system: DrawnSystem) -> Iterator[str]:
    """Why a block has no meaning here."""
    if block.kind in BLOCKS:
        source, name = block.parameters.get("SourceType", ""), block.parameters.get("FunctionName", "")
        generates = source == "Function-Call Generator" or name == "fcncallgen"
        link = LINKS.get(block.parameters.get("link", ""), BLOCKS[block.kind])
        way = "" if generates or block.kind in CALLS else f" Or name it under {FREE}."
        yield f"it is {GENERATES if generates else link}.{way}"
    if block.kind == SPLIT and block.parameters.get("OutputPortLayout", "default") != "default":
        yield "its outputs are in another layout. Set that to default, in which the first is executed first."
    if block.parameters.get("DataStoreElements", "").strip() not in ("", "#"):
        yield "it reads or writes some elements of a data store. Read it whole, and use a selector."
    if block.parameters.get("Commented") == "through":
        yield "it is commented through. Delete it, and draw the signal past it."
    if block.kind != "SubSystem" or block.system is None or block.chart:
        return
    connected = {one.to_port for one in system.lines if one.target == block.id}
    ports = [CONTROL[one.kind] for one in block.system.blocks if one.kind in CONTROL]
    for port in sorted({*ports} - connected):
        yield f"nothing is connected to its port {port}. Connect a signal, or delete the port."
    if len(ports) > 1:
        yield f"it has the ports {' and '.join(ports)}. Put what the second controls into a subsystem in it."


def selector_refused(block: DrawnBlock) -> str:
    """Why a Selector block has no meaning here; empty if it has one."""
    said = block.parameters.get("IndexOptions", SELECTED).strip()
    if block.parameters.get("NumberOfDimensions", "1").strip() != "1" or said != SELECTED:
        return f"of Selector blocks those are known that name the elements of a vector ({SELECTED})"
    return ""


def _chart(chart: DrawnChart, parts: Parts) -> Iterator[DrawingNote]:
    if chart.super_step:
        yield _note(chart, "the chart", "super step semantics. Switch it off in the properties of the chart")
    if chart.update == "continuous":
        yield _note(chart, "the chart", "an update in continuous time. Make it discrete, or inherited")
    named = [one.name for one in chart.content.data if one.activity_of == 0]
    if chart.activity_output and not named:
        text = f"of its active state, {chart.activity_output}, which is no datum of it. Give it one"
        yield _note(chart, "the chart", f"an output {text}")
    for one in chart.content.data:
        if one.activity_of is not None and tells_of_regions(chart, one):
            told = "it tells of regions, of which several are active. Give each region an output of its own."
            what = f"the datum {one.name}"
            yield DrawingNote("refused", chart.path, what, told, chart.part, one.ssid, one.line)
    levels = list(chart.content.every_level())
    ends = {state.ssid for level in levels for state in level.states}
    ends |= {junction.ssid for level in levels for junction in level.junctions}
    yield from _level(chart, chart.content, chart.path, None, ends, parts)


def _level(
    chart: DrawnChart, content: DrawnContent, where: str, holder: DrawnState | None, ends: Collection[int],
    parts: Parts,
) -> Iterator[DrawingNote]:  # fmt: skip
    """What is in a chart or a state, ``holder``, and in its states; transitions lead to ``ends``."""
    kinds = {state.kind for state in content.states} & {"exclusive", "parallel"}
    if len(kinds) > 1:
        text = "exclusive and parallel states in one level. Draw one kind of them."
        ssid, line = (None, 0) if holder is None else (holder.ssid, holder.line)
        yield DrawingNote("refused", where, "its states", text, chart.part, ssid, line)
    for transition in content.transitions:
        what = f"the transition `{label_of(transition)}`"
        if transition.target is None:
            text = "it leads nowhere, and is left out."
            yield DrawingNote("otherwise", where, what, text, chart.part, transition.ssid, transition.line)
        for end in {transition.source, transition.target} - {None, *ends}:
            text = f"SSID {end} at an end of it is no state and no junction. Draw it to one of them."
            yield DrawingNote("refused", where, what, text, chart.part, transition.ssid, transition.line)
    for one in content.data:
        yield from _datum(chart, where, one)
    for state in content.states:
        if state.atomic:
            yield _of_state(chart, where, state, f"it is an atomic subchart: {why_not(chart, state, parts)}")
        if state.action_subsystem:
            text = "its action is a Simulink subsystem. Call a Simulink function in place of it"
            yield _of_state(chart, where, state, text)
        yield from _level(chart, state.content, f"{where}/{state.name[:LONGEST]}", state, ends, parts)


def _datum(chart: DrawnChart, where: str, one: DrawnData) -> Iterator[DrawingNote]:
    why, type_ = "", plain_type(one.type)
    if one.message:
        why = "it is a message, with a queue. Use an event, or a datum and a counter"
    elif "fixdt" in type_ or type_.startswith(("sfix", "ufix")):
        why = f"{one.type} is a fixed-point type. Use a type of integers, and scale in the chart"
    elif one.scope == "data store" and one not in chart.content.data:
        why = "it is a data store of a state. Make it one of the chart"
    elif one.type == "string" or one.type.startswith("stringtype"):
        why = "it is a string. Use an enumeration"
    if why:
        yield DrawingNote(
            "refused", where, f"the datum {one.name}", f"{why}.", chart.part, one.ssid, one.line
        )


def _note(chart: DrawnChart, what: str, text: str) -> DrawingNote:
    return DrawingNote("refused", chart.path, what, f"it has {text}.", chart.part)


def _of_state(chart: DrawnChart, where: str, state: DrawnState, text: str) -> DrawingNote:
    return DrawingNote(
        "refused", where, f"the state {state.name[:LONGEST]}", f"{text}.", chart.part, state.ssid, state.line
    )


def label_of(transition: DrawnTransition) -> str:
    """The label of a transition in one line."""
    return " ".join(transition.label.split()) or "?"


__all__ = ["FREE", "DrawingNote", "label_of", "notes_of"]
