"""One CSV file a test: the time, the inputs and the outputs required, a row for each step."""

import csv
from collections.abc import Iterator, Mapping, Sequence
from io import StringIO

from rovercheck.checker.io.files import csv_cell
from rovercheck.checker.testgen.formats.expected_outputs import ExpectedTest
from rovercheck.spec_model.abstraction import Board, Value
from rovercheck.spec_model.abstraction.stamps import NOW

TIME = "time_ms"
GOALS = "goals.csv"


def csv_files(board: Board, tests: Sequence[ExpectedTest]) -> Mapping[str, str]:
    """A file for each test, and one that lists the goals of each."""
    files = {f"{test.name}.csv": _text(_table(board, test)) for test in tests}
    pairs = [[test.name, csv_cell(goal)] for test in tests for goal in test.goals]
    return {**files, f"{board.name}_{GOALS}": _text([["test", "goal"], *pairs])}


def _table(board: Board, test: ExpectedTest) -> Iterator[list[str]]:
    inputs = [s.name for s in board.inputs if s.name != NOW]
    outputs = [o.name for o in board.outputs]
    yield [TIME, *map(csv_cell, (*inputs, *outputs))]
    for given, required in zip(test.inputs, test.outputs, strict=True):
        cells = [given[n] for n in (NOW, *inputs)] + [required.get(n) for n in outputs]
        yield [_cell(value) for value in cells]


def _cell(value: Value | None) -> str:
    """A truth value is 0 or 1, an output left open is empty."""
    if value is None:
        return ""
    return str(int(value)) if isinstance(value, bool) else repr(value)


def _text(table: Iterator[list[str]] | Sequence[list[str]]) -> str:
    out = StringIO()
    csv.writer(out, lineterminator="\n").writerows(table)
    return out.getvalue()
