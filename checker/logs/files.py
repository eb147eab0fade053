"""The rows of a log file as columns of texts, block by block: CSV, compressed or not, and Parquet."""

import csv
import gzip
import io
import zlib
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from importlib import import_module
from itertools import chain, islice
from pathlib import Path
from typing import Any

from rovercheck.checker.extras import PARQUET
from rovercheck.checker.io.files import csv_plain
from rovercheck.checker.logs.errors import LogError, at, shortened
from rovercheck.checker.logs.limits import (
    MOST_COLUMNS,
    MOST_GROUP,
    MOST_TEXT,
    BoundedReader,
    GuardedBytes,
    LimitError,
)
from rovercheck.checker.logs.mapping import ColumnMap

SEPARATORS = ",;\t|"
BLOCK = 1024
"""Rows that are read together: few enough for their texts to stay in the cache of a processor."""
BUFFER = 1 << 16
PIECE = 32
"""Lines after which it is asked whether they are enough already."""
FIRST = 4096
"""Bytes that tell what kind of file it is."""
HEAD = 20
"""Lines among which the column names are looked for."""


@dataclass(frozen=True)
class Texts:
    """Successive rows: the line of each, and the cells of each column."""

    lines: Sequence[int]
    columns: Sequence[Sequence[str]]


@dataclass(frozen=True)
class FileRows:
    """A log: the names of its columns, and its rows in the order of the file."""

    header: tuple[str, ...]
    blocks: Iterator[Texts]
    close: Callable[[], None]
    decimal_comma: bool = False


def opened(path: Path, how: ColumnMap) -> FileRows:
    """The rows of a file, read as they are asked for.  Raises ``LogError``, also while rows are read."""
    try:
        with path.open("rb") as file:
            head = file.read(FIRST)
    except OSError as error:
        raise LogError(f"cannot be read: {error.strerror}.") from error
    if not head:
        raise LogError("is empty; a log has a line of column names and a row for each step.")
    if head[:4] == b"PAR1":
        return _parquet(path)
    if head[:2] == b"\x1f\x8b":
        return _text(_unpacked(path), how)
    if b"\0" in head or head[:2] == b"PK":
        raise LogError("is no text but a binary file; write the log as CSV, CSV in gzip, or Parquet.")
    return _text(GuardedBytes(path.open("rb", buffering=0)), how)


def _unpacked(path: Path) -> GuardedBytes:
    packed = path.open("rb")
    return GuardedBytes(gzip.GzipFile(fileobj=packed), packed)


def _text(data: GuardedBytes, how: ColumnMap) -> FileRows:
    file = io.TextIOWrapper(io.BufferedReader(data, BUFFER), "utf-8-sig", newline="")
    try:
        return _table(_lines(file, data), how, file.close)
    except LogError:
        file.close()
        raise


def _lines(file: io.TextIOWrapper, data: GuardedBytes) -> Iterator[list[str]]:
    """The lines, many at a time; broken bytes are named with the line they follow."""
    count = 0
    while True:
        lines, wrong = _some(file, data)
        count += len(lines)
        if lines:
            yield lines
        if wrong:
            raise at(count + 1, wrong)
        if not lines:
            return


def _some(file: io.TextIOWrapper, data: GuardedBytes) -> tuple[list[str], str]:
    """The next lines, and what is wrong with the one that follows them."""
    lines: list[str] = []
    wrong = ""
    enough = data.read_so_far + MOST_TEXT
    due = 0
    try:
        while len(lines) == due < BLOCK and data.read_so_far <= enough:
            due = min(due + PIECE, BLOCK)
            lines.extend(islice(file, due - len(lines)))  # those before a broken one are there
    except LimitError as error:
        wrong = str(error)
    except EOFError:
        wrong = "the gzip file ends in the middle: it was cut off."
    except (gzip.BadGzipFile, zlib.error) as error:
        wrong = f"the gzip file is damaged ({error})."
    except OSError as error:
        wrong = f"cannot be read any further: {error.strerror}."
    except UnicodeDecodeError:
        wrong = "the text is not in UTF-8; write the log in UTF-8."
    damaged = next((i for i, line in enumerate(lines) if "\0" in line), None)
    if damaged is None:
        return lines, wrong
    return lines[:damaged], "there are zero bytes, which no text has: the file is damaged."


def _table(lines: Iterator[list[str]], how: ColumnMap, close: Callable[[], None]) -> FileRows:
    first = next(lines, [])
    ahead = first[:HEAD]
    skipped = next((i for i, line in enumerate(ahead) if line.strip() and line[0] != "#"), len(ahead))
    if skipped == len(ahead):
        raise LogError("has no line of column names; write them in the first line.")
    separator = how.separator or max(SEPARATORS, key=ahead[skipped].count)
    names, *rest = first[skipped:]
    if '"' in names:
        reader = _Reader(chain([names, *rest], chain.from_iterable(lines)), separator)
        header = _header(reader, skipped)
        blocks = _read(reader, len(header), skipped)
    else:
        header = _header(_Reader([names], separator), skipped)
        blocks = _blocks(chain([rest], lines), separator, len(header), skipped + 1)
    comma = how.decimal == "," or (
        not how.decimal and separator != "," and _commas(ahead[skipped + 1 :], separator)
    )
    return FileRows(header, blocks, close, comma)


def _header(reader: "_Reader", before: int) -> tuple[str, ...]:
    header = tuple(csv_plain(name.strip()) for name in reader.row(before))
    _sound(header, before + 1)
    return header


def _sound(header: Sequence[str], line: int) -> None:
    """Raises ``LogError`` for too many columns, and for two of one name."""
    if len(header) > MOST_COLUMNS:
        raise at(line, f"there are {len(header):,} columns; a log may have {MOST_COLUMNS:,}. Leave some out.")
    name, count = Counter(header).most_common(1)[0]
    if count > 1:
        shown = repr(shortened(name)) if name else "without a name"
        raise at(line, f"the column {shown} occurs {count} times; give each its own name.")


def _commas(lines: Sequence[str], separator: str) -> bool:
    cells = [cell.strip() for line in lines for cell in line.split(separator)]
    return any(c.count(",") == 1 and c.replace(",", "").lstrip("+-").isdigit() for c in cells)


# --- cells ---------------------------------------------------------------------------------------


def _blocks(lines: Iterator[list[str]], separator: str, width: int, before: int) -> Iterator[Texts]:
    """The rows of lines, which follow so many others.  Quotes may hold line ends: a reader goes on then."""
    for some in lines:
        if (columns := _split(some, separator, width)) is not None:
            yield Texts(range(before + 1, before + len(some) + 1), columns)
        elif any('"' in line for line in some):
            reader = _Reader(chain(some, chain.from_iterable(lines)), separator)
            yield from _read(reader, width, before)
            return
        else:
            yield from _read(_Reader(some, separator), width, before)
        before += len(some)


def _split(lines: Sequence[str], separator: str, width: int) -> Sequence[Sequence[str]] | None:
    """The columns of lines with as many cells each and no quotes, all at once; ``None`` of others."""
    text = "".join(lines)
    plain = width > 1 and '"' not in text and len(max(lines, key=len, default="")) < csv.field_size_limit()
    if not plain or {line.count(separator) for line in lines} != {width - 1}:
        return None
    if "\r" in text:
        text = text.replace("\r\n", "\n").replace("\r", "\n")
    cells = text.removesuffix("\n").replace("\n", separator).split(separator)
    return [cells[i::width] for i in range(width)]


class _Reader:
    """Reads rows one by one, also such with line ends in their cells."""

    def __init__(self, lines: Iterable[str], separator: str) -> None:
        self._lines = BoundedReader(iter(lines))
        self._rows = csv.reader(self._lines, delimiter=separator, skipinitialspace=True)

    @property
    def line_num(self) -> int:
        """The lines read so far."""
        return self._rows.line_num

    def row(self, before: int) -> list[str]:
        """The next row; ``before`` lines were read by others.  Raises ``LogError`` and ``StopIteration``."""
        self._lines.new_row()
        try:
            return next(self._rows)
        except csv.Error as error:
            raise at(
                before + self.line_num, f"{error}: no cell of a log is as long. Is a quote not closed?"
            ) from error
        except LimitError as error:
            raise at(before + self.line_num, str(error)) from error


def _read(reader: _Reader, width: int, before: int) -> Iterator[Texts]:
    """The rows, and those before one that cannot be read before it is said why."""
    rows = _rows(reader, width, before)
    while True:
        some: list[tuple[int, list[str]]] = []
        wrong: LogError | None = None
        try:
            some.extend(islice(rows, BLOCK))
        except LogError as error:
            wrong = error
        if some:
            yield Texts([line for line, _ in some], list(zip(*(cells for _, cells in some), strict=True)))
        if wrong is not None:
            raise wrong
        if not some:
            return


def _rows(reader: _Reader, width: int, before: int) -> Iterator[tuple[int, list[str]]]:
    """The line of each row, and its cells; blank lines are passed over."""
    while True:
        try:
            cells = reader.row(before)
        except StopIteration:
            return
        if len(cells) != width:
            if not cells:
                continue
            raise at(
                before + reader.line_num,
                f"the row has {len(cells)} cells, the line of column names {width}: it was cut off, or a "
                "cell holds the separator.",
            )
        yield before + reader.line_num, cells


# --- Parquet -------------------------------------------------------------------------------------


def _parquet(path: Path) -> FileRows:
    if not PARQUET.installed:
        raise LogError(f"is a Parquet file. {PARQUET.needed('Reading it')}. Or write CSV.")
    parquet = import_module("pyarrow.parquet")
    arrow = import_module("pyarrow")
    try:
        file = parquet.ParquetFile(path)
    except (arrow.ArrowException, OSError, ValueError) as error:  # the last for names that are no text
        raise LogError(f"is no readable Parquet file: {error}.") from error
    header = tuple(str(name) for name in file.schema_arrow.names)
    try:
        if not header:
            raise LogError("is Parquet without columns.")
        _sound(header, 1)
        groups = range(file.metadata.num_row_groups)
        if any(file.metadata.row_group(i).total_byte_size > MOST_GROUP for i in groups):
            raise LogError(
                f"is Parquet with a row group of more than {MOST_GROUP >> 30} GiB; write smaller ones."
            )
    except LogError:
        file.close()
        raise
    return FileRows(header, _texts_of(_batches(file, arrow.ArrowException, len(header)), header), file.close)


def _batches(file: Any, wrong: type[Exception], width: int) -> Iterator[dict[str, list[object]]]:
    """The rows, some at a time: fewer where there are many columns."""
    try:
        for batch in file.iter_batches(max(1, min(BLOCK, MOST_TEXT // width))):
            yield batch.to_pydict()
    except (wrong, OSError, ValueError) as error:
        raise LogError(f"is no readable Parquet file: {error}.") from error


def _texts_of(batches: Iterator[dict[str, list[object]]], header: Sequence[str]) -> Iterator[Texts]:
    before = 1
    for batch in batches:
        columns = [["" if cell is None else str(cell) for cell in batch[name]] for name in header]
        count = len(columns[0]) if columns else 0
        yield Texts(range(before + 1, before + count + 1), columns)
        before += count
