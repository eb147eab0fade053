"""A log as blocks of steps: raw values by signal, the number of each step, and where steps are missing."""

from collections.abc import Generator, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import compress, islice
from pathlib import Path

from rovercheck.checker.conformance.recording import Cells, LogBlock, Raw
from rovercheck.checker.conformance.signals import Vocabulary
from rovercheck.checker.io.printable import one_line
from rovercheck.checker.logs.cells import CellConverter, converter
from rovercheck.checker.logs.errors import LogError, at, shortened
from rovercheck.checker.logs.files import FileRows, Texts, opened
from rovercheck.checker.logs.invalid import Invalid, InvalidCell
from rovercheck.checker.logs.mapping import Column, ColumnMap
from rovercheck.spec_model.abstraction import Board, BoardSignal
from rovercheck.spec_model.abstraction import boards as of_the_rover
from rovercheck.spec_model.abstraction.stamps import NOW
from rovercheck.spec_model.lang.domain import boolean
from rovercheck.spec_model.lang.errors import did_you_mean
from rovercheck.spec_model.lang.system import TICK_MS

TIMES = ("time_ms", "time", "t", "timestamp", "timestamp_ms")
"""Columns that hold the time of the step where none is named ``now_ms``."""

TOGETHER = 8
"""Blocks of texts that make one of values: monitors are quicker with many rows at a time."""
CLOCK = 1 << 32
EARLY_MS = 2 * TICK_MS
"""A log whose first step is not later begins at power-up."""

SOME = 8
"""Columns that are named where none has a meaning."""

_FLAG = BoardSignal("update", boolean, False)


@dataclass(frozen=True)
class LogLayout:
    """What the columns of a log are: of which board, which signal in which column, what is left over.

    ``stated``: every column with a meaning, by its name in the log.
    """

    board: str
    stated: Mapping[str, Column]
    ignored: tuple[str, ...]

    @property
    def signals(self) -> frozenset[str]:
        return frozenset(c.signal for c in self.stated.values())

    @property
    def timed(self) -> bool:
        return NOW in self.signals


@dataclass
class Log:
    """An open log; ``blocks`` reads it once.  ``start`` is known after the first block.

    ``invalid``: the cells without meaning of the rows read so far.
    """

    name: str
    layout: LogLayout
    rows: FileRows
    how: ColumnMap
    start: str = ""
    converters: list[tuple[int, str, CellConverter]] = field(default_factory=list)
    invalid: Invalid = field(default_factory=Invalid)
    _wrong: LogError | None = field(default=None, init=False, repr=False)

    def blocks(self) -> Generator[LogBlock, None, None]:
        """The steps, block by block.  Raises ``LogError`` with the line of what is wrong."""
        try:
            yield from self._blocks()
        finally:
            self.rows.close()

    def _blocks(self) -> Iterator[LogBlock]:
        clock, stamps = _Clock(self.how.start), _Stamps(self.layout)
        time = next((self.rows.header[i] for i, signal, _ in self.converters if signal == NOW), NOW)
        while (read := self._read()).lines:
            timed = read.timed(time)
            if timed.lines[:1] != read.lines[:1]:
                clock.passed_over()
            ticks: Sequence[int] = ()
            if timed.lines:
                ticks, missing = clock.steps(timed.lines, timed.values.get(NOW))
                self.start = clock.start
            self._note(timed, ticks)
            if timed.lines:
                yield stamps.of(LogBlock(timed.lines, ticks, missing, timed.values))
        if not self.start and not self.invalid:
            raise LogError("has column names but no rows.")
        if not self.start:
            first = self.invalid.cells[0]
            raise at(first.line, f"column {first.name}: {first.because} No row has a time; mend the column.")

    def _note(self, rows: "_Values", ticks: Sequence[int]) -> None:
        """The cells without meaning, each with its tick."""
        if rows.invalid:
            tick_of = dict(zip(rows.lines, ticks, strict=True))
            for cell in sorted(rows.invalid, key=lambda c: c.line):
                self.invalid.add(replace(cell, tick=tick_of.get(cell.line)))

    def _read(self) -> "_Values":
        """The next rows."""
        lines: list[int] = []
        values: dict[str, Cells] = {signal: [] for _, signal, _ in self.converters}
        invalid: list[InvalidCell] = []
        for texts in self._texts():
            lines += texts.lines
            for i, signal, convert in self.converters:
                cells = texts.columns[i]
                values[signal] += convert(cells)
                for row, because in convert.without_meaning(cells):
                    shown = shortened(cells[row].strip())
                    invalid.append(InvalidCell(self.rows.header[i], signal, shown, because, texts.lines[row]))
        return _Values(lines, values, invalid)

    def _texts(self) -> Iterator[Texts]:
        """The texts of the next rows.  What is wrong behind them is raised when nothing is left before it."""
        if self._wrong is not None:
            raise self._wrong
        count = 0
        try:
            for texts in islice(self.rows.blocks, TOGETHER):
                count += 1
                yield texts
        except LogError as error:
            if not count:
                raise
            self._wrong = error


@dataclass(frozen=True)
class _Values:
    """The lines of successive rows, their values by signal, and the cells that have none."""

    lines: Sequence[int]
    values: Mapping[str, Cells]
    invalid: Sequence[InvalidCell] = ()

    def timed(self, column: str) -> "_Values":
        """The rows whose time is known: of another one nobody knows which step it is."""
        times = self.values.get(NOW)
        if times is None or None not in times:
            return self
        keep = [time is not None for time in times]
        rows = {name: list(compress(cells, keep)) for name, cells in self.values.items()}
        told = {c.line for c in self.invalid if c.signal == NOW}
        empty = (
            InvalidCell(column, NOW, "", "the time of the step is empty.", line)
            for line, kept in zip(self.lines, keep, strict=True)
            if not kept and line not in told
        )
        found = [
            replace(c, because=f"{c.because} The row is passed over.") if c.signal == NOW else c
            for c in (*self.invalid, *empty)
        ]
        return _Values(list(compress(self.lines, keep)), rows, found)


class _Clock:
    """The step of each row: by its time, or one step a row where no time is logged."""

    def __init__(self, start: str) -> None:
        self.start = ""
        self._asked = start
        self._before: int | None = None
        self._tick = 0

    def passed_over(self) -> None:
        """Rows without a time: a log that begins with them does not begin at power-up."""
        if not self.start:
            self.start = "any"

    def steps(self, lines: Sequence[int], times: Cells | None) -> tuple[Sequence[int], list[int]]:
        """Numbers of the steps and of those missing before each.  Raises ``LogError``."""
        if not self.start:
            self._begin(times)
        if times is None or self._regular(times):
            first, self._tick = self._tick + 1, self._tick + len(lines)
            return range(first, self._tick + 1), [0] * len(lines)
        missing = list(map(self._lost, lines, times))
        ticks: list[int] = []
        for lost in missing:
            self._tick += 1 + lost
            ticks.append(self._tick)
        return ticks, missing

    def _regular(self, times: Cells) -> bool:
        """Whether each of the steps is exactly one after the one before."""
        first = times[0]
        if first is None or (self._before is not None and first != self._before + TICK_MS):
            return False
        last = int(first) + TICK_MS * (len(times) - 1)
        if times != list(range(int(first), last + 1, TICK_MS)):
            return False
        self._before = last
        return True

    def _begin(self, times: Cells | None) -> None:
        first = 0 if times is None else times[0]
        assert first is not None, "rows without a time are passed over"
        self.start = self._asked or ("power-up" if first <= EARLY_MS else "any")

    def _lost(self, line: int, time: Raw | None) -> int:
        assert time is not None, "rows without a time are passed over"
        now, before = int(time), self._before
        self._before = now
        if before is None:
            return 0
        passed = (now - before) % CLOCK
        if passed >= CLOCK // 2:
            raise at(line, f"time runs backwards, from {before} ms to {now} ms; sort the rows by time.")
        if passed < TICK_MS / 2:
            raise at(
                line,
                f"{passed} ms after the row before; a step takes {TICK_MS} ms. Log one row for each step, "
                "and its time in ms (or write unit = in the map).",
            )
        return round(passed / TICK_MS) - 1


# --- stamps that are told in other ways -------------------------------------------------------


class _Stamps:
    """Updates and ages turned into the stamps they stand for."""

    def __init__(self, layout: LogLayout) -> None:
        self._told = [c for c in layout.stated.values() if c.kind != "value"]
        self._latest: dict[str, Raw] = {}

    def of(self, block: LogBlock) -> LogBlock:
        values = dict(block.values)
        for column in self._told:
            make = self._from_updates if column.kind == "update" else self._from_ages
            values[column.signal] = make(column.signal, values[NOW], values[column.signal])
        return replace(block, values=values) if self._told else block

    def _from_updates(self, signal: str, now: Cells, updates: Cells) -> Cells:
        found: Cells = []
        for time, update in zip(now, updates, strict=True):
            if update and time is not None:
                self._latest[signal] = time
            found.append(None if update is None else self._latest.get(signal, 0))
        return found

    def _from_ages(self, signal: str, now: Cells, ages: Cells) -> Cells:
        return [
            None if age is None or time is None else int(time - age) % CLOCK
            for time, age in zip(now, ages, strict=True)
        ]


# --- opening --------------------------------------------------------------------------------------


def open_log(path: Path, how: ColumnMap, system: str = "", boards: Mapping[str, Board] | None = None) -> Log:
    """The log of a file, of one of these boards, by default of the rover's.

    Raises ``LogError`` for what is no log of a board.
    """
    rows = opened(path, how)
    try:
        return _log(path.name, rows, how, system, of_the_rover() if boards is None else boards)
    except LogError:
        rows.close()
        raise


def _log(name: str, rows: FileRows, how: ColumnMap, system: str, boards: Mapping[str, Board]) -> Log:
    layout = _layout(rows.header, how, system or how.system, boards)
    vocabulary = Vocabulary(boards[layout.board])
    log = Log(name, layout, rows, how)
    for index, header in enumerate(rows.header):
        if (column := layout.stated.get(header)) is not None:
            convert = _converter(column, vocabulary, rows.decimal_comma)
            log.converters.append((index, column.signal, convert))
    return log


def _converter(column: Column, vocabulary: Vocabulary, comma: bool) -> CellConverter:
    signal = vocabulary.signals[column.signal]
    if column.kind == "update":
        return converter(replace(column, unit=""), _FLAG, True, comma)
    return converter(column, signal, signal.name in vocabulary.inputs, comma)


def _layout(header: Sequence[str], how: ColumnMap, system: str, boards: Mapping[str, Board]) -> LogLayout:
    names = set(header)
    for name in how.columns:
        if name not in names:
            raise LogError(f"has no column {name!r}, which the map names. {did_you_mean(name, header)}")
    board = system or _board_of(header, how, boards)
    if board not in boards:
        raise LogError(
            f"There is no system {board!r} of which logs are checked. {did_you_mean(board, boards)}"
        )
    vocabulary = Vocabulary(boards[board])
    stated = _stated(header, how, vocabulary)
    if not any(c.signal not in vocabulary.inputs for c in stated.values()):
        outputs = ", ".join(o.name for o in vocabulary.board.outputs[:6])
        raise LogError(f"holds no output of {board}: {outputs} ...; rename a column, or write a map.")
    ignored = tuple(name for name in header if name not in stated)
    layout = LogLayout(board, stated, ignored)
    if any(c.kind != "value" for c in stated.values()) and not layout.timed:
        raise LogError(f"holds updates or ages but not the time of the step; map a column to {NOW}.")
    return layout


def _stated(header: Sequence[str], how: ColumnMap, vocabulary: Vocabulary) -> dict[str, Column]:
    for name, column in how.columns.items():
        if column.signal not in vocabulary.signals:
            near = did_you_mean(column.signal, vocabulary.signals)
            raise LogError(
                f"The map: column {name!r}: {vocabulary.board.name} has no signal {column.signal!r}. {near}"
            )
        if column.kind != "value" and not vocabulary.signals[column.signal].stamp:
            raise LogError(f"The map: column {name!r}: {column.signal} is no time stamp; leave `as` out.")
    mapped = {c.signal for c in how.columns.values()}
    found: dict[str, Column] = {}
    for name in header:
        if name in how.columns:
            found[name] = how.columns[name]
        elif name in vocabulary.signals and name not in mapped:
            found[name] = Column(name)
    if not any(c.signal == NOW for c in found.values()):
        found |= {n: Column(NOW) for n in [t for t in TIMES if t in header and t not in found][:1]}
    return found


def _named(header: Sequence[str]) -> str:
    """The first names of columns."""
    rest = ", ..." if len(header) > SOME else ""
    return ", ".join(shortened(one_line(name)) for name in header[:SOME]) + rest


def _board_of(header: Sequence[str], how: ColumnMap, boards: Mapping[str, Board]) -> str:
    names = {how.columns[name].signal if name in how.columns else name for name in header}
    scores = {n: len(names & Vocabulary(b).signals.keys() - {NOW}) for n, b in boards.items()}
    best = max(scores, key=lambda name: scores[name])
    others = [n for n, score in scores.items() if n != best and score == scores[best]]
    if not scores[best]:
        some = ", ".join(list(Vocabulary(next(iter(boards.values()))).signals)[:8])
        raise LogError(
            f"no column has the name of a signal ({some} ...): its columns are {_named(header)}. "
            "Write a map of the columns, and name it with --map."
        )
    if others:
        raise LogError(f"may be of {best} or of {' or '.join(others)}; say which with --system.")
    return best
