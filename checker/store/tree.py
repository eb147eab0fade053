"""Everything that can change what is said of the rover, as one key: all files, and what is installed."""

import platform
import sys
from collections.abc import Iterator, Sequence
from hashlib import blake2b
from os import scandir
from pathlib import Path

from rovercheck.checker.store.versions import changed, installed

_ROOT = Path(__file__).parents[2]
FOLDERS = ("checker", "properties", "spec_model")
"""The folders that commands about the rover read."""
CODE = ("checker", "spec_model/lang")
"""Those of them that hold no chart and no property."""


def tree_key(root: Path = _ROOT, folders: Sequence[str] = FOLDERS) -> str:
    """The key of the files as they are now, also of data beside modules.  Raises ``OSError``."""
    made = blake2b(
        repr((sys.version, platform.machine(), sys.platform, installed())).encode(), digest_size=20
    )
    for name, contents in _files(root, folders):
        made.update(b"%d:%b%d:" % (len(name), name, len(contents)))
        made.update(contents)
    return made.hexdigest()


def as_loaded(root: Path = _ROOT, folders: Sequence[str] = CODE) -> bool:
    """Whether no such file has changed since this process was started."""
    try:
        return not any(map(changed, _paths(root, folders)))
    except OSError:
        return False


def _files(root: Path, folders: Sequence[str]) -> Iterator[tuple[bytes, bytes]]:
    """Every file by its path below the root, with its contents."""
    for path in _paths(root, folders):
        with open(path, "rb") as file:
            yield path[len(str(root)) :].encode("utf-8", "surrogateescape"), file.read()


def _paths(root: Path, folders: Sequence[str]) -> Iterator[str]:
    """Every file, in order; none that Python itself writes."""
    todo = [str(root / folder) for folder in reversed(folders)]
    while todo:
        with scandir(todo.pop()) as found:
            entries = sorted(found, key=lambda entry: entry.name)
        for entry in entries:
            if entry.is_dir():
                todo += [entry.path] if entry.name != "__pycache__" else []
            else:
                yield entry.path
