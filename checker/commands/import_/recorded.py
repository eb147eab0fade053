"""``rovercheck import --compare``: a model beside recorded inputs and outputs, row by row."""

import csv
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from math import isnan
from pathlib import Path

from rovercheck.checker.commands.shared.codes import UsageError
from rovercheck.checker.drawn.faults import DrawnFault
from rovercheck.checker.drawn.interpret.diagram import ModelRunner
from rovercheck.checker.drawn.records import DrawnModel
from rovercheck.checker.io.files import csv_plain
from rovercheck.spec_model.lang.errors import ModelError

NEAR = 1e-9
"""Relative difference up to which two numbers that are no integers count as one."""


@dataclass(frozen=True)
class RowDifference:
    """A row of a recording in which a model gives something else: by output what is recorded and given.

    ``fired`` are the transitions that the model takes in it.
    """

    row: int
    line: int
    values: Mapping[str, tuple[float, float]]
    fired: Sequence[str]


@dataclass(frozen=True)
class RecordingComparison:
    """A recording beside a model: how many rows, which outputs were compared, and where they differ."""

    rows: int
    outputs: tuple[str, ...]
    missing: tuple[str, ...]
    """Outputs that the recording does not have."""
    differences: tuple[RowDifference, ...]


def compared_with(model: DrawnModel, log: Path) -> RecordingComparison:
    """Run a model on recorded inputs.  Raises ``UsageError`` for a log, ``ModelError`` for a model."""
    runner = _runner(model)
    inputs = list(runner.inputs())
    found: list[RowDifference] = []
    rows = 0
    outputs, missing = tuple[str, ...](), tuple[str, ...]()
    for line, given in _rows(log, inputs):
        try:
            made = runner.step({name: given[name] for name in inputs})
        except DrawnFault as fault:
            raise ModelError(f"{model.name}, row {rows} of {log.name}: {fault}.") from fault
        if rows == 0:
            outputs = tuple(name for name in made if name in given)
            missing = tuple(name for name in made if name not in given)
        wrong = {name: (given[name], made[name]) for name in outputs if not _alike(given[name], made[name])}
        if wrong:
            found.append(RowDifference(rows, line, wrong, runner.fired))
        rows += 1
    if not outputs:
        raise UsageError(
            f"{log}: it has no row, or none of the outputs {', '.join(runner.outputs())}. Write a column for "
            "each, as for the inputs."
        )
    return RecordingComparison(rows, outputs, missing, tuple(found))


def _runner(model: DrawnModel) -> ModelRunner:
    try:
        return ModelRunner(model)
    except DrawnFault as fault:
        raise ModelError(f"{model.name}: {fault}.") from fault


def _alike(one: float, other: float) -> bool:
    if isnan(one) or isnan(other):
        return isnan(one) and isnan(other)
    return one == other or abs(one - other) <= NEAR * max(abs(one), abs(other))


def _rows(log: Path, inputs: Sequence[str]) -> Iterator[tuple[int, dict[str, float]]]:
    """The rows of a log with their lines, columns by name.  Raises ``UsageError``."""
    try:
        with log.open(encoding="utf-8", newline="") as file:
            table = csv.reader(file)
            head = [csv_plain(name).strip() for name in next(table, [])]
            if lacking := [name for name in inputs if name not in head]:
                wanted = ", ".join(inputs)
                raise UsageError(f"{log}: it has no column {lacking[0]}; write one for each of {wanted}.")
            for row in table:
                line = table.line_num
                if row and len(row) < len(head):
                    raise UsageError(f"{log}, line {line}: {len(row)} cells, and {len(head)} columns.")
                if row:
                    cells = zip(head, row, strict=False)
                    yield line, {name: _number(log, line, name, cell) for name, cell in cells}
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        why = error.strerror if isinstance(error, OSError) else error
        raise UsageError(f"{log}: {why}. Name a table of comma-separated values.") from error


def _number(log: Path, line: int, name: str, cell: str) -> float:
    text = cell.strip().lower()
    if text in ("true", "false"):
        return float(text == "true")
    try:
        return float(text)
    except ValueError:
        raise UsageError(f"{log}, line {line}: {name} is {cell!r}, and no number.") from None


__all__ = ["RecordingComparison", "RowDifference", "compared_with"]
