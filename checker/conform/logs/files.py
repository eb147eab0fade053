"""The rows of a log file as texts: CSV, compressed or not, and Parquet."""

import csv
import gzip
import io
import zlib
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from typing import Protocol

from checker.conform.logs.errors import LogError, at
from checker.conform.logs.mapping import Map

SEPARATORS = ",;\t|"
Row = tuple[int, Sequence[str]]
"""The line of a row and its cells."""

BLOCK = 4096
"""Rows that are treated together."""


@dataclass(frozen=True)
class Rows:
    """A log: the names of its columns, and its rows in the order of the file."""

    header: tuple[str, ...]
    rows: Iterator[Row]
    close: Callable[[], None]
    decimal_comma: bool = False


def opened(path: Path, how: Map) -> Rows:
    """The rows of a file, read as they are asked for.  Raises ``LogError``, also while rows are read."""
    try:
        with path.open("rb") as file:
            head = file.read(BLOCK)
    except OSError as error:
        raise LogError(f"cannot be read: {error.strerror}.") from error
    if not head:
        raise LogError("is empty; a log has a line of column names and a row for each step.")
    if head[:4] == b"PAR1":
        return _parquet(path)
    if head[:2] == b"\x1f\x8b":
        return _text(io.TextIOWrapper(gzip.open(path), "utf-8-sig", newline=""), how)
    if b"\0" in head or head[:2] == b"PK":
        raise LogError("is no text but a binary file; write the log as CSV, CSV in gzip, or Parquet.")
    return _text(path.open(encoding="utf-8-sig", newline=""), how)


def _text(file: io.TextIOWrapper, how: Map) -> Rows:
    try:
        return _table(_lines(file), how, file.close)
    except LogError:
        file.close()
        raise


def _lines(file: io.TextIOWrapper) -> Iterator[str]:
    """The lines; broken bytes are named with the line they follow."""
    count = 0
    while True:
        try:
            line = file.readline()
        except EOFError as error:
            raise at(count + 1, "the gzip file ends in the middle: it was cut off.") from error
        except (gzip.BadGzipFile, zlib.error) as error:
            raise at(count + 1, f"the gzip file is damaged ({error}).") from error
        except UnicodeDecodeError as error:
            raise at(count + 1, "the text is not in UTF-8; write the log in UTF-8.") from error
        if not line:
            return
        if "\0" in line:
            raise at(count + 1, "there are zero bytes, which no text has: the file is damaged.")
        count += 1
        yield line


def _table(lines: Iterator[str], how: Map, close: Callable[[], None]) -> Rows:
    ahead = [line for _, line in zip(range(20), lines, strict=False)]
    skipped = next((i for i, line in enumerate(ahead) if line.strip() and line[0] != "#"), len(ahead))
    if skipped == len(ahead):
        raise LogError("has no line of column names; write them in the first line.")
    separator = how.separator or max(SEPARATORS, key=ahead[skipped].count)
    reader = csv.reader(_chained(ahead[skipped:], lines), delimiter=separator, skipinitialspace=True)
    header = tuple(name.strip() for name in next(reader))
    _distinct(header, skipped + 1)
    comma = how.decimal == "," or (
        not how.decimal and separator != "," and _commas(ahead[skipped + 1 :], separator)
    )
    return Rows(header, _cells(reader, len(header), skipped), close, comma)


def _chained(ahead: Sequence[str], rest: Iterator[str]) -> Iterator[str]:
    yield from ahead
    yield from rest


def _distinct(header: Sequence[str], line: int) -> None:
    for name in header:
        if header.count(name) > 1:
            raise at(line, f"the column {name!r} occurs {header.count(name)} times; give each its own name.")


def _commas(lines: Sequence[str], separator: str) -> bool:
    cells = [cell.strip() for line in lines for cell in line.split(separator)]
    return any(c.count(",") == 1 and c.replace(",", "").lstrip("+-").isdigit() for c in cells)


class _Reader(Protocol):
    """A reader of the standard library, whose type has no name there."""

    line_num: int

    def __next__(self) -> list[str]: ...


def _cells(reader: "_Reader", width: int, skipped: int) -> Iterator[Row]:
    while True:
        try:
            cells = next(reader)
        except StopIteration:
            return
        except csv.Error as error:
            raise at(skipped + reader.line_num, f"{error}.") from error
        if len(cells) != width:
            if not cells:
                continue
            raise at(
                skipped + reader.line_num,
                f"the row has {len(cells)} cells, the line of column names {width}: it was cut off, or a "
                "cell holds the separator.",
            )
        yield skipped + reader.line_num, cells


# --- Parquet -------------------------------------------------------------------------------------


def _parquet(path: Path) -> Rows:
    if find_spec("pyarrow") is None:
        raise LogError("is a Parquet file, which pyarrow reads; install rovercheck[parquet], or write CSV.")
    parquet = import_module("pyarrow.parquet")
    arrow = import_module("pyarrow")
    try:
        file = parquet.ParquetFile(path)
    except (arrow.ArrowException, OSError) as error:
        raise LogError(f"is no readable Parquet file: {error}.") from error
    header = tuple(str(name) for name in file.schema_arrow.names)
    _distinct(header, 1)
    batches = (batch.to_pydict() for batch in file.iter_batches(BLOCK))
    return Rows(header, _rows_of(batches, header), file.close)


def _rows_of(batches: Iterator[dict[str, list[object]]], header: Sequence[str]) -> Iterator[Row]:
    number = 1
    for batch in batches:
        for cells in zip(*(batch[name] for name in header), strict=True):
            number += 1
            yield number, ["" if cell is None else str(cell) for cell in cells]
