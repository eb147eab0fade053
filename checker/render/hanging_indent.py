"""A text set beside what leads to it, wrapped between words; a name is never cut."""

import re
from collections.abc import Iterator

from rich.cells import cell_len
from rich.console import Console
from rich.text import Text

INDENT = 4
"""Of a text that has no room beside what leads to it."""


def hanging(console: Console, lead: Text, shown: Text) -> Iterator[Text]:
    """The lines of a text, the first behind its lead; below it where one of its words has no room there."""
    beside = lead.cell_len
    longest = max(map(cell_len, shown.plain.split()), default=0)
    if beside > INDENT and longest > console.width - beside:
        if lead.plain.strip():
            yield lead
        lead, beside = Text(" " * INDENT), INDENT
    for part in shown.split("\n"):
        for line in part.divide(_breaks(part.plain, console.width - beside)):
            line.rstrip()
            yield Text.assemble(lead, line)
            lead = Text(" " * beside)


def _breaks(text: str, width: int) -> Iterator[int]:
    """Where lines begin, but for the first."""
    used = 0
    for word in re.finditer(r"\s*\S+\s*", text):
        if used and used + cell_len(word[0].rstrip()) > width:
            yield word.start()
            used = 0
        used += cell_len(word[0])
