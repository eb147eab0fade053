"""The four firmwares, and what is planted in them: changes of the source text."""

import tomllib
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

from benchmarks.measure import ROOT
from rovercheck.checker.compare.beside import writers
from rovercheck.spec_model.abstraction import Board, boards

HERE = Path(__file__).parent
SUPERVISOR = ROOT / "rovercheck" / "supervisor"
PACKAGE = "rovercheck.supervisor"


MAIN = """\
import sys

import rovercheck

rovercheck.__path__.insert(0, {folder!r})
for known in [name for name in sys.modules if name == {package!r} or name.startswith({package!r} + ".")]:
    del sys.modules[known]
from {package}.{board}.board import {name}
"""


class PlantingError(Exception):
    """A difference cannot be planted: its text is not there, or more than once."""


@dataclass(frozen=True)
class Planted:
    """A difference from the charts, as a change of the source text of a firmware.

    ``edits`` are a file, the text that stands there exactly once, and what replaces it.  ``parts`` are the
    charts and blocks of the model in which it arises, one of them or several; ``outputs`` the signals in
    which it shows, where only some of those of its parts do.  ``tags`` say whether it shows in the first
    step, hides others, is shared memory, or is in the task.  ``cause`` is a regular expression for what a
    right cause says.
    """

    id: str
    kind: str
    says: str
    parts: tuple[str, ...]
    edits: tuple[tuple[str, str, str], ...]
    tags: tuple[str, ...] = ()
    outputs: tuple[str, ...] = ()
    cause: str = ""

    def own_outputs(self, board: Board) -> frozenset[str]:
        """The outputs that its parts decide: they write them, or what writes them reads the part alone."""
        if self.outputs:
            return frozenset(self.outputs)
        deciding = {*self.parts, *(READERS[part] for part in self.parts if part in READERS)}
        return frozenset(name for name, (_, part) in writers(board).items() if part in deciding)

    def is_named_in(self, part: str) -> bool:
        """Whether what a report says of a part, or of what decides it, names one of its parts."""
        return any(name in part for own in self.parts for name in (own, READERS.get(own, own)))


READERS: Mapping[str, str] = {
    "updateSafetyLimits": "Motion_Supervision",
    "checkStop": "Motion_Supervision",
    "Obstacles": "TranslateDecision",
    "ObstaclesDegraded": "TranslateDecision",
    "ObstaclesDriving": "Obstacle_command",
    "Coherence.rotation": "Coherence.result",
    "Coherence.short": "Coherence.result",
    "Coherence.long": "Coherence.result",
}
"""Parts without an output of a board, and the part in whose outputs they show."""


@dataclass(frozen=True)
class Firmware:
    """A supervisor that conforms to the charts, in C or in Python."""

    name: str
    board_name: str
    language: str

    @property
    def board(self) -> Board:
        return boards()[self.board_name]

    @property
    def differences(self) -> tuple[Planted, ...]:
        """What makes it a twin."""
        return _planted(self.name)["difference"]

    @property
    def further(self) -> tuple[Planted, ...]:
        """Faults to plant on top of the others."""
        return _planted(self.name)["further"]

    def sources(self) -> dict[str, str]:
        """The texts of its files, by their place in its folder."""
        folder = HERE / "firmware" / self.name if self.language == "c" else SUPERVISOR
        files = sorted(f for f in folder.rglob("*") if f.suffix in (".c", ".h", ".toml", ".py"))
        names = {str(own): f for f in files if "bench" not in (own := f.relative_to(folder)).parts}
        return {name: f.read_text(encoding="utf-8") for name, f in names.items()}

    def written(self, folder: Path, planted: Iterable[Planted] = ()) -> str:
        """Writes it with these differences into a folder, and gives its address for ``--impl``.

        Raises ``PlantingError``.
        """
        texts = changed(self.sources(), planted)
        folder.mkdir(parents=True, exist_ok=True)
        root = folder if self.language == "c" else folder / "supervisor"
        for name, text in texts.items():
            place = root / name
            place.parent.mkdir(parents=True, exist_ok=True)
            place.write_text(text, encoding="utf-8")
        return f"c:{folder}" if self.language == "c" else self._main(folder)

    def _main(self, folder: Path) -> str:
        """The module that starts a supervisor in Python: in its process the package is that here."""
        name = self.board_name.capitalize()
        main = folder / "main.py"
        text = MAIN.format(folder=str(folder.resolve()), package=PACKAGE, board=self.board_name, name=name)
        main.write_text(text, encoding="utf-8")
        return f"python:{main}:{name}"


FIRMWARES: Mapping[str, Firmware] = {
    f.name: f
    for f in (
        Firmware("board1_c", "board1", "c"),
        Firmware("board2_c", "board2", "c"),
        Firmware("board1_py", "board1", "python"),
        Firmware("board2_py", "board2", "python"),
    )
}


def changed(texts: Mapping[str, str], planted: Iterable[Planted]) -> dict[str, str]:
    """The texts with differences planted one after the other.  Raises ``PlantingError``."""
    found = dict(texts)
    for one in planted:
        for file, old, new in one.edits:
            times = found.get(file, "").count(old)
            if times != 1:
                raise PlantingError(f"{one.id}: {old!r} is {times} times in {file}; it must be there once.")
            found[file] = found[file].replace(old, new)
    return found


@cache
def _planted(firmware: str) -> Mapping[str, tuple[Planted, ...]]:
    text = (HERE / "planted" / f"{firmware}.toml").read_text(encoding="utf-8")
    return {key: tuple(map(_one, rows)) for key, rows in tomllib.loads(text).items()}


def _one(row: Mapping[str, Any]) -> Planted:
    edits: Sequence[Sequence[str]] = row["edits"]
    return Planted(
        row["id"],
        row["kind"],
        row["says"],
        tuple(row["parts"]),
        tuple((file, old, new) for file, old, new in edits),
        tuple(row.get("tags", ())),
        tuple(row.get("outputs", ())),
        row.get("cause", ""),
    )
