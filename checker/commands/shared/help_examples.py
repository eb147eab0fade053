"""The examples at the end of ``--help`` of the verbs that bring none of their own."""

from collections.abc import Iterable
from shutil import get_terminal_size

import click

from rovercheck.checker.commands.shared.text_wrap import filled

COLUMNS, WIDE, NARROWEST, INDENT = 80, 60, 20, 4
"""Of help at most; from which on options stand beside what they do; at least; of what stands below."""

EXAMPLES: dict[str, tuple[str, ...]] = {
    "accept": (
        'rovercheck accept PB1-15 --because "3 s are wanted." --owner "A. Rossi"',
        "rovercheck accept --from decisions.json --model heater.py",
    ),
    "certify": (
        "rovercheck certify proofs",
        "rovercheck certify proofs --solver bitwuzla --smt2 obligations",
    ),
    "check": (
        "rovercheck check PB1-15 PB2-01",
        "rovercheck check --system relay --certify",
        "rovercheck check --model heater.py --junit verdicts.xml",
        "rovercheck check --changed main --quiet",
        "rovercheck check --model heater.py --watch",
    ),
    "check-log": (
        "rovercheck check-log examples/logs/good.csv",
        "rovercheck check-log examples/logs --map examples/logs/map.toml --json",
    ),
    "compare": (
        "rovercheck compare --system board1",
        "rovercheck compare --system board1 --impl c:examples/board1_c",
    ),
    "diagnose": (
        "rovercheck diagnose examples/logs/faults.csv",
        "rovercheck diagnose examples/logs/faults.csv --write variant.toml",
    ),
    "diff": (
        "rovercheck diff HEAD",
        "rovercheck diff main HEAD --model heater.py --format markdown",
    ),
    "export": (
        "rovercheck export PB1-15 --format btor2 -o PB1-15.btor2",
        "rovercheck export --system relay --format smv -o relay",
    ),
    "init": ("rovercheck init heater", "rovercheck check --model heater/heater.py"),
    "list": ("rovercheck list properties PB1-15 --english", "rovercheck list systems"),
    "map": (
        "rovercheck map init examples/board1_c --system board1 -o map.toml",
        "rovercheck map init firmware --model heater.py",
    ),
    "mutate": (
        "rovercheck mutate --system relay",
        "rovercheck mutate --model heater.py --sample 50 --seed 1 --json",
    ),
    "report": (
        "rovercheck report -o review.html",
        "rovercheck report --system relay --certify -o relay.html",
    ),
    "reports": ("rovercheck reports", "rovercheck reports --stale"),
    "requirements": ("rovercheck requirements", "rovercheck requirements --check --json"),
    "robustness": (
        "rovercheck robustness --system board1 --impl c:examples/board1_c",
        "rovercheck robustness --model heater.py --impl c:firmware -o findings",
    ),
    "simulate": ("rovercheck simulate examples/scenarios/link_loss.toml --log steps",),
    "generate-tests": (
        "rovercheck generate-tests --kept --system board1",
        "rovercheck generate-tests --cover boundaries --format pytest -o tests",
    ),
}
"""By verb: command lines that can be typed as they are."""


class Formatter(click.HelpFormatter):
    """Help in the columns of the terminal, however few: click takes 50 at least, and would cut words."""

    def __init__(self, indent_increment: int = 2, width: int | None = None, max_width: int | None = None):
        columns = min(get_terminal_size().columns, max_width or COLUMNS)
        narrow = max(NARROWEST, columns - 2 * (columns >= WIDE))
        super().__init__(indent_increment, width or narrow, max_width)

    def write_dl(self, rows: Iterable[tuple[str, str]], col_max: int = 30, col_spacing: int = 2) -> None:
        """Options and what they do; below each other where a word has no room beside them."""
        rows = list(rows)
        room = self.width - min(col_max, max(len(name) for name, _ in rows)) - col_spacing - 2
        fits = max(len(word) for _, told in rows for word in (told or "-").split()) <= room
        super().write_dl(rows, col_max if fits and room >= NARROWEST else INDENT - 2, col_spacing)

    def getvalue(self) -> str:
        """The help; examples, which click leaves as they are, have what they do in a line below."""
        lines = super().getvalue().split("\n")
        return "\n".join(line if len(line) <= self.width else self._narrow(line) for line in lines)

    def _narrow(self, line: str) -> str:
        blanks = " " * (len(line) - len(line.lstrip()))
        command, _, meaning = line.strip().partition("  ")
        below = blanks + " " * INDENT
        told = filled(meaning.strip(), self.width, below, below) if meaning else ""
        return f"{blanks}{command}\n{told}" if told else line


class Context(click.Context):
    """Writes help with ``Formatter``."""

    formatter_class = Formatter


def helped(verb: click.Command) -> click.Command:
    """The verb, with its examples at the end of its help, which fits into any terminal."""
    verb.context_class = Context
    lines = EXAMPLES.get(verb.name or "", ())
    if lines and not verb.epilog:
        verb.epilog = "\n".join(["\b", "Examples:", *(f"  {line}" for line in lines)])
    return verb
