"""Links to libraries: the file of a library, and the block in it that a link stands for."""

import re
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path

from rovercheck.checker.drawn.records import names_of, path_of
from rovercheck.checker.simulink.dictionary import is_file
from rovercheck.checker.simulink.opened import DIAGRAM, OpenedFile
from rovercheck.checker.simulink.xml import XmlElement

_NAME = re.compile(r"\w{1,200}")


@dataclass(frozen=True)
class LinkedBlock:
    """A block of a library: its path there, its element, and the part that this stands in."""

    library: OpenedFile
    path: str
    element: XmlElement
    part: str


@dataclass
class Libraries:
    """Those of a model: in its folder, or among the files that a user names ``beside`` it."""

    folder: Path
    beside: Sequence[Path] = ()
    opened: dict[str, OpenedFile | None] = field(default_factory=dict)

    def block(self, source: str) -> LinkedBlock | None:
        """What a link leads to, ``library/block``; ``None``: nothing that is in a file here."""
        name, *names = names_of(source)
        library = self._library(name)
        if library is None or not names:
            return None
        part, system = DIAGRAM, library.model.child("System")
        own, element = list[str](), None
        for one in names:
            part, system = _referenced(library, part, system)
            blocks = () if system is None else system.all("Block")
            element = next((b for b in blocks if _plain(b.attributes.get("Name", "")) == _plain(one)), None)
            if element is None:
                return None
            own.append(element.attributes.get("Name", ""))
            where, system = part, element.child("System")
        return None if element is None else LinkedBlock(library, path_of(*own), element, where)

    def _library(self, name: str) -> OpenedFile | None:
        if name not in self.opened:
            named = [one for one in self.beside if one.name == f"{name}.slx"]
            found = named or ([self.folder / f"{name}.slx"] if _NAME.fullmatch(name) else [])
            self.opened[name] = OpenedFile.of(found[0]) if found and is_file(found[0]) else None
        return self.opened[name]

    @property
    def used(self) -> list[OpenedFile]:
        """Those to which there are links."""
        return [one for one in self.opened.values() if one is not None]


def _referenced(library: OpenedFile, part: str, system: XmlElement | None) -> tuple[str, XmlElement | None]:
    """A system, which may stand in a part of its own."""
    if system is None or (reference := system.attributes.get("Ref")) is None:
        return part, system
    own = f"simulink/systems/{reference}.xml"
    return own, library.xml(own)


def _plain(name: str) -> str:
    return " ".join(name.split())


__all__ = ["Libraries", "LinkedBlock"]
