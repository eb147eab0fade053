"""Files that are never half-written, and texts in them that no program takes for a command."""

import os
import re
import tempfile
from pathlib import Path

_NUMBER = re.compile(r"[-+]?(\d+(\.\d+)?(e[-+]?\d+)?(/\d+)?|inf)?", re.IGNORECASE)

_RISKY = tuple("=+-@\t\r'\uff1d\uff0b\uff0d\uff20")
"""What begins a formula, some of it also as wide as a Chinese character; and the quote itself."""


def replaced(target: Path, data: bytes) -> None:
    """Write a file in one step.  Raises ``OSError``; the old file, if there is one, then stays as it was.

    A device or a pipe (``/dev/stdout``) is written to, never put out of the way.
    """
    if target.exists() and not target.is_file() and not target.is_dir():
        target.write_bytes(data)
        return
    handle, name = tempfile.mkstemp(dir=target.parent, prefix=f".{target.name}.")
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(data)
        os.chmod(name, 0o644)
        os.replace(name, target)
    except BaseException:
        Path(name).unlink(missing_ok=True)
        raise


def csv_cell(text: str) -> str:
    """A name in a CSV file, quoted with ``'`` where a spreadsheet would compute it: ``'=HYPERLINK(...)``.

    Numbers are left as they are, and so is the ``-`` that stands for no state.  A text that begins with
    ``'`` gets one more, so that ``csv_plain`` finds every text again.  OWASP, *CSV Injection*.
    """
    risky = text.startswith(_RISKY) and not _NUMBER.fullmatch(text)
    return f"'{text}" if risky else text


def csv_plain(cell: str) -> str:
    """The text of which ``csv_cell`` made the cell."""
    return cell.removeprefix("'")
