"""Places: where in the source a chart, a state, a transition or a property is written."""

import sys
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import islice
from pathlib import Path
from types import FrameType

_ROOT = Path(__file__).parents[2]
"""The package, whose folders are those of this project."""
_WORDS = f"{__package__}."
"""Modules of the language: what they build is written elsewhere."""


CallExtent = tuple[tuple[int, int], tuple[int, int]]


@dataclass(frozen=True, slots=True)
class Place:
    """A line, from 1, of a file; the file as Python names it, usually with its whole path."""

    file: str
    line: int

    @property
    def path(self) -> str:
        """The file with ``/`` between folders, as seen from this project or the user's repository.

        A file in neither keeps its whole path.
        """
        file = Path(self.file)
        for folder in (_ROOT, _repository(Path.cwd())):
            if file.is_relative_to(folder):
                return file.relative_to(folder).as_posix()
        return file.as_posix()

    def __str__(self) -> str:
        return f"{self.path}:{self.line}"


def _repository(working: Path) -> Path:
    """The working directory, or the folder around it that holds the history of its files."""
    return next((f for f in (working, *working.parents) if (f / ".git").exists()), working)


def here(*beyond: str) -> Place | None:
    """The first caller that is no module of the language, nor one of the modules named.

    Nowhere if there is none, as at an interactive prompt.
    """
    frame = _caller(beyond)
    file = "<" if frame is None else frame.f_code.co_filename
    return None if frame is None or file.startswith("<") else Place(file, frame.f_lineno)


def call_extent() -> CallExtent:
    """Where the call of that caller begins and ends: lines from 1, bytes from 0; zeros where nobody knows."""
    frame = _caller(())
    if frame is None:
        return (0, 0), (0, 0)
    positions = islice(frame.f_code.co_positions(), frame.f_lasti // 2, None)
    first, last, start, end = next(positions, (0, 0, 0, 0))
    return (first or 0, start or 0), (last or 0, end or 0)


def _caller(beyond: Sequence[str]) -> FrameType | None:
    frame: FrameType | None = sys._getframe(2)
    while frame is not None:
        name = frame.f_globals.get("__name__", "")
        if not name.startswith(_WORDS) and name not in beyond and name != "dataclasses":
            return frame
        frame = frame.f_back
    return None
