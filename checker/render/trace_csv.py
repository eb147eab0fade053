"""A trace as comma-separated values: one row for each tick, for spreadsheets and data frames.

Row 0 is the state before the first tick.  Numbers are in their units, truth values ``true`` and
``false``; a cell is empty where nothing has that value in the tick.  Names and texts that a spreadsheet
would compute begin with ``'``, as do those that begin so already.  A variable named as one of our columns
(``tick``, ``time_ms``, ``arrows``) has ``_`` behind its name, as often as no other variable is named so.
"""

import csv
from collections.abc import Mapping, Sequence
from io import StringIO

from rovercheck.checker.io.files import csv_cell
from rovercheck.checker.results.format import Format
from rovercheck.checker.results.trace import Trace

FORMAT = Format("csv", "trace", ".csv", "one row per tick: time, inputs, variables, transitions that fired")

FIRST = ("tick", "time_ms")
LAST = "arrows"


def render(trace: Trace) -> str:
    """The table with a row of names; inputs come first, then what the charts computed."""
    held = {*trace.before, *(n for t in trace.ticks for n in t.after)}
    others = [n for n in trace.system.variables if n in held and n not in trace.system.inputs]
    names = [*trace.system.inputs, *others]
    out = StringIO()
    table = csv.writer(out, lineterminator="\n")
    table.writerow([*FIRST, *map(csv_cell, _apart(names)), LAST])
    table.writerow([0, 0, *_cells(trace, names, trace.before), ""])
    fixed = {n: v for n, v in trace.before.items() if trace.ticks and n not in trace.ticks[0].after}
    for tick in trace.ticks:
        cells = _cells(trace, names, {**fixed, **tick.after, **tick.inputs})
        transitions = csv_cell("; ".join(map(str, tick.transitions)))
        table.writerow([tick.number, trace.ms(tick.number), *cells, transitions])
    return out.getvalue()


def _apart(names: Sequence[str]) -> list[str]:
    """The names of columns, none of them one of ours and no two alike."""
    found = []
    for name in names:
        column = name
        while column in (*FIRST, LAST) or (column != name and column in names):
            column += "_"
        found.append(column)
    return found


def _cells(trace: Trace, names: list[str], at: Mapping[str, int]) -> list[str]:
    return [csv_cell(trace.show(name, at[name])) if name in at else "" for name in names]
