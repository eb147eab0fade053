"""Places: where in the source a chart, a state, a transition or a property is written."""

import sys
from dataclasses import dataclass
from pathlib import Path

_ROOT = Path(__file__).parents[2]
"""The package, whose folders are those of this project."""
_WORDS = f"{__package__}."
"""Modules of the language: what they build is written elsewhere."""


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
    frame = sys._getframe(1)
    while True:
        name = frame.f_globals.get("__name__", "")
        if not name.startswith(_WORDS) and name not in beyond and name != "dataclasses":
            file = frame.f_code.co_filename
            return None if file.startswith("<") else Place(file, frame.f_lineno)
        if frame.f_back is None:
            return None
        frame = frame.f_back
