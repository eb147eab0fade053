"""Files as bytes under their names, to be read on another machine as they are here."""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

OF_A_MODEL = (".py", ".toml")
"""Suffixes of the files that a model in Python is made of, or that lie beside it."""


@dataclass(frozen=True)
class PackedFiles:
    """The contents of files, by where they are here, and the roots below which they lie there."""

    roots: tuple[Path, ...]
    contents: Mapping[Path, bytes]

    @staticmethod
    def of(paths: Iterable[Path]) -> "PackedFiles":
        """Some files and folders; of a folder, and beside a file in Python, what a model is made of.

        Raises ``OSError``.
        """
        named = tuple(path.absolute() for path in paths)
        roots = tuple(dict.fromkeys(path if path.is_dir() else path.parent for path in named))
        found = {file: file.read_bytes() for path in named for file in _files(path)}
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


def _files(path: Path) -> Iterator[Path]:
    if path.is_dir():
        yield from (p for p in sorted(path.rglob("*")) if p.suffix in OF_A_MODEL and p.is_file())
    elif path.suffix == ".py":
        yield from (p for p in sorted(path.parent.iterdir()) if p.suffix in OF_A_MODEL and p.is_file())
    else:
        yield path


__all__ = ["PackedFiles"]
