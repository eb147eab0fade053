"""Runs a supervisor in C, as sources or as a shared object: ``c:PATH``, ``c:PATH,map=FILE``."""

import tempfile
from collections.abc import Callable
from dataclasses import asdict
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from rovercheck.checker.adapters import LIMITS, AdapterLimits, c_calls
from rovercheck.checker.adapters.c_build import built, in_one_line, is_library
from rovercheck.checker.adapters.c_map import CMap, read
from rovercheck.checker.adapters.implementation import Implementation, ImplementationError
from rovercheck.checker.adapters.process import Process, ours

if TYPE_CHECKING:
    from rovercheck.spec_model.abstraction import Board

KIND = "c"
FORM = "c:PATH[,map=FILE]"
SUMMARY = "C sources (a file, a folder) or a shared object"


def start(what: str, board: "Board", limits: AdapterLimits = LIMITS) -> Implementation:
    """The supervisor, compiled with what its mapping file says.

    Raises ``ImplementationError`` if it cannot be compiled or started.
    """
    path, file = sources_and_map(what)
    if not path.exists():
        raise ImplementationError(
            f"c:{what}: there is no {path}; write a C file, a folder or a shared object."
        )
    if not (path.is_dir() or path.suffix == ".c" or is_library(path)):
        raise ImplementationError(
            f"c:{what}: {path.name} is neither a C file (.c), a folder nor a shared object."
        )
    c = read(file, board)
    return CompiledC(f"c:{what}", path, c, board, limits)


def sources_and_map(what: str) -> tuple[Path, Path]:
    """What an address without its kind names: sources or a shared object, and the mapping file."""
    written, _, file = what.partition(",map=")
    path = Path(written)
    return path, Path(file) if file else _beside(path)


def carried(what: str) -> tuple[Path, ...]:
    """The sources or the shared object, and the mapping file."""
    return sources_and_map(what)


def moved(what: str, there: Callable[[Path], Path]) -> str:
    """The address of sources and a mapping file that are elsewhere."""
    path, file = sources_and_map(what)
    return f"{there(path)},map={there(file)}"


class CompiledC(Process):
    """A compiled supervisor; what was compiled is deleted when it is closed."""

    def __init__(self, address: str, path: Path, c: CMap, board: "Board", limits: AdapterLimits) -> None:
        self._folder = tempfile.TemporaryDirectory(prefix="rovercheck-")
        try:
            library, warnings = built(path, c, Path(self._folder.name), limits.flags)
            connect = partial(
                ours, c_calls.__name__, {**_options(library, path, c), "hostile": limits.hostile}, limits
            )
            names = [o.name for o in board.outputs]
            super().__init__(address, connect, names, limits, _notes(c, board, warnings))
        except BaseException:
            self._folder.cleanup()
            raise

    def close(self) -> None:
        """End the process, and delete what was compiled."""
        super().close()
        self._folder.cleanup()


def _options(library: Path, path: Path, c: CMap) -> dict[str, object]:
    return {
        "library": str(library),
        "before": str(path.resolve()) if is_library(path) else "",
        "inputs": [asdict(place) for place in c.inputs],
        "outputs": [asdict(place) for place in c.outputs],
    }


def _beside(path: Path) -> Path:
    """The mapping file when none is named: with the same name, or ``map.toml``."""
    if path.is_dir():
        return path / "map.toml"
    same = path.with_suffix(".toml")
    return same if same.is_file() else path.parent / "map.toml"


def _notes(c: CMap, board: "Board", warnings: str) -> list[str]:
    """What a person should know: what it is not given, and what the compiler warned of."""
    inputs = {place.signal for place in c.inputs}
    unread = [s.name for s in board.inputs if s.name not in inputs]
    found = (
        [f"{c.file}: inputs without a place, which it is not given: {', '.join(unread)}"] if unread else []
    )
    return [*found, in_one_line(warnings)] if warnings else found
