"""A test as comma-separated values: the time, the inputs and the outputs required, a line for each step."""

import csv
from collections.abc import Iterable
from io import StringIO

from rovercheck.checker.board_tests.rows import clock_of
from rovercheck.checker.io.files import csv_cell
from rovercheck.checker.results.board_test import BoardTest, Value

TIME = "time_ms"


def csv_table(test: BoardTest) -> str:
    """The table with a line of names; a truth value is 0 or 1, an output left open an empty cell."""
    clock = clock_of(test.board.inputs)
    inputs = [s.name for s in test.board.inputs if s.name != clock]
    outputs = [o.name for o in test.board.outputs]
    lines = [[TIME, *map(csv_cell, (*inputs, *outputs))]]
    for step in test.steps:
        given = [step.inputs[name] for name in (clock, *inputs)]
        lines.append([_cell(value) for value in (*given, *map(step.outputs.get, outputs))])
    return csv_text(lines)


def _cell(value: Value | None) -> str:
    if value is None:
        return ""
    return repr(int(value) if isinstance(value, bool) else value)


def csv_text(lines: Iterable[Iterable[str]]) -> str:
    """The text of a table."""
    out = StringIO()
    csv.writer(out, lineterminator="\n").writerows(lines)
    return out.getvalue()
