"""A trace as comma-separated values: one row for each tick, for spreadsheets and data frames.

Row 0 is the valuation before the first tick.  Numbers are in their units, truth values ``true`` and
``false``; a cell is empty where nothing has that value in the tick.
"""

import csv
from collections.abc import Mapping
from io import StringIO

from checker.trace import Trace

NAME = "csv"
KIND = "trace"
SUFFIX = ".csv"
SUMMARY = "one row per tick: time, inputs, variables, arrows that fired"

FIRST = ("tick", "time_ms")
LAST = "arrows"


def render(trace: Trace) -> str:
    """The table with a row of names; inputs come first, then what the charts computed."""
    held = {*trace.before, *(n for t in trace.ticks for n in t.after)}
    others = [n for n in trace.variables if n in held and n not in trace.inputs]
    names = [*trace.inputs, *others]
    out = StringIO()
    table = csv.writer(out, lineterminator="\n")
    table.writerow([*FIRST, *names, LAST])
    table.writerow([0, 0, *_cells(trace, names, trace.before), ""])
    fixed = {n: v for n, v in trace.before.items() if trace.ticks and n not in trace.ticks[0].after}
    for tick in trace.ticks:
        cells = _cells(trace, names, {**fixed, **tick.after, **tick.inputs})
        arrows = "; ".join(map(str, tick.arrows))
        table.writerow([tick.number, tick.number * trace.tick_ms, *cells, arrows])
    return out.getvalue()


def _cells(trace: Trace, names: list[str], at: Mapping[str, int]) -> list[str]:
    return [trace.show(name, at[name]) if name in at else "" for name in names]
