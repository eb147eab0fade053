"""A package of Simulink: a ZIP file of XML parts, read in memory, within bounds, and never unpacked."""

import zlib
from collections.abc import Iterator
from io import BytesIO
from pathlib import Path, PurePosixPath
from struct import error as StructError
from zipfile import ZIP_DEFLATED, ZIP_STORED, BadZipFile, LargeZipFile, ZipFile, ZipInfo

from rovercheck.checker.io.bounded import bounded_bytes
from rovercheck.checker.io.printable import one_line
from rovercheck.checker.simulink.xml import MOST_ELEMENTS, XmlElement, parsed
from rovercheck.spec_model.lang.errors import ModelError

MOST_BYTES = 128 << 20
"""Bytes of a package, and of all of its parts that are read, unpacked."""
MOST_PARTS = 20_000
LONGEST = 100
"""Letters of a name in a message."""
ENTRY = b"PK\x01\x02"
"""What an entry of the list of parts begins with."""
ONCE_MORE = "Save the model again in Simulink."

ENCRYPTED = 0x1
BROKEN = (
    BadZipFile, LargeZipFile, zlib.error, StructError, EOFError, OSError, NotImplementedError, RuntimeError,
    ValueError, OverflowError,
)  # fmt: skip
"""What reading a damaged ZIP file raises."""


class SimulinkPackage:
    """The parts of a package by their names.  Raises ``ModelError`` for a file that is none."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self._left = MOST_BYTES
        data = bounded_bytes(path, MOST_BYTES, "Name a file of Simulink, .slx or .sldd.")
        self._elements = MOST_ELEMENTS
        if data.count(ENTRY) > MOST_PARTS:  # before there is an object for each
            raise ModelError(f"{path}: more than {MOST_PARTS:,} parts in one package are not read.")
        try:
            self._zip = ZipFile(BytesIO(data))
            infos = self._zip.infolist()
        except BROKEN as error:
            raise ModelError(f"{path}: it is no package of Simulink: {_said(error)}. {ONCE_MORE}") from error
        self._infos: dict[str, ZipInfo] = {}
        for info in infos:
            self._add(info)

    def _add(self, info: ZipInfo) -> None:
        name = info.filename
        path = PurePosixPath(name)
        odd = "\\" in name or ":" in name or not name.isprintable()
        if odd or path.is_absolute() or ".." in path.parts:
            raise ModelError(f"{self.path}: {name[:LONGEST]!r} is no name of a part. {ONCE_MORE}")
        if name in self._infos:
            raise ModelError(f"{self.path}: the part {name[:LONGEST]} is there twice. {ONCE_MORE}")
        self._infos[name] = info

    def __contains__(self, name: str) -> bool:
        return name in self._infos

    def names(self, start: str = "") -> Iterator[str]:
        """The names of the parts that begin so."""
        return (name for name in self._infos if name.startswith(start))

    def place(self, name: str) -> str:
        """How a part is named in a message, of which a name may be in a file of a stranger."""
        return f"{self.path.name}, part {one_line(name[:LONGEST])}"

    def data(self, name: str) -> bytes:
        """A part as bytes.  Raises ``ModelError`` for one that is missing, damaged or too large."""
        info = self._infos.get(name)
        if info is None:
            raise ModelError(f"{self.place(name)}: it is missing. {ONCE_MORE}")
        if info.compress_type not in (ZIP_STORED, ZIP_DEFLATED) or info.flag_bits & ENCRYPTED:
            raise ModelError(
                f"{self.place(name)}: it is encrypted, or packed by a method that is not Simulink's. "
                f"{ONCE_MORE}"
            )
        try:
            with self._zip.open(info) as file:
                found = file.read(self._left + 1)
        except BROKEN as error:
            raise ModelError(f"{self.place(name)}: it is damaged: {_said(error)}. {ONCE_MORE}") from error
        if len(found) > self._left:
            raise ModelError(
                f"{self.place(name)}: more than {MOST_BYTES >> 20} MiB of parts, unpacked, are not read."
            )
        self._left -= len(found)
        return found

    def xml(self, name: str) -> XmlElement:
        """The root element of a part.  Raises ``ModelError``."""
        root, number = parsed(self.data(name), self.place(name), self._elements)
        self._elements -= number
        return root


def _said(error: BaseException) -> str:
    text = str(error).strip().rstrip(".")  # which may quote the file from there to its end
    return text if text.isprintable() and 0 < len(text) <= LONGEST else type(error).__name__


__all__ = ["SimulinkPackage"]
