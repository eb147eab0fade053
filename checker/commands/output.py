"""Writing what a command produced: to the terminal, or to a file that is never half-written."""

import sys
from pathlib import Path

from rich.console import Console

from checker.commands.codes import UsageError
from checker.files import replaced

out = Console(highlight=False, soft_wrap=True)
"""Results."""

err = Console(stderr=True, highlight=False, soft_wrap=True)
"""Progress and messages."""


def write(content: str | bytes, target: Path | None) -> None:
    """Write to a file, all of it or nothing, or to standard output when ``target`` is None.

    Raises ``UsageError`` when the place cannot be written.
    """
    data = content.encode() if isinstance(content, str) else content
    if target is None:
        sys.stdout.buffer.write(data if data.endswith(b"\n") else data + b"\n")
        sys.stdout.flush()
        return
    try:
        replaced(target, data)
    except OSError as error:
        raise UsageError(f"Cannot write {target}: {error.strerror}. Choose another --output.") from error
