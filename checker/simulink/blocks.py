"""Block diagrams: systems of blocks with their parameters, and the signals between their ports."""

import re
from collections.abc import Iterator, Mapping
from dataclasses import replace

from rovercheck.checker.drawn.records import DrawnBlock, DrawnLine, DrawnSystem, path_of
from rovercheck.checker.simulink.libraries import Libraries, LinkedBlock
from rovercheck.checker.simulink.masks import VALUES, MaskScope, scope_in, valued
from rovercheck.checker.simulink.opened import OpenedFile
from rovercheck.checker.simulink.xml import XmlElement, numbers
from rovercheck.spec_model.lang.errors import ModelError

_END = re.compile(r"([\w:.]+)#(in|out|enable|trigger|ifaction|state|reset|event)(?::(\d{1,6}))?")
_COUNT = re.compile(r"\d{1,6}")
CHARTS = ("Chart", "MATLAB Function", "Truth Table", "State Transition Table")
"""What ``SFBlockType`` is of blocks that are charts."""
TARGETS = ("in", "enable", "trigger", "ifaction", "state", "reset", "event")
CONTROL = {"enable": "EnablePort", "trigger": "TriggerPort", "ifaction": "ActionPort"}
PORTS = ("in", "out", "enable", "trigger", "state", "lconn", "rconn", "ifaction", "reset")
"""The order in which older releases count the ports of a block."""
MOST_LETTERS = 50_000_000
"""Letters of the paths of all blocks, in each of which there are the names of all that are around it."""
LINKED = 500
"""Letters that a block of a library counts for, which may be read in many places."""
MOST_LEVELS = 64
"""Systems in each other; the deepest diagrams known have a quarter of them."""

LIBRARY = {
    "Compare To Constant": "CompareToConstant", "Compare To Zero": "CompareToZero",
    "Function-Call Generator": "FunctionCallGenerator",
}  # fmt: skip
"""Kinds of blocks of Simulink's own library that are links to it, by the type of their source."""


class DiagramReader:
    """Reads the systems of a file, each once: a system that holds itself is refused.

    ``around``: it is a library, of which a block is read in place of a link, and ``link`` is that.
    """

    def __init__(
        self, file: OpenedFile, libraries: Libraries, around: "DiagramReader | None" = None, link: str = ""
    ) -> None:
        self._file, self._libraries = file, libraries
        self._read: set[str] = set()
        self._sids = f"{link}:" if link else ""
        self._links: tuple[str, ...] = ()
        """The links within which it reads."""
        self._letters: list[int] = [MOST_LETTERS] if around is None else around._letters
        self.commented: list[str] = [] if around is None else around.commented
        """The paths of blocks that are commented out, which are left out with their signals."""
        self.scopes: dict[str, MaskScope] = {} if around is None else around.scopes
        """The names of masks in which the block of a chart is, and in its own, by its path."""
        self.linked: dict[str, LinkedBlock] = {} if around is None else around.linked
        """The links that were followed, by their paths."""

    def root(self, element: XmlElement, part: str) -> DrawnSystem:
        """The diagram of a model, whose element holds or names its system.  Raises ``ModelError``."""
        system = element.child("System")
        if system is None:
            place = self._file.place(part)
            raise ModelError(f"{place}: the model has no <System>. Save the model again in Simulink.")
        return self._system(system, part, (), {})

    def _system(self, element: XmlElement, part: str, path: tuple[str, ...], scope: MaskScope) -> DrawnSystem:
        reference = element.attributes.get("Ref")
        if len(path) >= MOST_LEVELS:
            raise ModelError(
                f"{self._file.place(part)}, line {element.line}: no more than {MOST_LEVELS} systems in "
                "each other are read. No diagram that is drawn has so many."
            )
        if reference is not None:
            return self._referenced(reference, path, scope)
        drawn, without = list[XmlElement](), list[XmlElement]()
        for one in element.all("Block"):
            (without if one.property_of("Commented") == "on" else drawn).append(one)
        self.commented += (path_of(*path, one.attributes.get("Name", "")) for one in without)
        blocks = tuple(self._block(one, part, path, scope) for one in drawn)
        out = {self._sids + one.attributes.get("SID", "") for one in without}
        lines = (line for one in element.all("Line") for line in self._lines(one, part))
        return DrawnSystem(blocks, tuple(one for one in lines if not {one.source, one.target} & out), part)

    def _referenced(self, reference: str, path: tuple[str, ...], scope: MaskScope) -> DrawnSystem:
        part = f"simulink/systems/{reference}.xml"
        if part in self._read:
            raise ModelError(
                f"{self._file.place(part)}: the system is in itself, or in two blocks. Save the model "
                "again in Simulink."
            )
        self._read.add(part)
        system = self._file.xml(part)
        if "Ref" in system.attributes:
            raise ModelError(
                f"{self._file.place(part)}: in place of a system it has the name of another one. Save the "
                "model again in Simulink."
            )
        return self._system(system, part, path, scope)

    def _block(
        self, one: XmlElement, part: str, path: tuple[str, ...], scope: MaskScope,
        given: Mapping[str, str] | None = None,
    ) -> DrawnBlock:  # fmt: skip
        """A block, of which a link to it may have ``given`` values of its mask."""
        name = one.attributes.get("Name", "")
        within = (*path, name)
        own_path = path_of(*within)
        self._letters[0] -= len(own_path) + (LINKED if self._sids else 0)
        if self._letters[0] < 0:
            raise ModelError(
                f"{self._file.place(part)}, line {one.line}: the paths of the blocks have more than "
                f"{MOST_LETTERS:,} letters. No diagram that is drawn has so many."
            )
        system, place = one.child("System"), self._file.place(part)
        kind = one.attributes.get("BlockType", "")
        parameters = {**self._file.defaults.get(kind, {}), **one.properties()}
        if kind == "Reference":
            instance = one.child("InstanceData")
            parameters |= {} if instance is None else instance.properties()
            if parameters.get("SourceBlock", "").startswith("simulink/"):
                kind = LIBRARY.get(parameters.get("SourceType", ""), kind)
                parameters["link"] = "known"
            elif (followed := self._followed(one, parameters, path, scope)) is not None:
                return followed
        for name in VALUES if scope else ():
            if name in parameters:
                parameters[name] = valued(parameters[name], scope, place, one.line)
        inner = scope_in(one, scope, place, given or {})
        if parameters.get("SFBlockType") in CHARTS:
            self.scopes[own_path] = inner
        counts = one.child("PortCounts")
        if counts is None:
            parameters |= _ports(parameters.get("Ports", ""))
        else:
            parameters |= {f"ports {key}": value for key, value in counts.attributes.items()}
        left, top, right, bottom = numbers(parameters.get("Position", ""), 4)
        return DrawnBlock(
            id=self._sids + one.attributes.get("SID", ""),
            kind=kind,
            name=name,
            path=own_path,
            parameters=parameters,
            signals=dict(_signals(one)),
            system=None if system is None else self._system(system, part, within, inner),
            chart=own_path if parameters.get("SFBlockType") in CHARTS else "",
            rectangle=(left, top, right - left, bottom - top),
            line=one.line,
        )

    def _followed(
        self, one: XmlElement, said: dict[str, str], path: tuple[str, ...], scope: MaskScope
    ) -> DrawnBlock | None:
        """The block of a library in place of a link to it; ``None``, and ``said`` why, if it stays a link."""
        source = said.get("SourceBlock", "")
        found = self._libraries.block(source) if source else None
        if found is None:
            return None
        if one.child("LinkData") is not None or said.get("LinkData"):
            said["link"] = "changed"
        elif found.element.attributes.get("BlockType") != "SubSystem":
            said["link"] = "plain"
        elif source in self._links:
            said["link"] = "itself"
        if "link" in said:
            return None
        number, name = self._sids + one.attributes.get("SID", ""), one.attributes.get("Name", "")
        reader = DiagramReader(found.library, self._libraries, self, number)
        reader._links = (*self._links, source)
        self.linked[path_of(*path, name)] = found
        element = replace(found.element, attributes={**found.element.attributes, "Name": name})
        made = reader._block(element, found.part, path, scope, said)
        left, top, right, bottom = numbers(said.get("Position", ""), 4)
        kept = {key: said[key] for key in ("Priority",) if key in said}
        return replace(
            made, id=number, parameters={**made.parameters, **kept}, line=one.line,
            rectangle=(left, top, right - left, bottom - top),
        )  # fmt: skip

    def _lines(self, one: XmlElement, part: str) -> Iterator[DrawnLine]:
        """A signal with all its branches; one that is not connected at an end is none."""
        source = self._end(one.property_of("Src"), one, part, ("out", "state"))
        if source is None:
            return
        for branch in one.every():
            if branch.tag in ("Line", "Branch"):
                target = self._end(branch.property_of("Dst"), branch, part, TARGETS)
                if target is not None:
                    yield DrawnLine(source[0], int(source[2] or 0), target[0], target[2] or target[1])

    def _end(
        self, text: str, one: XmlElement, part: str, kinds: tuple[str, ...]
    ) -> tuple[str, str, str] | None:
        """The block, the kind of port and its number; a port of another kind is none."""
        if not text:
            return None
        found = _END.fullmatch(text.strip())
        if found is None or found[2] not in kinds or (found[2] in ("in", "out")) != (found[3] is not None):
            raise ModelError(
                f"{self._file.place(part)}, line {one.line}: a signal ends at {text[:40]!r}, which is no "
                "port. Save the model again in Simulink."
            )
        return self._sids + found[1], found[2], found[3] or ""


def _signals(block: XmlElement) -> Iterator[tuple[str, str]]:
    """The names of the outputs of a block by number; older releases put the number into a property."""
    for ports in block.all("PortProperties"):
        for port in ports.all("Port"):
            if port.attributes.get("Type") == "out" and (name := port.property_of("Name")):
                yield port.attributes.get("Index", "1"), name
    for port in block.all("Port"):
        if name := port.property_of("Name"):
            yield port.property_of("PortNumber", "1"), name


def _ports(written: str) -> dict[str, str]:
    """How many ports of each kind a block has, of which older releases wrote a list."""
    counts = zip(PORTS, _COUNT.finditer(written), strict=False)
    return {f"ports {kind}": count[0] for kind, count in counts if int(count[0])}


__all__ = ["CONTROL", "DiagramReader"]
