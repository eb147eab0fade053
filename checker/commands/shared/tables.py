"""Lists for people: columns where they fit, else one record below the other; names are never cut."""

from collections.abc import Iterator, Sequence

from rich.cells import cell_len
from rich.console import Console, RenderableType
from rich.style import StyleType
from rich.table import Table
from rich.text import Text

from rovercheck.checker.commands.shared.output import at_terminal, out
from rovercheck.checker.commands.shared.text_wrap import filled
from rovercheck.checker.render.hanging_indent import hanging

GAP = "  "
NARROWEST = 24
"""Columns below which sentences are not set beside other things."""


def listed(columns: Sequence[str], rows: Sequence[Sequence[str]]) -> None:
    """Print rows below the names of their columns; a terminal wraps all but the first between words.

    Into a pipe or a file goes one line a row.
    """
    rows = [[" ".join(cell.split()) for cell in row] for row in rows]
    natural = [max(map(cell_len, column)) for column in zip(columns, *rows, strict=True)]
    widths = _widths([columns, *rows], natural, out.width) if at_terminal(out) else natural
    if widths is None:
        for row in rows:
            out.print(row[0], style="bold", markup=False)
            for column, cell in zip(columns[1:], row[1:], strict=True):
                out.print(filled(f"{column}: {cell}", out.width, "  ", "    "), markup=False)
        return
    out.print(*_lines(columns, widths), style="bold", markup=False, sep="\n")
    for row in rows:
        out.print(*_lines(row, widths), markup=False, sep="\n")


def _widths(rows: Sequence[Sequence[str]], natural: Sequence[int], room: int) -> list[int] | None:
    """How wide each column is, the last as wide as there is room; None if words would be cut."""
    words = [max(cell_len(word) for cell in column for word in cell.split() or [""])
             for column in zip(*rows, strict=True)]  # fmt: skip
    room -= len(GAP) * (len(natural) - 1)
    first, *middle = natural[:-1]
    widths = [first, *(max(word, min(all, NARROWEST)) for word, all in zip(words[1:], middle, strict=False))]
    spare = room - sum(widths) - natural[-1]
    for place, wanted in enumerate(middle, start=1):
        more = max(0, min(wanted - widths[place], spare))
        widths[place] += more
        spare -= more
    rest = min(natural[-1], room - sum(widths))
    return [*widths, rest] if rest >= min(natural[-1], max(words[-1], NARROWEST)) else None


def _lines(row: Sequence[str], widths: Sequence[int]) -> Iterator[str]:
    """A row, each cell in the lines that it takes."""
    cells = [filled(cell, max(1, width)).split("\n") for cell, width in zip(row, widths, strict=True)]
    for number in range(max(map(len, cells))):
        parts = [lines[number] if number < len(lines) else "" for lines in cells]
        padded = (part + " " * (width - cell_len(part)) for part, width in zip(parts, widths, strict=True))
        yield GAP.join(padded).rstrip()


def laid(console: Console, grid: Table) -> None:
    """Print a grid; texts of its last column are wrapped beside the others, or below where room lacks."""
    columns = [[_text(cell, column.style) for cell in column.cells] for column in grid.columns]
    widths = [max([column.width or 0, *(cell.cell_len for cell in cells)])
              for column, cells in zip(grid.columns, columns, strict=True)]  # fmt: skip
    for *before, shown in zip(*columns, strict=True):
        lead = Text()
        for column, cell, width in zip(grid.columns, before, widths, strict=False):
            cell.align("right" if column.justify == "right" else "left", width)
            lead = Text.assemble(lead, cell, " " * grid.padding[1])
        beside(console, lead, shown)


def beside(console: Console, lead: Text, shown: Text) -> None:
    """Print a text wrapped beside what leads to it."""
    for line in hanging(console, lead, shown):
        line.rstrip()
        console.print(line)


def _text(cell: RenderableType, style: StyleType) -> Text:
    return cell if isinstance(cell, Text) else Text(str(cell), style)
