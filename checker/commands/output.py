"""Writing what a command produced: to the terminal, or to a file that is never half-written."""

import sys
from pathlib import Path

from rich.console import Console, RenderableType
from rich.text import Text

from checker.commands.codes import UsageError
from checker.commands.silence import silent
from checker.files import replaced


class _Console(Console):
    """A console that leaves it to the command line what to do when nobody reads on."""

    def on_broken_pipe(self) -> None:
        raise BrokenPipeError


out = _Console(highlight=False, soft_wrap=True)
"""Results."""

err = _Console(stderr=True, highlight=False, soft_wrap=True)
"""Progress and messages."""


def possible(target: Path | None) -> None:
    """Raises ``UsageError`` for a file that cannot be written anyway, before long work is done for it."""
    if target is not None and target.is_dir():
        raise UsageError(f"Cannot write {target}: it is a folder. Name a file in it.")
    if target is not None and not target.absolute().parent.is_dir():
        raise UsageError(f"Cannot write {target}: {target.parent} is no folder. Make it first.")


def write(content: str | bytes, target: Path | None) -> None:
    """Write to a file, all of it or nothing, or to standard output when ``target`` is None.

    Raises ``UsageError`` when the place cannot be written.
    """
    # A path may hold bytes that are no text: they are shown as `\udcff`, which is JSON, too.
    data = content.encode(errors="backslashreplace") if isinstance(content, str) else content
    try:
        if target is None:
            sys.stdout.buffer.write(data if data.endswith(b"\n") else data + b"\n")
            sys.stdout.flush()
        else:
            replaced(target, data)
    except BrokenPipeError:  # whoever reads has seen enough
        raise
    except OSError as error:
        place, other = (target, "Choose another") if target else ("to standard output", "Name a file with")
        raise UsageError(f"Cannot write {place}: {error.strerror}. {other} --output.") from error


def wrote(target: Path | None) -> None:
    """Say that a file is written, to those who did not ask for silence."""
    if target is not None and not silent():
        err.print(f"wrote {target}", markup=False)


def trimmed(console: Console, thing: RenderableType) -> None:
    """Print without the blanks with which tables are filled up to the width."""
    with console.capture() as captured:
        console.print(thing, soft_wrap=False)
    for line in captured.get().splitlines():
        shown = Text.from_ansi(line)
        shown.rstrip()
        console.print(shown)


def counted(number: int, one: str, many: str) -> str:
    """``1 property``, ``1,386 properties``."""
    return f"{number:,} {one if number == 1 else many}"
