"""Files as bytes under their names, to be read on another machine as they are here."""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from math import inf
from pathlib import Path

OF_A_MODEL = (".py", ".toml")
"""Suffixes of the files that a model in Python is made of, or that lie beside it."""
OF_SOURCES = (".c", ".h", ".inc", ".toml")
"""Suffixes of the files that lie beside a file in C, or beside its map."""


class TooLarge(Exception):
    """Files that are not read, as they are so many bytes."""

    def __init__(self, size: int) -> None:
        self.size = size
        super().__init__(f"{size:,} bytes")


@dataclass(frozen=True)
class PackedFiles:
    """The contents of files, by where they are here, and the roots below which they lie there."""

    roots: tuple[Path, ...]
    contents: Mapping[Path, bytes]

    @staticmethod
    def of(paths: Iterable[Path], whole: Iterable[Path] = (), most: float = inf) -> "PackedFiles":
        """Some files and folders; of a folder, and beside a file in Python, what a model is made of.

        ``whole``: those of which all is wanted, of a file what it may be made of.  ``most``: bytes of all
        files together.  Raises ``OSError``, and ``TooLarge`` for more.
        """
        named, every = (tuple(path.absolute() for path in some) for some in (paths, whole))
        folders = (path if path.is_dir() else path.parent for path in (*named, *every))
        roots = tuple(dict.fromkeys(folders))
        files = [file for path in named for file in _files(path)] + [f for path in every for f in _all(path)]
        size = sum(file.stat().st_size for file in dict.fromkeys(files))
        if size > most:
            raise TooLarge(size)
        found = {file: file.read_bytes() for file in dict.fromkeys(files)}
        return PackedFiles(roots, found)

    def unpacked(self, folder: Path) -> None:
        """Write all files into a folder.  Raises ``OSError``."""
        for place, data in self.contents.items():
            target = self.place(place, folder)
            target.parent.mkdir(parents=True, exist_ok=True)
            target.write_bytes(data)

    def place(self, path: Path, folder: Path) -> Path:
        """Where a file or folder is that was unpacked into a folder."""
        whole = path.absolute()
        number, root = next((n, r) for n, r in enumerate(self.roots) if whole.is_relative_to(r))
        return folder / str(number) / whole.relative_to(root)

    def named_here(self, text: str, folder: Path) -> str:
        """A text about files that were unpacked into a folder, with their names here."""
        for number, root in reversed(list(enumerate(self.roots))):  # 10 before 1
            text = text.replace(str(folder / str(number)), str(root))
        return text


def _files(path: Path) -> Iterator[Path]:
    if path.is_dir():
        yield from (p for p in sorted(path.rglob("*")) if p.suffix in OF_A_MODEL and p.is_file())
    elif path.suffix == ".py":
        yield from (p for p in sorted(path.parent.iterdir()) if p.suffix in OF_A_MODEL and p.is_file())
    else:
        yield path


def _all(path: Path) -> Iterator[Path]:
    """All files of a folder; of a file in Python, or in C, with those beside it, and packages there."""
    if path.is_dir():
        yield from (p for p in sorted(path.rglob("*")) if p.is_file())
    elif path.suffix == ".py":
        yield from _files(path)
        for package in sorted(path.parent.glob("*/__init__.py")):
            yield from (p for p in sorted(package.parent.rglob("*")) if p.suffix in OF_A_MODEL)
    elif path.suffix in OF_SOURCES:
        yield from (p for p in sorted(path.parent.iterdir()) if p.suffix in OF_SOURCES and p.is_file())
    else:
        yield path


__all__ = ["PackedFiles", "TooLarge"]
