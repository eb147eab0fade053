"""The file of known deviations: TOML, written by ``--write-known`` and kept by hand."""

import json
import re
import tomllib
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from datetime import date, datetime
from pathlib import Path
from typing import Any, NoReturn, cast, get_args

from rovercheck.checker.conformance.cones import parts_of
from rovercheck.checker.conformance.deviations import DeviationKind, DeviationScope, ScopedOutput
from rovercheck.checker.conformance.known import KnownCause, KnownDeviation, KnownDeviations
from rovercheck.checker.io.printable import one_line
from rovercheck.spec_model.abstraction import Board
from rovercheck.spec_model.lang.errors import ModelError, did_you_mean

FORMAT = "rovercheck/known/1"
AS_SPECIFIED = "as specified"
NEVER = "never"
FIELDS = ("id", "board", "part", "kind", "differences", "charts", "reason", "owner", "until")
ON_TOP = "with_causes"
"""Of a deviation from the charts with the changes of the causes of its part; it may be left out."""
DIFFERENCE = ("output", "expected", "actual")
CAUSE = ("board", "part", "deviations", "changes")
CHANGE = ("kind", "chart", "at", "from", "to")
TOP = ("format", "charts", "deviation", "cause")

HEAD = """\
# Known deviations from the charts: expected, and checked on (docs/compare.md).
# Fill in reason, owner and until (a date, or "never"); the other lines say what is known, and the causes
# at the end which changes of the charts explain it; with_causes = true: it is left beside the charts with
# the changes of its part.
"""


def known_in(file: Path, boards: Mapping[str, Board], charts: str) -> KnownDeviations:
    """The known deviations of a file.

    ``charts``: how the charts differ from those specified, in words.  Raises ``ModelError`` for a file that
    cannot be read, has no meaning, or is of other charts.
    """
    try:
        text = file.read_text(encoding="utf-8")
    except OSError as error:
        raise ModelError(
            f"{_named(file)} cannot be read: {error.strerror}; write another --known."
        ) from error
    except UnicodeDecodeError as error:
        raise ModelError(f"{_named(file)} is no text: {error}.") from error
    return known_of(text, _named(file), boards, charts)


def known_of(text: str, named: str, boards: Mapping[str, Board], charts: str) -> KnownDeviations:
    """The known deviations of a text.  Raises ``ModelError``."""
    try:
        table = tomllib.loads(text)
    except (tomllib.TOMLDecodeError, RecursionError) as error:
        raise ModelError(f"{named} is no TOML: {error}.") from error
    return _KnownReader(text, named, boards).read(table, charts or AS_SPECIFIED)


def known_text(records: Iterable[KnownDeviation], charts: str, causes: Iterable[KnownCause] = ()) -> str:
    """The file of known deviations, in an order that does not depend on how they were found."""
    lines = [HEAD, f"format = {_text(FORMAT)}", f"charts = {_text(charts or AS_SPECIFIED)}"]
    for one in sorted(records, key=lambda r: (r.board, r.scope.part, r.scope, r.id)):
        lines += ["", *_record(one)]
    for cause in sorted(causes, key=lambda c: (c.board, c.part)):
        lines += ["", *_cause(cause)]
    return "\n".join(lines) + "\n"


def _record(one: KnownDeviation) -> Iterator[str]:
    yield "[[deviation]]"
    yield f"id = {_text(one.id)}"
    yield f"board = {_text(one.board)}"
    yield f"part = {_text(one.scope.part)}"
    yield f"kind = {_text(one.scope.kind)}"
    yield "differences = ["
    for row in one.scope.differences:
        pairs = ", ".join(f"{key} = {_text(value)}" for key, value in zip(DIFFERENCE, row, strict=True))
        yield f"    {{ {pairs} }},"
    yield "]"
    if one.scope.charts:
        yield "charts = ["
        yield from (f"    {_text(move)}," for move in one.scope.charts)
        yield "]"
    else:
        yield "charts = []"
    if one.scope.on_top:
        yield f"{ON_TOP} = true"
    yield f"reason = {_text(one.reason)}"
    yield f"owner = {_text(one.owner)}"
    yield f"until = {one.until.isoformat() if one.until else _text(NEVER)}"


def _cause(one: KnownCause) -> Iterator[str]:
    yield "[[cause]]"
    yield f"board = {_text(one.board)}"
    yield f"part = {_text(one.part)}"
    yield "deviations = ["
    yield from (f"    {_text(id)}," for id in one.deviations)
    yield "]"
    yield "changes = ["
    for change in one.changes:
        pairs = ", ".join(f"{key} = {_text(value)}" for key, value in zip(CHANGE, change, strict=True))
        yield f"    {{ {pairs} }},"
    yield "]"


def _text(value: str) -> str:
    """A text in quotes: TOML escapes as JSON does, and one character more."""
    return json.dumps(value, ensure_ascii=False).replace("\x7f", r"\u007f")


def _named(file: Path) -> str:
    return one_line(str(file))


@dataclass(frozen=True)
class _KnownReader:
    """Reads the tables of a file, and knows where they are."""

    text: str
    named: str
    boards: Mapping[str, Board]

    def read(self, table: Mapping[str, Any], charts: str) -> KnownDeviations:
        for key in table:
            if key not in TOP:
                self._wrong(f"there is no {key!r}. {did_you_mean(key, TOP)}", key)
        if table.get("format") != FORMAT:
            self._wrong(f'format is {table.get("format")!r}; this version reads "{FORMAT}"', "format")
        if table.get("charts", AS_SPECIFIED) != charts:
            self._wrong(
                f"it is of charts {table['charts']!r}, and these are {charts!r}; "
                "use the options with which it was written, or a file of its own",
                "charts",
            )
        found: dict[str, KnownDeviation] = {}
        for number, row in enumerate(self._tables(table, "deviation")):
            one = self._record(number, row)
            if one.id in found:
                self._wrong(f"there are two of the id {one.id!r}; give each its own", "id", number)
            found[one.id] = one
        causes = [self._cause(n, row, found) for n, row in enumerate(self._tables(table, "cause"))]
        return KnownDeviations(tuple(found.values()), tuple(causes))

    def _tables(self, table: Mapping[str, Any], name: str) -> list[Any]:
        rows = table.get(name, [])
        if not isinstance(rows, list) or not all(isinstance(row, dict) for row in rows):
            self._wrong(f"{name} is no list of tables; begin each with [[{name}]]", name)
        return rows

    def _cause(self, number: int, row: Mapping[str, Any], known: Mapping[str, KnownDeviation]) -> KnownCause:
        where = "cause"
        for key in row:
            if key not in CAUSE:
                self._wrong(f"a cause has no {key!r}. {did_you_mean(key, CAUSE)}", key, number, where)
        for key in CAUSE:
            if key not in row:
                self._wrong(f"{key} of a cause is missing", "", number, where)
        board, part, ids, rows = (row[key] for key in CAUSE)
        if not isinstance(ids, list) or not ids or not all(isinstance(id, str) for id in ids):
            self._wrong("deviations is no list of ids", "deviations", number, where)
        for id in ids:
            if id not in known:
                told = f"there is no deviation {id!r}; if it has another id now, write that here, too"
                self._wrong(told, "deviations", number, where)
            if (known[id].board, known[id].scope.part) != (board, part):
                self._wrong(f"{id} is no deviation of {board!r}, {part!r}", "deviations", number, where)
        if not isinstance(rows, list) or not all(_is_change(one) for one in rows):
            pairs = ", ".join(CHANGE)
            self._wrong(f"changes is no list of tables of texts {{ {pairs} }}", "changes", number, where)
        return KnownCause(board, part, tuple(tuple(one[key] for key in CHANGE) for one in rows), tuple(ids))

    def _record(self, number: int, row: Mapping[str, Any]) -> KnownDeviation:
        for key in row:
            if key not in (*FIELDS, ON_TOP):
                self._wrong(f"a deviation has no {key!r}. {did_you_mean(key, FIELDS)}", key, number)
        for key in FIELDS:
            if key not in row:
                self._wrong(f"{key} is missing; --write-known writes all fields", "", number)
        id, name, part, kind, reason, owner = (
            self._string(number, row, key) for key in ("id", "board", "part", "kind", "reason", "owner")
        )
        if not id:
            self._wrong("id is empty; give it a name", "id", number)
        if name not in self.boards:
            self._wrong(f"no board {name!r}. {did_you_mean(name, self.boards)}", "board", number)
        board, kinds = self.boards[name], get_args(DeviationKind)
        if kind not in kinds:
            self._wrong(f"no kind {kind!r}. {did_you_mean(kind, kinds)}", "kind", number)
        parts = ["", name, *(p.component.name for p in parts_of(board))]
        if part not in parts:
            self._wrong(f"{name} has no part {part!r}. {did_you_mean(part, parts)}", "part", number)
        differences = self._differences(number, row["differences"], board)
        moves = row["charts"]
        if not isinstance(moves, list) or not all(isinstance(move, str) for move in moves):
            self._wrong("charts is no list of texts", "charts", number)
        on_top = row.get(ON_TOP, False)
        if not isinstance(on_top, bool):
            self._wrong(f"{ON_TOP} is {on_top!r}; write true or false", ON_TOP, number)
        scope = DeviationScope(cast(DeviationKind, kind), part, differences, tuple(moves), on_top)
        return KnownDeviation(id, name, scope, reason, owner, self._until(number, row["until"]))

    def _differences(self, number: int, rows: object, board: Board) -> tuple[ScopedOutput, ...]:
        if not isinstance(rows, list) or not rows or not all(isinstance(row, dict) for row in rows):
            self._wrong(
                "differences is no list of tables { output, expected, actual }", "differences", number
            )
        found: list[ScopedOutput] = []
        outputs = [o.name for o in board.outputs]
        for row in rows:
            self._same(number, row, DIFFERENCE)
            output, expected, actual = (self._string(number, row, key, "differences") for key in DIFFERENCE)
            if output not in outputs:
                near = did_you_mean(output, outputs)
                self._wrong(f"{board.name} has no output {output!r}. {near}", "differences", number)
            mask = re.fullmatch("0x[0-9a-f]+", expected), re.fullmatch("0x[0-9a-f]+", actual)
            if expected.startswith("0x") and not all(mask):
                self._wrong(
                    f"{expected!r} and {actual!r} are no bits; write 0x4 and 0x0", "differences", number
                )
            found.append((output, expected, actual))
        return tuple(found)

    def _same(self, number: int, row: Mapping[str, Any], keys: Collection[str]) -> None:
        for key in row:
            if key not in keys:
                near = did_you_mean(key, keys)
                self._wrong(f"a difference has no {key!r}. {near}", "differences", number)
        for key in keys:
            if key not in row:
                self._wrong(f"{key} of a difference is missing", "differences", number)

    def _string(self, number: int, row: Mapping[str, Any], key: str, at: str = "") -> str:
        value = row[key]
        if not isinstance(value, str):
            self._wrong(f"{key} is {value!r}; write a text in quotes", at or key, number)
        return value

    def _until(self, number: int, value: object) -> date | None:
        if value == NEVER:
            return None
        if isinstance(value, date) and not isinstance(value, datetime):
            return value
        self._wrong(
            f'until is {value!r}; write a date without quotes (2027-03-31), or "never"', "until", number
        )

    def _wrong(self, what: str, key: str, number: int | None = None, table: str = "deviation") -> NoReturn:
        """Raise ``ModelError`` with the place of a key of a table, or of the file."""
        raise ModelError(f"{self.named}:{self._line(key, number, table)}: {one_line(what).rstrip('.')}.")

    def _line(self, key: str, number: int | None, table: str) -> int:
        lines = self.text.splitlines()
        starts = [i for i, line in enumerate(lines) if line.replace(" ", "").startswith(f"[[{table}]]")]
        if number is None:
            return next((i for i, line in enumerate(lines, 1) if _is_key(line, key)), 1)
        start = starts[number] if number < len(starts) else 0
        end = starts[number + 1] if number + 1 < len(starts) else len(lines)
        return next((i + 1 for i in range(start, end) if key and _is_key(lines[i], key)), start + 1)


def _is_change(row: object) -> bool:
    texts = isinstance(row, dict) and all(isinstance(value, str) for value in row.values())
    return isinstance(row, dict) and texts and set(row) == set(CHANGE)


def _is_key(line: str, key: str) -> bool:
    written: Sequence[str] = line.split("=")
    return written[0].strip().strip("\"'[] ") == key
