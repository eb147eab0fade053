"""Runs kept as plain data: held blocks in JSON, concrete inputs step by step in CSV or JSON."""

import csv
import json
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from importlib.resources import files
from pathlib import Path
from typing import cast

from rovercheck.checker.adapters.implementation import Value
from rovercheck.checker.compare.beside import ComparedStep, played, rerun
from rovercheck.checker.compare.search import Run
from rovercheck.checker.compare.smaller import columns
from rovercheck.checker.compare.stimulus import SILENT, Change, Every, InputBlock, Stimulus
from rovercheck.checker.io.files import csv_plain
from rovercheck.spec_model.abstraction import Board
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.system import TICK_MS

COUNTEREXAMPLES = "counterexamples.json"
"""The runs with which the model checker broke properties or showed that something can be reached.

They are inputs only: what the charts do under them is computed anew.
"""


_Blocks = Sequence[tuple[int, Mapping[str, Value | None]]]


@dataclass(frozen=True)
class KeptSuite:
    """A stimulus, and where it comes from."""

    origin: str
    stimulus: Stimulus


def counterexamples(board: Board) -> Iterator[Run]:
    """The model checker's runs on a board, as the charts go through them now."""
    text = files(__package__).joinpath(COUNTEREXAMPLES).read_text(encoding="utf-8")
    for kept in decoded(json.loads(text), board):
        yield kept.origin, played(board, {}, kept.stimulus)


def kept(origin: str, board: Board, run: Iterable[Mapping[str, int]]) -> KeptSuite:
    """A run of the model as concrete inputs of a board."""
    return KeptSuite(origin, columns(board, list(board.run(iter(run)))).stimulus())


def encoded(runs: Mapping[str, Sequence[KeptSuite]]) -> str:
    """The runs of each board as JSON, one run a line."""
    parts = []
    for name, of_board in runs.items():
        lines = ",\n".join("  " + json.dumps(_plain(one), separators=(",", ":")) for one in of_board)
        parts.append(f"{json.dumps(name)}: [\n{lines}\n]")
    return "{\n" + ",\n".join(parts) + "\n}\n"


def _plain(one: KeptSuite) -> dict[str, object]:
    blocks = [[b.steps, {name: _encoded(c) for name, c in b.changes}] for b in one.stimulus.blocks]
    return {"origin": one.origin, "blocks": blocks}


def _encoded(change: Change) -> object:
    """A stamp that is renewed in every step as its lag, a silent one as null."""
    if isinstance(change, Every):
        return change.lags_ms[0] if change.gaps else None
    return change


def decoded(text: Mapping[str, Sequence[Mapping[str, object]]], board: Board) -> Iterator[KeptSuite]:
    """The runs of one board."""
    stamps = {s.name for s in board.inputs if s.stamp}
    for one in text.get(board.name, ()):
        blocks = []
        for steps, changes in cast(_Blocks, one["blocks"]):
            changed = tuple((name, _change(name in stamps, value)) for name, value in changes.items())
            blocks.append(InputBlock(steps, changed))
        yield KeptSuite(str(one["origin"]), Stimulus(tuple(blocks), TICK_MS))


def _change(stamp: bool, value: Value | None) -> Change:
    if value is None:
        return SILENT
    return Every((1,), (int(value),)) if stamp else value


# --- folders of tests -------------------------------------------------------------------------------


def tests(folder: Path, board: Board) -> Iterator[Run]:
    """The tests in a folder: of each file the inputs of a board, step by step; its outputs are not read.

    A file belongs to the board whose inputs it has.  Raises ``ModelError`` for one that cannot be read.
    """
    for file in sorted([*folder.rglob("*.csv"), *folder.rglob("*.json")]):
        rows = _rows(file)
        if rows and {s.name for s in board.inputs} <= rows[0].keys():
            yield f"{file.name}", _steps(file, board, rows)


def _rows(file: Path) -> list[dict[str, object]]:
    try:
        text = file.read_text(encoding="utf-8")
        found = _table(text) if file.suffix == ".csv" else json.loads(text)
    except (OSError, ValueError, csv.Error) as error:
        raise ModelError(f"{file}: {error}. Write one step a line, with the inputs by name.") from error
    steps = found.get("steps", []) if isinstance(found, dict) else found
    if not (isinstance(steps, list) and all(isinstance(row, dict) for row in steps)):
        raise ModelError(f"{file} holds no list of steps; write the inputs of each step by name.")
    return steps


def _table(text: str) -> list[dict[str, object]]:
    names, *rows = csv.reader(text.splitlines()) if text.strip() else [[]]
    return [dict(zip(map(csv_plain, names), row, strict=False)) for row in rows if row]


def _steps(file: Path, board: Board, rows: Sequence[Mapping[str, object]]) -> list[ComparedStep]:
    inputs = []
    for number, row in enumerate(rows, 1):
        try:
            inputs.append({s.name: _number(row[s.name]) for s in board.inputs})
        except (KeyError, TypeError, ValueError) as error:
            raise ModelError(f"{file}, step {number}: {error!r}. Write a number for each input.") from error
    columns(board, inputs)
    return rerun(board, inputs)


def _number(value: object) -> Value:
    if isinstance(value, bool | int | float):
        return value
    text = str(value).strip().lower()
    if text in ("true", "false"):
        return text == "true"
    number = float(text)
    return int(number) if number.is_integer() else number
