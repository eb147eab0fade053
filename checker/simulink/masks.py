"""Masks of subsystems: names that stand for values in all that is in them."""

import re
from collections.abc import Iterator, Mapping
from dataclasses import replace

from rovercheck.checker.drawn.parameters import expanded, names_in
from rovercheck.checker.drawn.records import DrawnChart, DrawnContent, DrawnData
from rovercheck.checker.simulink.assignments import assignments
from rovercheck.checker.simulink.xml import XmlElement
from rovercheck.spec_model.lang.errors import ModelError

MaskScope = Mapping[str, str | None]
"""The values of names as expressions; ``None``: one that the file does not say."""
VALUES = (
    "Value", "Gain", "Threshold", "InitialCondition", "InitialValue", "InitialOutput", "LowerLimit",
    "UpperLimit", "SampleTime", "Indices", "const", "sample_time", "numberOfIterations",
)  # fmt: skip
"""Parameters of blocks that are expressions."""
_VARIABLE = re.compile(r"(\w+)\s*=\s*([@&])(\d{1,4})")


def scope_in(block: XmlElement, around: MaskScope, place: str, given: Mapping[str, str]) -> MaskScope:
    """The names in a block: those of its mask, whose values are written with those ``around`` it.

    A link to the block may have ``given`` other values.
    """
    own = {name: value if value is None else given.get(name, value) for name, value in _own(block)}
    if not own:
        return around
    found: dict[str, str | None] = {}
    for name, value in own.items():
        unknown = value is None or any(around.get(one, "") is None for one in names_in(value))
        found[name] = None if unknown or value is None else valued(value, around, place, block.line)
    return {**around, **found}


def _own(block: XmlElement) -> Iterator[tuple[str, str | None]]:
    """Names and values of a mask, in the forms of all releases; what its commands compute has none."""
    codes = [block.property_of("MaskInitialization")]
    values = block.property_of("MaskValueString").split("|")
    for name, kind, number in _VARIABLE.findall(block.property_of("MaskVariables")):
        said = values[int(number) - 1] if 0 < int(number) <= len(values) else None
        yield name, said if kind == "@" else None
    masks = (
        one for one in block.children if one.tag == "Mask" or one.attributes.get("PropName") == "MaskObject"
    )
    for mask in masks:
        codes += [one.text for one in mask.all("Initialization")] + [mask.property_of("Initialization")]
        for one in mask.every():
            yield from _parameter(one)
    for code in codes:
        yield from ((name, None) for name, _ in assignments(code))


def _parameter(one: XmlElement) -> Iterator[tuple[str, str | None]]:
    if one.tag != "MaskParameter" and one.attributes.get("ClassName", "") != "Simulink.MaskParameter":
        return
    name, kind = (one.attributes.get(key) or one.property_of(key) for key in ("Name", "Type"))
    value = one.child("Value")
    said = one.property_of("Value") if value is None else value.text
    evaluated = (one.attributes.get("Evaluate") or one.property_of("Evaluate")) != "off"
    if name:
        yield name, said.strip() if kind in ("", "edit") and evaluated else None


def valued(text: str, scope: MaskScope, place: str, line: int) -> str:
    """An expression with the values of the names of masks.  Raises ``ModelError`` for one without any."""
    for name in names_in(text):
        if scope.get(name, "") is None:
            raise ModelError(
                f"{place}, line {line}: {name} is a name of a mask, whose value the file does not say as an "
                "expression. Write the value in its place."
            )
    return expanded(text, {name: value for name, value in scope.items() if value is not None})


def in_mask(chart: DrawnChart, scope: MaskScope, place: str) -> DrawnChart:
    """A chart of which the parameters are constants, where a mask around it says their values."""
    if not scope:
        return chart
    rate = valued(chart.sample_time, scope, place, 0)
    return replace(chart, content=_content(chart.content, scope, place), sample_time=rate)


def _content(content: DrawnContent, scope: MaskScope, place: str) -> DrawnContent:
    states = (replace(one, content=_content(one.content, scope, place)) for one in content.states)
    data = (_datum(one, scope, place) for one in content.data)
    return replace(content, states=tuple(states), data=tuple(data))


def _datum(one: DrawnData, scope: MaskScope, place: str) -> DrawnData:
    if one.name not in scope or not (one.scope == "parameter" or one.from_workspace):
        return one
    kept = "constant" if one.scope == "parameter" else one.scope
    initial = valued(one.name, scope, place, one.line)
    return replace(one, scope=kept, initial=initial, from_workspace=False)


__all__ = ["VALUES", "MaskScope", "in_mask", "scope_in", "valued"]
