"""The logs that a verb is about, and the map of their columns."""

from collections.abc import Sequence
from pathlib import Path

from rovercheck.checker.commands.shared.codes import UsageError
from rovercheck.checker.logs import ColumnMap, LogError, read_map

SUFFIXES = (".csv", ".csv.gz", ".tsv", ".tsv.gz", ".parquet")


def logs_in(folder: Path) -> Sequence[Path]:
    """The logs of a folder, by name.  Raises ``UsageError`` where it cannot be read."""
    try:
        return sorted(p for p in folder.iterdir() if p.is_file() and p.name.lower().endswith(SUFFIXES))
    except OSError as error:
        raise UsageError(f"Cannot read the folder {folder}: {error.strerror}. Write another.") from error


def column_map(file: Path | None) -> ColumnMap:
    """The map of a file, that of names as they are without one.  Raises ``UsageError``."""
    try:
        return ColumnMap() if file is None else read_map(file)
    except LogError as error:
        raise UsageError(str(error)) from error


def no_logs(folder: Path) -> str:
    """What is said of a folder without logs."""
    return f"{folder} holds no log ({', '.join(SUFFIXES)})."


__all__ = ["column_map", "logs_in", "no_logs"]
