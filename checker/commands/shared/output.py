"""Writing what a command produced: to the terminal, or to a file that is never half-written."""

import os
import sys
from io import UnsupportedOperation
from pathlib import Path
from typing import Any

from rich.console import Console, ConsoleDimensions

from rovercheck.checker.commands.shared.codes import UsageError
from rovercheck.checker.commands.shared.silence import silent
from rovercheck.checker.commands.shared.text_wrap import fitted, plain, whole
from rovercheck.checker.io.console import UnmarkedConsole
from rovercheck.checker.io.files import replaced


class _Console(UnmarkedConsole):
    """A console that leaves it to the command line what to do when nobody reads on.

    It never hides the cursor: a program that is killed could not show it again.
    """

    def on_broken_pipe(self) -> None:
        raise BrokenPipeError

    def show_cursor(self, show: bool = True) -> bool:
        return False

    def print(self, *objects: Any, **options: Any) -> None:
        """Print; on a terminal, lines of text that are too long for it are wrapped between words."""
        objects = tuple(self._fitted(o) if isinstance(o, str) else o for o in objects)
        super().print(*objects, **options)

    def _fitted(self, text: str) -> str:
        return plain(fitted(text, self.width) if at_terminal(self) else text)

    @property
    def size(self) -> ConsoleDimensions:
        """Also of a terminal that calls itself dumb, which rich takes for one of 80 columns."""
        if not self.is_dumb_terminal:
            return super().size
        try:
            columns, lines = os.get_terminal_size(self.file.fileno())
        except (AttributeError, OSError, ValueError):  # no file of the system, or closed
            columns = lines = 0
        return ConsoleDimensions(self._width or columns or 80, self._height or lines or 25)

    @size.setter
    def size(self, new: tuple[int, int]) -> None:
        self._width, self._height = new


out = _Console(soft_wrap=True)
"""Results."""

err = _Console(stderr=True, soft_wrap=True)
"""Progress and messages."""


COLUMNS = 80
"""Of texts that are laid out in lines."""


def text_width() -> int:
    """The columns of texts that are laid out in lines: 80, or fewer where a terminal is narrower."""
    return min(COLUMNS, out.width) if at_terminal(out) else COLUMNS


def table_width() -> int:
    """The columns of what is laid out in a table: as many as a terminal has, elsewhere 80."""
    return out.width if at_terminal(out) else COLUMNS


def wrapped(text: str, indent: int | None = None) -> str:
    """Lines of results: where a terminal is too narrow for one, what follows is indented by so many blanks.

    Elsewhere each stays one line, which programs take as one.
    """
    return fitted(text, out.width, indent) if at_terminal(out) else text


def at_terminal(console: Console) -> bool:
    """Whether somebody looks at what is printed, whatever colours are forced on a file."""
    return bool(console.file) and console.file.isatty()


def movable(console: Console) -> bool:
    """Whether a line can be written over: not on a terminal that calls itself dumb."""
    return at_terminal(console) and console.is_interactive


def share_a_terminal() -> bool:
    """Whether results and messages go to one and the same terminal."""
    try:
        both = [os.fstat(console.file.fileno()) for console in (out, err)]
        own = os.stat("/dev/tty").st_rdev
    except (AttributeError, OSError, UnsupportedOperation, ValueError):  # no files of the system, or closed
        return False
    named_so = any(one.st_rdev == own for one in both)  # as in `> /dev/tty`
    return movable(out) and movable(err) and (named_so or os.path.samestat(*both))


def possible(target: Path | None) -> None:
    """Raises ``UsageError`` for a file that cannot be written anyway, before long work is done for it."""
    if target is not None and target.is_dir():
        raise UsageError(f"Cannot write {whole(target)}: it is a folder. Name a file in it.")
    if target is not None and not target.absolute().parent.is_dir():
        place, folder = whole(target), whole(target.parent)
        raise UsageError(f"Cannot write {place}: {folder} is no folder. Make it first.")


def write(content: str | bytes, target: Path | None) -> None:
    """Write to a file, all of it or nothing, or to standard output when ``target`` is None.

    Raises ``UsageError`` when the place cannot be written.
    """
    # A path may hold bytes that are no text: they are shown as `\udcff`, which is JSON, too.
    data = plain(content).encode(errors="backslashreplace") if isinstance(content, str) else content
    try:
        if target is None:
            sys.stdout.buffer.write(data if data.endswith(b"\n") else data + b"\n")
            sys.stdout.flush()
        else:
            replaced(target, data)
    except BrokenPipeError:  # whoever reads has seen enough
        raise
    except OSError as error:
        place = whole(target) if target else "to standard output"
        other = "Choose another file." if target else "Name a file with --output."
        raise UsageError(f"Cannot write {place}: {error.strerror}. {other}") from error


def wrote(target: Path | None) -> None:
    """Say that a file is written, to those who did not ask for silence."""
    if target is not None and not silent():
        err.print(f"wrote {whole(target)}", markup=False)


def counted(number: int, one: str, many: str) -> str:
    """``1 property``, ``1,386 properties``."""
    return f"{number:,} {one if number == 1 else many}"
