"""Where to look in an implementation for an output that is wrong."""

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from rovercheck.checker.adapters.c import sources_and_map
from rovercheck.checker.adapters.c_map import CMap, read
from rovercheck.checker.adapters.implementation import ImplementationError
from rovercheck.spec_model.abstraction import Board
from rovercheck.spec_model.lang.place import Place


@dataclass(frozen=True)
class ImplementationPlaces:
    """The places of an implementation at an address ``KIND:WHAT``; of some kinds nothing is known."""

    address: str
    board: Board

    def of(self, outputs: Sequence[str]) -> tuple[Place, ...]:
        """For outputs, the lines of C that assign them, else their lines in the map; of Python the class."""
        kind, _, what = self.address.partition(":")
        if kind == "python":
            return tuple(_in_python(what))
        if kind != "c":
            return ()
        return tuple(dict.fromkeys(self._assigned(outputs))) or tuple(self._mapped(outputs))

    @cached_property
    def _c(self) -> tuple[Path, CMap] | None:
        path, file = sources_and_map(self.address.partition(":")[2])
        try:
            return path.absolute(), read(file.absolute(), self.board)
        except ImplementationError:  # changed or gone since it was started
            return None

    def _assigned(self, outputs: Sequence[str]) -> Iterator[Place]:
        from rovercheck.checker.mapping.output_lines import assigning_lines

        if self._c is None:
            return
        path, c = self._c
        for name in outputs:
            for place in (one for one in c.outputs if one.signal == name):
                try:
                    yield from assigning_lines(path, place.at)
                except (ImportError, OSError):  # without the extra, or gone meanwhile: the map says where
                    return

    def _mapped(self, outputs: Sequence[str]) -> Iterator[Place]:
        if self._c is None:
            return
        file = self._c[1].file
        try:
            lines = file.read_text(encoding="utf-8").splitlines()
        except (OSError, UnicodeDecodeError):
            return
        section = next((n for n, line in enumerate(lines) if line.strip() == "[outputs]"), 0)
        for name in outputs:
            entry = re.compile(rf"""\s*["']?{re.escape(name)}["']?\s*=""")
            found = next((n for n, line in enumerate(lines) if n >= section and entry.match(line)), section)
            yield Place(str(file), found + 1)


def _in_python(what: str) -> Iterator[Place]:
    """The line of the class or function, of an address with a file."""
    written, _, name = what.rpartition(":")
    file = Path(written)
    if file.suffix != ".py" or not file.is_file():
        return
    try:
        lines = file.read_text(encoding="utf-8").splitlines()
    except (OSError, UnicodeDecodeError):
        return
    head = re.compile(rf"\s*(class|def)\s+{re.escape(name)}\b")
    yield Place(str(file.absolute()), next((n for n, line in enumerate(lines, 1) if head.match(line)), 1))


__all__ = ["ImplementationPlaces"]
