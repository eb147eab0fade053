"""A trace as a table for the terminal: what changed, what fired, which part of the property is false."""

from io import StringIO

from rich.console import Console
from rich.padding import Padding
from rich.table import Table
from rich.text import Text

from checker.render.story import (
    UNTOLD,
    Change,
    Event,
    FalsePart,
    Quiet,
    Repeats,
    ending,
    false_parts,
    heading,
    rows,
    start_of,
    start_values,
)
from checker.trace import Arrow, Trace

NAME = "table"
KIND = "trace"
SUFFIX = ".txt"
SUMMARY = "table for the terminal: per tick only what changed and what fired"


def render(trace: Trace, width: int = 80, color: bool = False) -> str:
    """The table as text of ``width`` columns, with ANSI colours if asked for."""
    out = StringIO()
    console = Console(
        file=out, width=width, force_terminal=color, color_system="standard" if color else None,
        legacy_windows=False, highlight=False, emoji=False, markup=False, _environ={},
    )  # fmt: skip
    console.print(Text(heading(trace), style="bold"))
    if chosen := start_values(trace):
        console.print(Text("fixed: " + ", ".join(f"{n} = {v}" for n, v in chosen)))
    console.print(_table(trace))
    if last := ending(trace):
        console.print(Text(last, style="bold"))
    console.print(Text(UNTOLD, style="dim"))
    for part in false_parts(trace):
        console.print(Text(f"False after tick {len(trace)}: {part.name or part.formula}", style="bold red"))
        console.print(Padding(Text("\n".join(_explained(part))), (0, 0, 0, 4)))
    return "\n".join(line.rstrip() for line in out.getvalue().splitlines()) + "\n"


def _table(trace: Trace) -> Table:
    table = Table(box=None, pad_edge=False, padding=(0, 1), show_edge=False)
    table.add_column("tick", justify="right", no_wrap=True)
    table.add_column("ms", justify="right", no_wrap=True)
    table.add_column("what happened", ratio=1)
    for row in rows(trace):
        if isinstance(row, Repeats):
            table.add_row("↻", "", _hanging(row.what, style="bold"))
        elif isinstance(row, Quiet):
            table.add_row("·", "", _hanging(row.what, style="dim"))
        else:
            _event(table, row)
    return table


def _event(table: Table, event: Event) -> None:
    given = [c for c in event.changes if not c.old]
    lines = [_hanging(", ".join(map(str, given)), "in  ", "cyan")] if given else []
    lines += [_changed(c) for c in event.changes if c.old] + [_fired(a) for a in event.arrows]
    for i, line in enumerate(lines or [_hanging("nothing changes")]):
        table.add_row(str(event.number) if not i else "", str(event.ms) if not i else "", line)


def _changed(change: Change) -> Table:
    mark = "in  " if change.is_input else "    "
    return _hanging(str(change), mark, "cyan" if change.is_input else "")


def _fired(arrow: Arrow) -> Table:
    label = f"  {arrow.label}" if arrow.label else ""
    return _hanging(f"{arrow.chart}: {start_of(arrow)}{label}", "  ▸ ", "green")


def _hanging(shown: str, mark: str = "    ", style: str = "") -> Table:
    """A mark and a text whose further lines are set below its first."""
    grid = Table.grid(padding=0)
    grid.add_column(width=len(mark), no_wrap=True)
    grid.add_column(ratio=1)
    grid.add_row(Text(mark, style=style), Text(shown, style=style, overflow="fold"))
    return grid


def _explained(part: FalsePart) -> list[str]:
    formula = [part.formula] if part.name else []
    values = [", ".join(f"{name} = {shown}" for name, shown in part.values)] if part.values else []
    return [*formula, *values]
