"""``rovercheck check-log --json``: what was found in logs (``checker/schemas/conform-1.json``)."""

from collections.abc import Mapping
from typing import Annotated, Literal, NotRequired

from annotated_types import Ge, MinLen
from typing_extensions import TypedDict

from rovercheck.checker.commands.check_log.text import LogFault, Outcome
from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.conformance.deviations import Deviation, DeviationKind
from rovercheck.checker.io.document import Count, Ordinal
from rovercheck.checker.logs import LogResult, as_on_record
from rovercheck.checker.logs.invalid import InvalidCell
from rovercheck.checker.logs.monitors import LogVerdict, LogWord

Line = Annotated[int, Ge(2)]
"""Of the file, from 1, after the names of its columns; of Parquet the row plus 1."""


class CellRow(TypedDict):
    """A cell without meaning."""

    column: str
    signal: str
    value: str
    """The text of the cell, at most 64 characters of it."""
    because: str
    """What the model knows of the signal."""
    first_tick: Ordinal | None
    """Null in a row that was passed over, because its time has no meaning."""
    first_line: Line
    last_line: Line
    rows: Ordinal
    """How many rows hold this text there."""


class FirstRow(TypedDict):
    """The first tick in which a property is broken, or reached."""

    tick: Ordinal
    line: Line
    false: list[str]
    values: dict[str, str]


class LogVerdictRow(TypedDict):
    """What a log says of a property."""

    id: str
    verdict: LogWord
    as_on_record: bool
    ticks: Count
    ticks_tested: Count
    first: NotRequired[FirstRow]


class LoggedDifference(TypedDict):
    """An output that is not as the charts require."""

    output: str
    expected: list[str]
    logged: str


class DeviationRow(TypedDict):
    """Outputs that are not as the charts require, with where they first are."""

    kind: DeviationKind
    outputs: list[str]
    first_tick: Ordinal
    first_line: Line
    last_tick: Ordinal
    ticks: Ordinal
    times: Ordinal
    differences: list[LoggedDifference]
    charts: list[str]
    inputs: dict[str, str]


class UndecidedPart(TypedDict):
    """A part of the board of which nothing is known from a tick on."""

    part: str
    from_tick: Ordinal
    because: str


class LogRow(TypedDict):
    """What was found in a log."""

    log: str
    """The name of the file."""
    system: str
    """The board."""
    charts: str
    """How the charts differ from those specified, in words."""
    start: Literal["power-up", "any"]
    rows: Ordinal
    ticks: Ordinal
    missing_steps: Count
    invalid_cells: list[CellRow]
    """Cells without meaning; their values were taken as not logged."""
    invalid_cells_of_other_values: dict[str, Ordinal]
    """Of a column with many different cells without meaning: how many more there are."""
    ignored_columns: list[str]
    inferred: list[str]
    compared: list[str]
    not_compared: list[str]
    properties: list[LogVerdictRow]
    not_monitorable: dict[str, list[str]]
    """The columns that a property lacks."""
    not_for_logs: dict[str, str]
    """Why no log tells of a property."""
    deviations: list[DeviationRow]
    unknown: list[UndecidedPart]
    conforms: bool
    """Nothing deviates, no cell is without meaning, and all was decided."""


class UnusableRow(TypedDict):
    """A log of which nothing is said."""

    log: str
    error: str
    internal: NotRequired[Literal[True]]
    """There if it is a fault of rovercheck."""


class LogHead(TypedDict):
    """What every such document begins with."""

    schema: Literal["rovercheck/conform/1"]
    exit: Exit
    """The exit code; of a folder the gravest of its logs, in the order 3, 1, 4, 2."""


class LogDocument(LogRow, LogHead):
    """What ``rovercheck check-log FILE --json`` prints."""


class FolderDocument(LogHead):
    """What ``rovercheck check-log FOLDER --json`` prints."""

    logs: Annotated[list[LogRow | UnusableRow], MinLen(1)]


CheckLogDocument = LogDocument | FolderDocument
"""What ``rovercheck check-log --json`` prints: of a log what was found in it, of a folder that of each."""


def log_document(found: LogResult, charts: str, code: Exit) -> LogDocument:
    """All of a log; ``charts``: how the charts differ from those specified, in words."""
    return {"schema": "rovercheck/conform/1", "exit": code, **_log(found, charts)}


def folder_document(found: Mapping[str, Outcome], charts: str, code: Exit) -> FolderDocument:
    """All of a folder: what came of each log, by its name."""
    rows = [_entry(name, outcome, charts) for name, outcome in found.items()]
    return {"schema": "rovercheck/conform/1", "exit": code, "logs": rows}


def _entry(name: str, found: Outcome, charts: str) -> LogRow | UnusableRow:
    match found:
        case LogResult():
            return _log(found, charts)
        case LogFault(message):
            return {"log": name, "error": message, "internal": True}
        case _:
            return {"log": name, "error": str(found)}


def _log(found: LogResult, charts: str) -> LogRow:
    return {
        "log": found.name,
        "system": found.layout.board,
        "charts": charts or "as specified",
        "start": "power-up" if found.start == "power-up" else "any",
        "rows": found.rows,
        "ticks": found.ticks,
        "missing_steps": found.missing,
        "invalid_cells": [_cell(c) for c in found.invalid.cells],
        "invalid_cells_of_other_values": dict(found.invalid.others),
        "ignored_columns": list(found.layout.ignored),
        "inferred": list(found.behaviour.inferred),
        "compared": list(found.behaviour.compared),
        "not_compared": list(found.behaviour.left_out),
        "properties": [_verdict(v) for v in found.verdicts],
        "not_monitorable": {o.property.id: list(o.missing) for o in found.choice.missing},
        "not_for_logs": {o.property.id: o.because for o in found.choice.untold},
        "deviations": [_deviation(d) for d in found.behaviour.deviations],
        "unknown": [
            {"part": u.part, "from_tick": u.tick, "because": u.because} for u in found.behaviour.undecided
        ],
        "conforms": found.conforms,
    }


def _cell(cell: InvalidCell) -> CellRow:
    return {
        "column": cell.column,
        "signal": cell.signal,
        "value": cell.text,
        "because": cell.because,
        "first_tick": cell.tick,
        "first_line": cell.line,
        "last_line": cell.last_line,
        "rows": cell.count,
    }


def _verdict(verdict: LogVerdict) -> LogVerdictRow:
    row: LogVerdictRow = {
        "id": verdict.prop.id,
        "verdict": verdict.word,
        "as_on_record": as_on_record(verdict) if verdict.count else True,
        "ticks": verdict.count,
        "ticks_tested": verdict.tested,
    }
    if verdict.first is not None:
        row["first"] = {
            "tick": verdict.first.tick,
            "line": verdict.first.line,
            "false": list(verdict.first.parts),
            "values": dict(verdict.first.values),
        }
    return row


def _deviation(one: Deviation) -> DeviationRow:
    return {
        "kind": one.kind,
        "outputs": list(one.outputs),
        "first_tick": one.first.tick,
        "first_line": one.first.line,
        "last_tick": one.last,
        "ticks": one.count,
        "times": one.times,
        "differences": [_difference(d.output.name, *d.values()) for d in one.differences],
        "charts": list(one.first.moves),
        "inputs": dict(one.first.inputs),
    }


def _difference(output: str, expected: list[str], logged: str) -> LoggedDifference:
    return {"output": output, "expected": expected, "logged": logged}


__all__ = ["folder_document", "log_document"]
