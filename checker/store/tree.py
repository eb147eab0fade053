"""Everything that can change what is said of the rover, as one key: all files, and what is installed."""

import platform
import sys
from collections.abc import Iterator
from hashlib import blake2b
from os import scandir
from pathlib import Path

from rovercheck.checker.store.versions import installed

_ROOT = Path(__file__).parents[2]
FOLDERS = ("checker", "properties", "spec_model")
"""The folders that commands about the rover read."""


def tree_key(root: Path = _ROOT) -> str:
    """The key of the files as they are now, also of data beside modules.  Raises ``OSError``."""
    made = blake2b(
        repr((sys.version, platform.machine(), sys.platform, installed())).encode(), digest_size=20
    )
    for name, contents in _files(root):
        made.update(b"%d:%b%d:" % (len(name), name, len(contents)))
        made.update(contents)
    return made.hexdigest()


def _files(root: Path) -> Iterator[tuple[bytes, bytes]]:
    """Every file by its path below the root, with its contents; none that Python itself writes."""
    todo = [str(root / folder) for folder in reversed(FOLDERS)]
    while todo:
        with scandir(todo.pop()) as found:
            entries = sorted(found, key=lambda entry: entry.name)
        for entry in entries:
            if entry.is_dir():
                todo += [entry.path] if entry.name != "__pycache__" else []
            else:
                with open(entry.path, "rb") as file:
                    yield entry.path[len(str(root)) :].encode("utf-8", "surrogateescape"), file.read()
