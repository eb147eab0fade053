"""Runs kept as plain data: rows of equal steps in JSON, concrete inputs step by step in CSV or JSON."""

import csv
import json
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from importlib.resources import files
from pathlib import Path
from typing import Any

from rovercheck.checker.adapters.implementation import Value
from rovercheck.checker.compare.beside import ComparedStep, Run, rerun
from rovercheck.checker.io.files import csv_plain
from rovercheck.checker.testgen.scripts import Script, blocks, script, steps, unfolded
from rovercheck.spec_model.abstraction import Board, boards
from rovercheck.spec_model.lang.errors import ModelError

COUNTEREXAMPLES = "counterexamples.json"
"""The runs with which the model checker broke properties or showed that something can be reached.

They are inputs only: what the charts do under them is computed anew.
"""


@dataclass(frozen=True)
class KeptSuite:
    """The inputs of a run, and where it comes from."""

    origin: str
    script: Script


def counterexamples(board: Board) -> Iterator[Run]:
    """The model checker's runs on a board, as the charts go through them now."""
    text = files(__package__).joinpath(COUNTEREXAMPLES).read_text(encoding="utf-8")
    for kept in decoded(json.loads(text), board):
        yield kept.origin, rerun(board, steps(board, kept.script))


def kept(origin: str, board: Board, run: Iterable[Mapping[str, int]]) -> KeptSuite:
    """A run of the model as inputs of a board."""
    return KeptSuite(origin, script(board, list(board.run(iter(run)))))


def encoded(runs: Mapping[str, Sequence[KeptSuite]]) -> str:
    """The runs of each board as JSON, one run a line."""
    parts = []
    for name, of_board in runs.items():
        plain = ({"origin": one.origin, "blocks": blocks(boards()[name], one.script)} for one in of_board)
        lines = ",\n".join("  " + json.dumps(one, separators=(",", ":")) for one in plain)
        parts.append(f"{json.dumps(name)}: [\n{lines}\n]")
    return "{\n" + ",\n".join(parts) + "\n}\n"


def decoded(text: Mapping[str, Sequence[Mapping[str, Any]]], board: Board) -> Iterator[KeptSuite]:
    """The runs of one board."""
    for one in text.get(board.name, ()):
        yield KeptSuite(one["origin"], unfolded(board, one["blocks"]))


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
    script(board, inputs)  # refuses steps that are not 20 ms apart
    return rerun(board, inputs)


def _number(value: object) -> Value:
    if isinstance(value, bool | int | float):
        return value
    text = str(value).strip().lower()
    if text in ("true", "false"):
        return text == "true"
    number = float(text)
    return int(number) if number.is_integer() else number
