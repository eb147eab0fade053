"""``rovercheck check-log --json``: what was found in logs (``checker/schemas/conform-1.json``)."""

from collections.abc import Mapping
from typing import Annotated, Literal, NotRequired

from annotated_types import Ge, MinLen
from typing_extensions import TypedDict

from rovercheck.checker.commands.check_log.campaign import LogCampaign
from rovercheck.checker.commands.check_log.text import LogFault, Outcome
from rovercheck.checker.commands.shared.campaign_document import CampaignDocument, campaign_document
from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.commands.shared.known import KnownRow, known_rows
from rovercheck.checker.conformance.deviations import Deviation, DeviationKind
from rovercheck.checker.conformance.known import FoundWord, Judged
from rovercheck.checker.io.document import Count, Ordinal
from rovercheck.checker.logs import LogResult, as_on_record
from rovercheck.checker.logs.invalid import InvalidCell
from rovercheck.checker.logs.monitors import LogVerdict, LogWord
from rovercheck.checker.results.campaign import CampaignRecord

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

    id: str
    """Its name in a file of known deviations."""
    known: FoundWord
    part: str
    """The part of the board in which it arises; of several, and of swapped columns, empty."""
    decided_by: str
    """The charts that decide the outputs."""
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
    ended: str
    """Why the file could not be read any further; empty if it was read to its end."""
    conforms: bool
    """Nothing deviates, no cell is without meaning, and all was read and decided."""


class UnusableRow(TypedDict):
    """A log of which nothing is said."""

    log: str
    error: str
    internal: NotRequired[Literal[True]]
    """There if it is a fault of rovercheck."""


class CampaignDeviation(TypedDict):
    """A deviation over all logs of a board."""

    id: str
    known: FoundWord
    system: str
    part: str
    decided_by: str
    kind: DeviationKind
    outputs: list[str]
    charts: list[str]
    logs: Ordinal
    """In how many logs."""
    ticks: Ordinal
    first_log: str
    """The log in which it is met after the fewest ticks."""
    first_tick: Ordinal


class LogHead(TypedDict):
    """What every such document begins with."""

    schema: Literal["rovercheck/conform/1"]
    exit: Exit
    """The exit code; of a folder the gravest of its logs, in the order 3, 1, 4, 2."""


class LogDocument(LogRow, LogHead):
    """What ``rovercheck check-log FILE --json`` prints."""

    known: list[KnownRow]
    """The known deviations of the board that were named."""
    campaign: CampaignDocument
    """What ``--html`` shows of it."""


class FolderDocument(LogHead):
    """What ``rovercheck check-log FOLDER --json`` prints."""

    logs: Annotated[list[LogRow | UnusableRow], MinLen(1)]
    deviations: list[CampaignDeviation]
    """Each once over all logs, of each board what explains most first."""
    known: list[KnownRow]
    campaign: CampaignDocument
    """What ``--html`` shows of them."""


CheckLogDocument = LogDocument | FolderDocument
"""What ``rovercheck check-log --json`` prints: of a log what was found in it, of a folder that of each."""


def log_document(
    found: LogResult, charts: str, code: Exit, campaign: LogCampaign, record: CampaignRecord
) -> LogDocument:
    """All of a log; ``charts``: how the charts differ from those specified, in words."""
    return {
        "schema": "rovercheck/conform/1",
        "exit": code,
        **_log(found, charts, campaign),
        "known": _known(campaign),
        "campaign": campaign_document(record),
    }


def folder_document(
    found: Mapping[str, Outcome], charts: str, code: Exit, campaign: LogCampaign, record: CampaignRecord
) -> FolderDocument:
    """All of a folder: what came of each log, by its name."""
    return {
        "schema": "rovercheck/conform/1",
        "exit": code,
        "logs": [_entry(name, outcome, charts, campaign) for name, outcome in found.items()],
        "deviations": [
            _over_all(board, one, campaign) for board, every in campaign.deviations.items() for one in every
        ],
        "known": _known(campaign),
        "campaign": campaign_document(record),
    }


def _known(campaign: LogCampaign) -> list[KnownRow]:
    return [row for judgement in campaign.judgements.values() for row in known_rows(judgement)]


def _over_all(board: str, one: Deviation, campaign: LogCampaign) -> CampaignDeviation:
    judged = campaign.judgements[board].of(one)
    return {
        "id": judged.id,
        "known": judged.word,
        "system": board,
        "part": one.scope.part,
        "decided_by": one.first.decided_by,
        "kind": one.kind,
        "outputs": list(one.outputs),
        "charts": list(one.scope.charts),
        "logs": one.runs,
        "ticks": one.count,
        "first_log": one.origin,
        "first_tick": one.first.tick,
    }


def _entry(name: str, found: Outcome, charts: str, campaign: LogCampaign) -> LogRow | UnusableRow:
    match found:
        case LogResult():
            return _log(found, charts, campaign)
        case LogFault(message):
            return {"log": name, "error": message, "internal": True}
        case _:
            return {"log": name, "error": str(found)}


def _log(found: LogResult, charts: str, campaign: LogCampaign) -> LogRow:
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
        "deviations": [_deviation(d, campaign.of(found, d)) for d in found.behaviour.deviations],
        "unknown": [
            {"part": u.part, "from_tick": u.tick, "because": u.because} for u in found.behaviour.undecided
        ],
        "ended": found.ended,
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


def _deviation(one: Deviation, judged: Judged) -> DeviationRow:
    return {
        "id": judged.id,
        "known": judged.word,
        "part": one.scope.part,
        "decided_by": one.first.decided_by,
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
