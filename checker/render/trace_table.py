"""A trace as a table for the terminal: what changed, what fired, which part of the property is false."""

from io import StringIO

from rich.console import Console
from rich.padding import Padding
from rich.table import Table
from rich.text import Text

from checker.render.again import Again, folded
from checker.render.reasons import forced, reasons
from checker.render.story import (
    UNTOLD,
    Change,
    Conjunct,
    Event,
    Quiet,
    Repeats,
    conjuncts,
    ending,
    heading,
    standstill,
    start_of,
    start_values,
)
from checker.trace import Arrow, Trace

NAME = "table"
KIND = "trace"
SUFFIX = ".txt"
SUMMARY = "table for the terminal: per tick only what changed and what fired"


INPUT, NEEDED = "in  ", "in* "
"""The marks of inputs, and of those that the end of the run needs."""
_STYLES = {False: "bold red", True: "dim"}


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
    for part in conjuncts(trace):
        console.print(Text(f"{part.verdict}: {part.name or part.formula}", style=_STYLES[part.true]))
        if not part.true:
            console.print(Padding(Text("\n".join(_explained(part))), (0, 0, 0, 4)))
    if said := forced(trace):
        console.print(Text("What forces it", style="bold"))
        console.print(_reasons(trace)) if trace.needed else None
        console.print(Text(said))
    return "\n".join(line.rstrip() for line in out.getvalue().splitlines()) + "\n"


def _table(trace: Trace) -> Table:
    table = Table(box=None, pad_edge=False, padding=(0, 1), show_edge=False)
    table.add_column("tick", justify="right", no_wrap=True)
    table.add_column("ms", justify="right", no_wrap=True)
    table.add_column("what happened", ratio=1)
    for row in folded(trace):
        if isinstance(row, Repeats):
            table.add_row("↻", "", _hanging(row.what, style="bold"))
        elif isinstance(row, Again | Quiet):
            table.add_row("·", "", _hanging(row.what, style="dim"))
        else:
            _event(table, trace, row)
    return table


def _event(table: Table, trace: Trace, event: Event) -> None:
    lines: list[Table] = []
    for needed in (True, False):
        given = [str(c) for c in event.changes if not c.old and c.needed is needed]
        lines += [_hanging(", ".join(given), NEEDED if needed else INPUT, "cyan")] if given else []
    lines += [_changed(c) for c in event.changes if c.old] + [_fired(a) for a in event.arrows]
    for i, line in enumerate(lines or [_hanging(standstill(trace, event))]):
        table.add_row(str(event.number) if not i else "", str(event.ms) if not i else "", line)


def _changed(change: Change) -> Table:
    mark = (NEEDED if change.needed else INPUT) if change.is_input else "    "
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


def _reasons(trace: Trace) -> Table:
    table = Table.grid(padding=(0, 2))
    table.add_column(no_wrap=True)
    table.add_column(justify="right", no_wrap=True)
    table.add_column(ratio=1)
    for reason in reasons(trace, regular=True):
        table.add_row(f"{NEEDED}{reason.when}", reason.ms, Text(reason.what, style="cyan", overflow="fold"))
    return table


def _explained(part: Conjunct) -> list[str]:
    formula = [part.formula] if part.name else []
    values = [", ".join(f"{name} = {shown}" for name, shown in part.values)] if part.values else []
    return [*formula, *values]
