"""How large what is read of a log may be: a hostile or broken file costs one message, not the memory."""

import io
from collections.abc import Iterator
from typing import Any, BinaryIO, Protocol

MOST_LINE = 4 << 20
"""Bytes of a line, and characters of a row whose quoted cells hold line ends."""

MOST_COLUMNS = 100_000

MOST_RATIO, RATIO_FROM = 400, 16 << 20
"""How much larger than packed a log may be, and from how many unpacked bytes on that is asked."""

MOST_TEXT = 4 << 20
"""Bytes of lines that are read together, but for the last few lines."""

MOST_GROUP = 1 << 30
"""Bytes of a row group of Parquet, which is unpacked as a whole."""

TOO_LONG = (
    f"the line is longer than {MOST_LINE >> 20} MiB: no row of a log is. Write line ends between the rows"
)


class LimitError(Exception):
    """More than is read; the message says what."""


class _Source(Protocol):
    """A binary file that is read piece by piece."""

    def readinto(self, buffer: memoryview, /) -> int | None: ...

    def close(self) -> None: ...


class GuardedBytes(io.RawIOBase):
    """The bytes of a file up to where a line, or what unpacking makes of it, becomes too large.

    ``packed``: the file that is unpacked, if it is one.  Reading raises ``LimitError``.
    """

    def __init__(self, source: _Source, packed: BinaryIO | None = None) -> None:
        super().__init__()
        self._source, self._packed = source, packed
        self._line = 0
        self._asked_from = RATIO_FROM
        self.read_so_far = 0

    def readable(self) -> bool:
        return True

    def readinto(self, buffer: Any, /) -> int:
        count = self._source.readinto(buffer) or 0
        data = bytes(memoryview(buffer)[:count])
        end = data.rfind(b"\n")
        if end < 0:
            end = data.rfind(b"\r")
        self._line = count - 1 - end if end >= 0 else self._line + count
        if self._line > MOST_LINE:
            raise LimitError(f"{TOO_LONG}.")
        self.read_so_far += count
        if self._packed is not None and self.read_so_far > self._asked_from:
            self._asked_from = self.read_so_far + (1 << 20)
            if self.read_so_far > MOST_RATIO * self._packed.tell():
                raise LimitError(
                    f"the gzip file becomes more than {MOST_RATIO} times as large: no log does. If it is "
                    "one, unpack it first (gunzip)."
                )
        return count

    def close(self) -> None:
        if not self.closed:
            self._source.close()
            if self._packed is not None:
                self._packed.close()
        super().close()


class BoundedReader(Iterator[str]):
    """Lines for a reader of rows, of which one row may take only so many characters."""

    def __init__(self, lines: Iterator[str]) -> None:
        self._lines = lines
        self._left = MOST_LINE

    def new_row(self) -> None:
        """A row begins."""
        self._left = MOST_LINE

    def __next__(self) -> str:
        line = next(self._lines)
        self._left -= len(line)
        if self._left < 0:
            raise LimitError(
                f"a row takes more than {MOST_LINE >> 20} MiB, with the line ends in its quoted cells: is a "
                "quote not closed? Write it twice inside a cell."
            )
        return line
