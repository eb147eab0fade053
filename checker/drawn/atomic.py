"""Atomic subcharts: a chart in a state of another, drawn in its place where it means the same there.

It has data of its own, of which inputs and outputs stand for data around the state.  Elements of it have
numbers of their own: in the chart around they have the next thousand in front.
"""

import re
from collections.abc import Iterator, Mapping
from dataclasses import replace

from rovercheck.checker.drawn.records import (
    DrawnChart,
    DrawnContent,
    DrawnData,
    DrawnJunction,
    DrawnState,
    DrawnTransition,
    path_of,
)

MAPPED = ("input", "output", "data store")
"""The data that stand for others."""
CHANGES = re.compile(r"\b(?:hasChanged(?:To|From)?|rising|falling|crossing)\s*\(")
_NAME = re.compile(r"[A-Za-z]\w*")
STEP = 1_000
Parts = Mapping[str, DrawnChart]
"""Charts by their paths."""


def drawn_in_place(charts: tuple[DrawnChart, ...]) -> tuple[DrawnChart, ...]:
    """The charts with their atomic subcharts as plain ones, where that means the same; the others stay."""
    parts = {one.path: one for one in charts}
    used = set[str]()
    made = {path: _filled(one, parts, used, (path,)) for path, one in parts.items()}
    return tuple(made[one.path] for one in charts if one.path not in used)


def why_not(chart: DrawnChart, state: DrawnState, parts: Parts) -> str:
    """Why an atomic subchart is not drawn in its place, and what to do; empty if it is."""
    part = parts.get(path_of_part(chart, state))
    if part is None:
        return "it is a link to a library, or is not in the file. Break the link, and save the model again"
    if part.kind != "chart" or (part.language, part.saturates) != (chart.language, chart.saturates):
        return "it has another language or other integers than the chart around it. Give both the same"
    if part.super_step or part.machine != chart.machine or part.update == "continuous":
        return "it is executed otherwise than the chart around it. Give both the same properties"
    levels = list(part.content.every_level())
    if any(level.events for level in levels):
        return "it has events of its own, which only it answers. Make it a plain subchart"
    if not any(one.kind in ("exclusive", "parallel") for one in part.content.states):
        return "it has no states, and runs its flow chart in every step. Draw that in a during action"
    if any(one.function == "Simulink" for one in part.content.every_state()):
        return "it has Simulink functions. Draw them in the chart around it"
    names = {one.name for one in part.content.data if one.scope in MAPPED}
    if names and any(CHANGES.search(text) for text in _texts(part.content)):
        return "it asks whether data have changed since it was executed last. Make it a plain subchart"
    return _hidden(part, levels, _mapped(part, state))


def _hidden(part: DrawnChart, levels: list[DrawnContent], mapped: Mapping[int, str]) -> str:
    """Whether the name of a datum that stands for another one, or of that, means a third one in it."""
    data = {one.ssid: one.name for one in part.content.data}
    inside = {one.name for level in levels for one in level.data if one.ssid not in mapped}
    for ssid, outer in mapped.items():
        found = _NAME.match(outer)
        for name in {data[ssid], found[0] if found else ""} & inside:
            return f"{data[ssid]} stands for {outer}, and {name} is also a datum of its own. Rename that"
    return ""


def path_of_part(chart: DrawnChart, state: DrawnState) -> str:
    """The path of the chart that an atomic subchart is."""
    return f"{chart.path}/{path_of(state.block or state.name)}"


def _texts(content: DrawnContent) -> Iterator[str]:
    for level in content.every_level():
        yield from (one.label for one in level.transitions)
        for state in level.states:
            yield from (state.label, state.script)


def _mapped(part: DrawnChart, state: DrawnState) -> dict[int, str]:
    """Of the data that stand for others what they stand for, by SSID: something of the same name if no
    mapping is written.
    """  # fmt: skip
    written = dict(line.strip().partition(" ")[::2] for line in state.binding.splitlines())
    every = (one for one in part.content.data if one.scope in MAPPED or str(one.ssid) in written)
    return {one.ssid: written.get(str(one.ssid), "").strip() or one.name for one in every}


# --- drawing ------------------------------------------------------------------------------------------------


def _filled(chart: DrawnChart, parts: Parts, used: set[str], within: tuple[str, ...]) -> DrawnChart:
    if not any(one.atomic for one in chart.content.every_state()):
        return chart
    return replace(chart, content=_Filler(chart, parts, used, within).content(chart.content))


class _Filler:
    def __init__(self, chart: DrawnChart, parts: Parts, used: set[str], within: tuple[str, ...]) -> None:
        self._chart, self._parts, self._used, self._within = chart, parts, used, within
        self._next = _thousands(chart.content)

    def content(self, content: DrawnContent) -> DrawnContent:
        return replace(content, states=tuple(self._state(one) for one in content.states))

    def _state(self, state: DrawnState) -> DrawnState:
        path = path_of_part(self._chart, state)
        if not state.atomic or path in self._within or why_not(self._chart, state, self._parts):
            return replace(state, content=self.content(state.content))
        part = _filled(self._parts[path], self._parts, self._used, (*self._within, path))
        self._used.add(path)
        mapped = _mapped(part, state)
        own = tuple(one for one in part.content.data if one.ssid not in mapped)
        names = {one.name: mapped[one.ssid] for one in part.content.data if one.ssid in mapped}
        content = _numbered(replace(part.content, data=own), self._next)
        self._next += _thousands(part.content)
        names = {name: outer for name, outer in names.items() if name != outer}
        return replace(
            state, content=content, parallel=part.parallel, atomic=False, subchart=True, names=names
        )


def _thousands(content: DrawnContent) -> int:
    """The first thousand above all numbers in it."""
    every = (
        one.ssid
        for level in content.every_level()
        for some in (level.states, level.transitions, level.junctions, level.data, level.events)
        for one in some
    )
    return (max(every, default=0) // STEP + 1) * STEP


def _numbered(content: DrawnContent, by: int) -> DrawnContent:
    """What is drawn with other numbers."""

    def end(ssid: int | None) -> int | None:
        return None if ssid is None else ssid + by

    def transition(one: DrawnTransition) -> DrawnTransition:
        return replace(one, ssid=one.ssid + by, source=end(one.source), target=end(one.target))

    def junction(one: DrawnJunction) -> DrawnJunction:
        return replace(one, ssid=one.ssid + by)

    def datum(one: DrawnData) -> DrawnData:
        return replace(one, ssid=one.ssid + by, activity_of=end(one.activity_of))

    def state(one: DrawnState) -> DrawnState:
        return replace(one, ssid=one.ssid + by, content=_numbered(one.content, by))

    return replace(
        content,
        states=tuple(map(state, content.states)),
        transitions=tuple(map(transition, content.transitions)),
        junctions=tuple(map(junction, content.junctions)),
        data=tuple(map(datum, content.data)),
    )


__all__ = ["drawn_in_place", "path_of_part", "why_not"]
