"""``rovercheck check --watch``: the properties checked whenever a file is saved, and what that changed.

Each check is a process of its own, which reads the files as they are then; what it concerns not is in the
store of verdicts.
"""

import json
import subprocess
import sys
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from pathlib import Path
from time import monotonic, strftime
from typing import Any

from rovercheck.checker.commands.diff.document import VerdictChange, changes
from rovercheck.checker.commands.diff.text import sections
from rovercheck.checker.commands.shared.codes import Exit, UsageError
from rovercheck.checker.commands.shared.output import counted, err, out
from rovercheck.checker.commands.shared.text_wrap import whole

PAUSE = 300
"""Milliseconds after which it is looked whether the folders are still there."""
SUFFIXES = (".py", ".toml", ".json")
"""Files of a model."""
_ROOT = Path(__file__).parents[3]


def watched(model: Path | None) -> list[Path]:
    """The folders whose files make the rover, or a model of the user's own.  Raises ``UsageError``."""
    if model is None:
        return [(_ROOT / name).resolve() for name in ("spec_model", "properties")]
    folder = model if model.is_dir() else model.parent
    if not folder.is_dir():
        raise UsageError(f"There is no folder {whole(folder)} to watch.")
    return [folder.absolute()]


def watch(arguments: Sequence[str], model: Path | None) -> Exit:
    """Check now and after each change until Ctrl-C, which is how it ends, whatever the verdicts are.

    ``arguments`` are those of ``check``.  Raises ``UsageError`` where the folder is gone.
    """
    folders = watched(model)
    names = ", ".join(whole(folder) for folder in folders)
    before: list[Any] | None = None
    with suppress(KeyboardInterrupt):
        for number, saved in enumerate(_saves(folders)):
            if number == 0:  # files are looked after from now on
                before = _round(arguments, None, "")
                err.print(f"Watching {names}; Ctrl-C ends.", markup=False)
            if saved:
                before = _round(arguments, before, saved)
    return Exit.INTERRUPTED


def _saves(folders: Sequence[Path]) -> Iterator[str]:
    """After each change of a file of a model, the names of those that changed, and now and then nothing.

    What is saved while somebody else works is seen later.  Raises ``UsageError`` where a folder is gone.
    """
    from watchfiles import watch as changes_in

    for found in changes_in(*folders, raise_interrupt=True, yield_on_timeout=True, rust_timeout=PAUSE):
        gone = [folder for folder in folders if not folder.is_dir()]
        if gone:
            raise UsageError(f"{whole(gone[0])} is gone: there is nothing to watch any more.")
        names = {Path(name).name for _, name in found if name.endswith(SUFFIXES)}
        yield ", ".join(sorted(names))


def _round(arguments: Sequence[str], before: list[Any] | None, saved: str) -> list[Any] | None:
    """Check once, and tell what changed since; the verdicts, those of before where there are none."""
    began = monotonic()
    command = [sys.executable, "-m", "rovercheck", "check", *arguments, "--json"]
    done = subprocess.run(command, stdout=subprocess.PIPE, check=False)
    if done.returncode == Exit.INTERRUPTED:
        raise KeyboardInterrupt
    head = " ".join(filter(None, (strftime("%H:%M:%S"), saved)))
    try:
        found: Mapping[str, Any] = json.loads(done.stdout)
        rows = list(found["results"])
    except (ValueError, KeyError):
        out.print(f"{head}: not checked, see above; the verdicts of before stand.", markup=False)
        return before
    took = f"{monotonic() - began:.1f} s"
    out.print(f"{head}: {_counts(rows)}, in {took}.", markup=False)
    for line in _told(rows, before):
        out.print(line, markup=False)
    return rows


def _told(rows: Sequence[Any], before: Sequence[Any] | None) -> Iterator[str]:
    """What differs from before, or at first from what is expected."""
    if before is None:
        wrong = [row for row in rows if not row["as_expected"]]
        yield from (f"  {row['id']} is {row['verdict']}, expected {row['expected']}" for row in wrong)
        return
    found: list[VerdictChange] = changes(before, rows)
    yield from sections(found)
    if not found:
        yield "  Every verdict is as before."


def _counts(rows: Sequence[Any]) -> str:
    """``695 properties: 541 proved, 113 violated``."""
    words = Counter(row["verdict"] for row in rows)
    shares = ", ".join(f"{count} {word}" for word, count in sorted(words.items()))
    return f"{counted(len(rows), 'property', 'properties')}: {shares}"
