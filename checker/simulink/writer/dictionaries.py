"""Data dictionaries: enumerations, buses and values beside a model."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Literal, TypeAlias
from xml.etree.ElementTree import Element, SubElement

from rovercheck.checker.simulink.writer.elements import below, made, put, xml_of
from rovercheck.checker.simulink.writer.packages import packed

Members: TypeAlias = Mapping[str, int]
Fields: TypeAlias = Sequence[tuple[str, str, str]]
"""The name, the type and the dimensions of each element of a bus."""
Names = Literal["new", "old"]
"""Newer releases write ``Elements_internal`` and ``DataType_internal``."""


def dictionary(
    path: Path,
    enumerations: Mapping[str, Members] | None = None,
    buses: Mapping[str, Fields] | None = None,
    values: Mapping[str, str] | None = None,
    others: Sequence[str] = (),
    names: Names = "new",
    part: str = "data/chunk0.xml",
) -> Path:
    """Write a dictionary; ``values`` are parameters, and it refers to ``others``."""
    root = made("DataSource", {"FormatVersion": "1", "MinRelease": "R2014a", "Arch": "glnxa64"})
    for name, members in (enumerations or {}).items():
        _enumeration(_entry(root, name), members)
    for name, fields in (buses or {}).items():
        _bus(_entry(root, name), fields, "_internal" if names == "new" else "")
    for name, value in (values or {}).items():
        put_in = below(_entry(root, name), "Element", None, Class="Simulink.Parameter")
        _said(put_in, "Value", value, "double")
        _said(put_in, "DataType", "auto")
    for other in others:
        below(root, "DictionaryReference", {"Name": other})
    packed(path, {part: xml_of(root), "_rels/.rels": b"<Relationships/>", "[Content_Types].xml": b"<Types/>"})
    return path


def _said(holder: Element, name: str, value: object = None, kind: str = "char", **more: str) -> Element:
    """A property with the class of its value, as dictionaries have it."""
    element = SubElement(holder, "P", {"Name": name, "Class": kind, **more})
    if value is not None:
        element.text = str(value)
    return element


def _entry(root: Element, name: str) -> Element:
    entry = below(root, "Object", None, Class="DD.ENTRY")
    _said(entry, "Name", name)
    _said(entry, "IsDerived", "0")
    put(entry, {"Value": ""})
    return entry[-1]


def _enumeration(value: Element, members: Members) -> None:
    element = below(value, "Element", None, Class="Simulink.data.dictionary.EnumTypeDefinition")
    listed = _said(element, "Enumerals", None, "struct", Dimension=f"1*{len(members)}")
    for name, number in members.items():
        one = below(listed, "Element")
        _said(one, "Name", name)
        _said(one, "Value", number)
        _said(one, "Description")
    _said(element, "DefaultValue", next(iter(members)))
    _said(element, "StorageType")
    _said(element, "AddClassNameToEnumNames", 0, "logical")


def _bus(value: Element, fields: Fields, suffix: str) -> None:
    element = below(value, "Element", None, Class="Simulink.Bus")
    listed = SubElement(element, "P", Name=f"Elements{suffix}", Dimension=f"{len(fields)}*1")
    for name, kind, size in fields:
        one = below(listed, "Element", None, Class="Simulink.BusElement")
        _said(one, "Name", name)
        _said(one, f"DataType{suffix}", kind)
        _said(one, "Complexity", "real")
        _said(one, "Dimensions", size, "double")


__all__ = ["Names", "dictionary"]
