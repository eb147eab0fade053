"""The map of a log: which column holds which signal, in which unit, under which names (TOML)."""

import tomllib
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from math import isnan
from pathlib import Path
from typing import Any, ParamSpec, TypeVar

from rovercheck.checker.io.printable import one_line
from rovercheck.checker.io.toml_lines import line_of
from rovercheck.checker.logs.errors import LogError, shortened
from rovercheck.spec_model.lang.errors import did_you_mean

TO_UNIT: Mapping[tuple[str, str], tuple[float, float]] = {
    ("s", "ms"): (1000, 0), ("us", "ms"): (0.001, 0), ("ns", "ms"): (0.000001, 0),
    ("m", "cm"): (100, 0), ("mm", "cm"): (0.1, 0),
    ("rad", "°"): (57.29577951308232, 0), ("rad/s", "°/s"): (57.29577951308232, 0),
    ("K", "°C"): (1, -273.15), ("°F", "°C"): (5 / 9, -160 / 9), ("F", "°C"): (5 / 9, -160 / 9),
    ("1", "%"): (100, 0), ("rps", "rpm"): (60, 0), ("rad/s", "rpm"): (9.549296585513721, 0),
}  # fmt: skip
"""Factor and offset from a unit that logs use to the unit of a signal."""

SAME = {"deg": "°", "degC": "°C", "C": "°C", "deg/s": "°/s", "dps": "°/s", "percent": "%", "µs": "us"}
"""Other ways to write a unit."""

LARGEST = 1e30
"""The largest number that means something in a map."""

P = ParamSpec("P")
T = TypeVar("T")

KINDS = ("value", "update", "age")


@dataclass(frozen=True)
class Column:
    """What a column holds: signal, scale and offset to its unit, names of its values.

    ``kind``: the value itself; of a time stamp also an ``update`` (true in the step that finds a new one) or
    an ``age`` in ms.  ``tolerance``: how far an output may lie from what the charts require, in the signal's
    unit; ``None`` leaves it to the precision of a 32-bit float.  ``absent``: cells that hold no value, as
    texts or as numbers before scale and offset.  ``clamp``: a measurement outside what firmware may hold is
    taken for the nearest that it may hold.  ``nonzero``: every number but 0 is true.
    """

    signal: str
    kind: str = "value"
    unit: str = ""
    scale: float = 1.0
    offset: float = 0.0
    names: Mapping[str, str] = field(default_factory=dict)
    tolerance: float | None = None
    absent: tuple[str | float, ...] = ()
    clamp: bool = False
    nonzero: bool = False


@dataclass(frozen=True)
class ColumnMap:
    """How a log is written; what is left out is found in the log itself.

    ``start``: ``power-up`` if the first row is the first step after power-up, ``any`` if the log begins
    later; empty: as the time of the first row says.
    """

    system: str = ""
    separator: str = ""
    decimal: str = ""
    start: str = ""
    columns: Mapping[str, Column] = field(default_factory=dict)


def read_map(path: Path) -> ColumnMap:
    """The map of a file.  Raises ``LogError`` for what is no map."""
    try:
        text = path.read_text(encoding="utf-8")
        table = tomllib.loads(text)
    except OSError as error:
        raise LogError(f"Cannot read the map {path}: {error.strerror}.") from error
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise LogError(f"The map {path} is no TOML: {error}.") from error
    except (RecursionError, ValueError) as error:  # tables in tables without end, numbers of 5000 digits
        raise LogError(f"The map {path} is no map of a log: {error}.") from error
    try:
        return _map(table)
    except _Wrong as error:
        line = line_of(text, error.place)
        where = f"line {line}: " if line else ""
        raise LogError(f"The map {path}: {where}{_written(error.place)}{error}") from error


class _Wrong(LogError):
    """What has no meaning at a place of the map: the names of its tables and its key."""

    def __init__(self, message: str, *place: str) -> None:
        super().__init__(message)
        self.place = place


def _written(place: tuple[str, ...]) -> str:
    """The place as it is in the file: its table and its key."""
    *tables, key = place or ("",)
    return f"[{'.'.join(map(_quoted, tables))}] {_quoted(key)}: " if tables else ""


def _quoted(key: str) -> str:
    plain = key.isascii() and key.replace("_", "").replace("-", "").isalnum()
    return key if plain else f'"{shortened(one_line(key))}"'


def _map(table: Mapping[str, Any]) -> ColumnMap:
    _known("entry", table, ("system", "log", "columns"))
    log = _table(table, "log")
    texts = _within(("log",), _of_log, log)
    columns = {
        name: _within(("columns", name), _column, name, row) for name, row in _table(table, "columns").items()
    }
    _one_each(columns)
    return ColumnMap(_text("system", table.get("system", "")), columns=columns, **texts)


def _of_log(log: Mapping[str, Any]) -> dict[str, str]:
    _known("entry of [log]", log, ("separator", "decimal", "start"))
    texts = {name: _text(f"{name} of [log]", log.get(name, "")) for name in ("separator", "decimal", "start")}
    _choice("start", texts["start"], ("", "power-up", "any"))
    _choice("decimal", texts["decimal"], ("", ".", ","))
    if len(texts["separator"]) > 1:
        raise _Wrong(f"separator = {texts['separator']!r} is no single character; write one.", "separator")
    return texts


def _one_each(columns: Mapping[str, Column]) -> None:
    seen: dict[str, str] = {}
    for name, column in columns.items():
        if column.signal in seen:
            raise _Wrong(
                f"columns {seen[column.signal]!r} and {name!r} both hold {column.signal}; leave one out.",
                "columns",
                name,
            )
        seen[column.signal] = name


def _column(name: str, row: object) -> Column:
    if isinstance(row, str):
        return Column(row)
    if not isinstance(row, dict):
        raise _Wrong(f"column {name!r} = {row!r}; write the name of a signal, or a table with signal = ....")
    known = ("signal", "as", "unit", "scale", "offset", "names", "tolerance", "absent", "clamp", "nonzero")
    _known(f"entry of column {name!r}", row, known)
    if "signal" not in row:
        raise _Wrong(f"column {name!r} names no signal; write signal = ....")
    kind = _text(f"as of column {name!r}", row.get("as", "value"))
    _choice(f"as of column {name!r}", kind, KINDS)
    names = row.get("names", {})
    if not isinstance(names, dict):
        raise _Wrong(f"names of column {name!r} must be a table: text in the log = its value.", "names")
    scale = _number(f"scale of column {name!r}", row.get("scale", 1.0))
    if not scale:
        raise _Wrong(f"scale of column {name!r} = 0 would make all its values one; write another.", "scale")
    tolerance = _number(f"tolerance of column {name!r}", row["tolerance"]) if "tolerance" in row else None
    if tolerance is not None and tolerance < 0:
        raise _Wrong(f"tolerance of column {name!r} = {tolerance:g} is negative; write 0.", "tolerance")
    return Column(
        _text(f"signal of column {name!r}", row["signal"]),
        kind,
        _text(f"unit of column {name!r}", row.get("unit", "")),
        scale,
        _number(f"offset of column {name!r}", row.get("offset", 0.0)),
        {str(k): str(v) for k, v in names.items()},
        tolerance,
        _absent(name, row.get("absent", [])),
        _truth(f"clamp of column {name!r}", row.get("clamp", False)),
        _truth(f"nonzero of column {name!r}", row.get("nonzero", False)),
    )


def _absent(name: str, given: object) -> tuple[str | float, ...]:
    cells = given if isinstance(given, list) else None
    if cells is None or any(isinstance(c, bool) or not isinstance(c, str | int | float) for c in cells):
        raise _Wrong(
            f'absent of column {name!r} = {given!r} must be a list of cells, as in absent = [255, "n/a"].',
            "absent",
        )
    for cell in cells:
        if not isinstance(cell, str) and not isnan(cell):
            _number(f"absent of column {name!r}", cell)
    return tuple(cells)


def conversion(column: Column, unit: str) -> tuple[float, float]:
    """Factor and offset to the unit of the signal.  Raises ``LogError`` for a foreign unit."""
    given = SAME.get(column.unit, column.unit)
    if not given or given == unit:
        return column.scale, column.offset
    if (given, unit) not in TO_UNIT:
        known = [a for a, b in TO_UNIT if b == unit] + [unit or "no unit"]
        raise LogError(
            f"{column.signal} is in {unit or 'no unit'}, not in {column.unit}; known: {', '.join(known)}."
        )
    factor, shift = TO_UNIT[given, unit]
    return column.scale * factor, column.offset * factor + shift


def _within(tables: tuple[str, ...], read: Callable[P, T], *args: P.args, **more: P.kwargs) -> T:
    """What is read of a table; what is wrong there is wrong within these tables."""
    try:
        return read(*args, **more)
    except _Wrong as error:
        raise _Wrong(str(error), *tables, *error.place) from error


def _key(what: str) -> str:
    return what.partition(" ")[0]


def _known(kind: str, table: Mapping[str, object], names: tuple[str, ...]) -> None:
    for name in table:
        if name not in names:
            raise _Wrong(f"{name!r} is no {kind}. {did_you_mean(name, names)}", name)


def _table(table: Mapping[str, Any], name: str) -> Mapping[str, Any]:
    found = table.get(name, {})
    if not isinstance(found, dict):
        raise _Wrong(f"{name} = {found!r} must be a table; write [{name}].", name)
    return found


def _text(what: str, value: object) -> str:
    if not isinstance(value, str):
        raise _Wrong(f"{what} = {value!r} must be a text; write it in quotes.", _key(what))
    return value


def _number(what: str, value: object) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise _Wrong(f"{what} = {value!r} must be a number.", _key(what))
    if not -LARGEST <= value <= LARGEST:  # nor what is no number
        raise _Wrong(f"{what} = {shortened(str(value))} must be a number between -1e30 and 1e30.", _key(what))
    return float(value)


def _truth(what: str, value: object) -> bool:
    if not isinstance(value, bool):
        raise _Wrong(f"{what} = {value!r} must be true or false.", _key(what))
    return value


def _choice(what: str, value: str, choices: tuple[str, ...]) -> None:
    if value not in choices:
        raise _Wrong(f"{what} = {value!r}; write {' or '.join(repr(c) for c in choices if c)}.", _key(what))
