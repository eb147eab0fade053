"""Types and values beside a model: data dictionaries (.sldd), classes of enumerations and scripts (.m)."""

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from itertools import dropwhile, takewhile
from pathlib import Path

from rovercheck.checker.drawn.parameters import expanded
from rovercheck.checker.drawn.records import DrawnBus, DrawnElement, DrawnEnumeration, DrawnParameter
from rovercheck.checker.io.bounded import bounded_bytes
from rovercheck.checker.simulink.assignments import assignments
from rovercheck.checker.simulink.package import SimulinkPackage
from rovercheck.checker.simulink.xml import XmlElement
from rovercheck.spec_model.lang.errors import ModelError

MOST_DICTIONARIES = 100
LONGEST_NAME = 255
"""Letters of the name of a file."""
MOST_TEXT = 4 << 20
"""Bytes of a class or a script."""

_CLASS = re.compile(r"^[ \t]*classdef\s*(?:\([^)\n]*\)\s*)?(\w+)\s*<\s*([\w.]+)", re.MULTILINE)
_MEMBER = re.compile(r"\b(\w+)\s*\(\s*(-?\d{1,18})\s*\)")
_DEFAULT = re.compile(
    r"function\s+(\w+)\s*=\s*getDefaultValue[ \t]*(?:\([ \t]*\))?[ \t;,]*\n\s*\1\s*=\s*(?:\w+\.)?(\w+)"
)
_COMMENT = re.compile(r"%.*")
_PARAMETER = re.compile(r"Simulink\.Parameter\s*(?:\((.*)\))?", re.DOTALL)
_WHOLE = re.compile(r"-?\d{1,18}(?:\.0*)?")


@dataclass
class Definitions:
    """What is defined beside a model, by name; ``files`` are those that were read."""

    enumerations: dict[str, DrawnEnumeration] = field(default_factory=dict)
    buses: dict[str, DrawnBus] = field(default_factory=dict)
    parameters: dict[str, DrawnParameter] = field(default_factory=dict)
    files: list[str] = field(default_factory=list)

    def read_dictionary(self, path: Path) -> None:
        """A data dictionary, and those that it refers to, beside it.  Raises ``ModelError``."""
        waiting, seen = [path], set[Path]()
        while waiting:
            file = waiting.pop(0)
            if file in seen:
                continue
            seen.add(file)
            if len(seen) > MOST_DICTIONARIES:
                raise ModelError(f"{path}: no more than {MOST_DICTIONARIES} dictionaries are read for one.")
            self.files.append(str(file))
            package = SimulinkPackage(file)
            for name in sorted(package.names()):
                if name.endswith(".xml") and name.startswith(("data/chunk", "dictionary/")):
                    root = package.xml(name)
                    self._entries(root, file.name, package.place(name))
                    waiting += (file.parent / other for other in _others(root, package.place(name)))

    def _entries(self, root: XmlElement, file: str, place: str) -> None:
        for entry in (one for one in root.every() if one.attributes.get("Class") == "DD.ENTRY"):
            name, value = entry.property_of("Name"), entry.property_element("Value")
            if value is None or not name:
                continue
            element = value.child("Element")
            kind = "" if element is None else element.attributes.get("Class", "")
            if element is not None and kind.endswith("EnumTypeDefinition"):
                self.enumerations[name] = _enumeration(name, element, file, place)
            elif element is not None and kind == "Simulink.Bus":
                self.buses[name] = _bus(name, element, file)
            elif element is not None and kind == "Simulink.Parameter":
                shown, type_ = element.property_of("Value"), element.property_of("DataType")
                self.parameters[name] = DrawnParameter(name, shown.strip(), type_, file)
            elif element is None and value.text.strip():
                type_ = value.attributes.get("Class", "")
                self.parameters[name] = DrawnParameter(name, value.text.strip(), type_, file)

    def read_text(self, path: Path) -> None:
        """A class of an enumeration, or a script of assignments.  Raises ``ModelError``."""
        text = bounded_bytes(path, MOST_TEXT, "Name a file of MATLAB.").decode("utf-8", errors="replace")
        self.files.append(str(path))
        if found := _CLASS.search(text):
            self.enumerations[found[1]] = _enumeration_class(found[1], found[2], text, path)
        else:
            known = {one.name: one.value for one in self.parameters.values()}
            for name, value in assignments(text):
                self._assign(name, expanded(value, known), path.name)
                owner = name.partition(".")[0]
                if owner in self.parameters:
                    known[owner] = self.parameters[owner].value

    def _assign(self, name: str, value: str, file: str) -> None:
        """A value in a script, or a property of one."""
        owner, _, part = name.rpartition(".")
        if not owner:
            made = _PARAMETER.fullmatch(value.strip())
            said = (made[1] or "[]") if made else value
            self.parameters[name] = DrawnParameter(name, said, "", file)
        elif owner in self.parameters and part == "Value":
            self.parameters[owner] = replace(self.parameters[owner], value=value)
        elif owner in self.parameters and part == "DataType":
            kind = value.strip().strip("'\"")
            self.parameters[owner] = replace(self.parameters[owner], type=kind)


def _others(root: XmlElement, place: str) -> Iterator[str]:
    """The names of dictionaries that one refers to, without folders: they are beside it."""
    for one in root.every():
        name = one.text.strip() or one.attributes.get("DictionaryName", "")
        if "Reference" in one.attributes.get("Class", "") or one.tag in ("Reference", "DictionaryReference"):
            name = name or one.property_of("Name") or one.property_of("DictionaryName")
            if name.endswith(".sldd"):
                if len(name) > LONGEST_NAME or not name.isprintable():
                    raise ModelError(
                        f"{place}, line {one.line}: it refers to the dictionary {name[:40]!r}, which is no "
                        "name of a file. Save the dictionary again in Simulink."
                    )
                yield Path(name).name


def _enumeration(name: str, element: XmlElement, file: str, place: str) -> DrawnEnumeration:
    members: dict[str, int] = {}
    listed = element.property_element("Enumerals")
    for one in () if listed is None else listed.all("Element"):
        value = one.property_of("Value").strip()
        if not _WHOLE.fullmatch(value):
            raise ModelError(
                f"{place}, line {one.line}: {one.property_of('Name')[:40]!r} of {name[:40]!r} is "
                f"{value[:40]!r}, and no whole number. Members of an enumeration are whole numbers."
            )
        members[one.property_of("Name").strip()] = int(value.partition(".")[0])
    default = default_of(members, element.property_of("DefaultValue").strip())
    return DrawnEnumeration(name, members, default, element.property_of("StorageType"), file)


def _bus(name: str, element: XmlElement, file: str) -> DrawnBus:
    listed = element.property_element("Elements_internal", "Elements")
    elements = []
    for one in () if listed is None else listed.all("Element"):
        kind = one.property_element("DataType_internal", "DataType")
        size = one.property_of("Dimensions", "1").strip() or "1"
        type_ = "double" if kind is None else kind.text.strip()
        elements.append(DrawnElement(one.property_of("Name"), type_, _dimensions(size)))
    return DrawnBus(name, tuple(elements), file)


def _dimensions(text: str) -> str:
    """The whole numbers of a size as they are written: ``1.0 3.0`` is ``1 3``."""
    words = text.strip("[]").replace(",", " ").split()
    return " ".join(word.partition(".")[0] if _WHOLE.fullmatch(word) else word for word in words)


def default_of(members: dict[str, int], named: str) -> str:
    """The default member: the one that is named, else the one with 0, else the first."""
    if named in members:
        return named
    return next((name for name, value in members.items() if value == 0), next(iter(members), ""))


def _enumeration_class(name: str, base: str, text: str, path: Path) -> DrawnEnumeration:
    """The members between ``enumeration`` and ``end``; the rest of the class is not read."""
    lines = [_COMMENT.sub("", line) for line in text.splitlines()]
    starts = dropwhile(lambda line: not re.match(r"\s*enumeration\b", line), lines)
    block = takewhile(lambda line: not re.match(r"\s*end\b", line), starts)
    members = {one[1]: int(one[2]) for line in block for one in _MEMBER.finditer(line)}
    if not members:
        raise ModelError(
            f"{path}: the class {name[:40]} has no members `NAME (number)` between enumeration and end. Name "
            "a class of an enumeration."
        )
    default = found[2] if (found := _DEFAULT.search("\n".join(lines))) else ""
    storage = "" if base.startswith("Simulink") else base
    return DrawnEnumeration(name, members, default_of(members, default), storage, path.name)


def files_beside(model: Path, names: Sequence[str]) -> Iterator[Path]:
    """The classes of enumerations beside a model that have one of some names."""
    for name in names:
        file = model.parent / f"{name}.m"
        if name.isidentifier() and is_file(file):
            yield file


def is_file(path: Path) -> bool:
    """Whether it is there: a name out of a file may be none that there can be."""
    try:
        return path.is_file()
    except (OSError, ValueError):
        return False


__all__ = ["Definitions", "default_of", "files_beside", "is_file"]
