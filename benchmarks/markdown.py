"""Tables in Markdown, laid out so that they can be read as text too."""

from collections.abc import Sequence

NOTHING = "–"


def table(head: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """A table with its first column to the left and the others to the right."""
    columns = list(zip(head, *rows, strict=True))
    widths = [max(3, *(len(text) for text in column)) for column in columns]
    lines = [_line(head, widths), _rule(widths), *(_line(row, widths) for row in rows)]
    return "\n".join(lines) + "\n"


def _line(row: Sequence[str], widths: Sequence[int]) -> str:
    first = row[0].ljust(widths[0])
    others = (text.rjust(width) for text, width in zip(row[1:], widths[1:], strict=True))
    return "| " + " | ".join([first, *others]) + " |"


def _rule(widths: Sequence[int]) -> str:
    return (
        "|" + "|".join("-" * (w + 2) if i == 0 else "-" * (w + 1) + ":" for i, w in enumerate(widths)) + "|"
    )


def number(value: float | None) -> str:
    """Three digits, as many of them after the point as make sense; a dash for nothing."""
    if value is None:
        return NOTHING
    return f"{value:.3f}" if value < 0.1 else f"{value:.2f}" if value < 10 else f"{value:.1f}"
