"""``rovercheck diagnose --json``: causes found in logs (``checker/schemas/diagnose-1.json``)."""

from collections.abc import Mapping, Sequence
from typing import Annotated, Literal

from annotated_types import MinLen
from typing_extensions import TypedDict

from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.conformance.mismatch import LogMismatch
from rovercheck.checker.diagnosis.change import ChangeKind, ChartChange
from rovercheck.checker.diagnosis.decide import DecidingRun
from rovercheck.checker.diagnosis.result import BoardDiagnosis, DiagnosedPart
from rovercheck.checker.diagnosis.search import ExplainingCause
from rovercheck.checker.diagnosis.sentences import behaves, explained
from rovercheck.checker.io.document import Count, Ordinal

MOST_CASES = 20


class ChangeRow(TypedDict):
    """One change of a chart or block, as a variant holds it."""

    kind: ChangeKind
    chart: str
    at: str
    old: str
    """What stands there as drawn."""
    new: str
    """What stands there as changed."""
    note: str
    """What else would do: the values that the recordings allow; often empty."""


class CauseRow(TypedDict):
    """One or more changes that together explain cases."""

    says: str
    changes: Annotated[list[ChangeRow], MinLen(1)]
    explained: Count
    """Cases that are explained."""
    wrong_rows: Count
    """Rows that become wrong: 0 for a cause that explains all."""


class HeldRow(TypedDict):
    """Inputs of a part that are held for some steps: those that change at its start."""

    steps: Ordinal
    inputs: dict[str, str]


class DecidingRow(TypedDict):
    """A run from power-up after whose last step an output has two values."""

    inputs: list[HeldRow]
    output: str
    first: str
    """By the nearest cause; of a prediction as the charts require."""
    second: str
    """By the other cause; of a prediction by the nearest cause."""


class RivalRow(TypedDict):
    """Another cause that explains as much."""

    cause: CauseRow
    decides: DecidingRow | None
    """A run that would tell the two apart; null if none was found."""


class CaseRow(TypedDict):
    """The first tick of a case."""

    recording: str
    tick: Ordinal
    line: Ordinal
    outputs: list[str]
    expected: list[list[str]]
    """The values that the charts allow, of each output."""
    recorded: list[str]
    charts: list[str]
    inputs: dict[str, str]


class PartRow(TypedDict):
    """A part of a board that deviates."""

    part: str
    says: str
    cases: Ordinal
    recordings: Annotated[list[str], MinLen(1)]
    cause: CauseRow | None
    """Null: no change was found that explains all."""
    partial: CauseRow | None
    """The best that explains some, where none explains all."""
    rivals: list[RivalRow]
    more_rivals: Count
    predicts: DecidingRow | None
    tried: Count
    """Changes that were tried."""
    candidates: Count
    """Changes there are: more than were tried if the time was over."""
    first_cases: Annotated[list[CaseRow], MinLen(1)]


class BoardRow(TypedDict):
    """What was found of one board."""

    board: str
    recordings: list[str]
    conforming: list[str]
    not_decided: list[str]
    parts: list[PartRow]


class DiagnoseDocument(TypedDict):
    """What ``rovercheck diagnose --json`` prints."""

    schema: Literal["rovercheck/diagnose/1"]
    exit: Exit
    boards: list[BoardRow]
    not_read: dict[str, str]
    """Logs that could not be read, with the reason."""
    ended: dict[str, str]
    """Logs that could not be read to their ends, and count as far as they were, with the reason."""


def diagnose_document(
    found: Sequence[BoardDiagnosis], unread: Mapping[str, str], ended: Mapping[str, str], code: Exit
) -> DiagnoseDocument:
    """All that was found."""
    return {
        "schema": "rovercheck/diagnose/1",
        "exit": code,
        "boards": [_board(one) for one in found],
        "not_read": dict(unread),
        "ended": dict(ended),
    }


def _board(found: BoardDiagnosis) -> BoardRow:
    return {
        "board": found.board.name,
        "recordings": list(found.runs),
        "conforming": list(found.conforming),
        "not_decided": list(found.undecided),
        "parts": [_part(one) for one in found.parts],
    }


def _part(part: DiagnosedPart) -> PartRow:
    return {
        "part": part.name,
        "says": explained(part),
        "cases": part.cases,
        "recordings": list(part.runs),
        "cause": None if part.cause is None else _cause(part.cause),
        "partial": None if part.partial is None else _cause(part.partial),
        "rivals": [
            {"cause": _cause(r.cause), "decides": None if r.run is None else _run(r.run)} for r in part.rivals
        ],
        "more_rivals": part.more_rivals,
        "predicts": None if part.prediction is None else _run(part.prediction),
        "tried": part.tried,
        "candidates": part.of,
        "first_cases": _cases(part),
    }


def change_row(c: ChartChange) -> ChangeRow:
    """A change, as a variant holds it."""
    return {"kind": c.kind, "chart": c.chart, "at": c.at, "old": c.old, "new": c.new, "note": c.note}


def _cause(cause: ExplainingCause) -> CauseRow:
    return {
        "says": behaves(cause),
        "changes": list(map(change_row, cause.changes)),
        "explained": cause.trial.explained,
        "wrong_rows": cause.trial.wrong,
    }


def _run(run: DecidingRun) -> DecidingRow:
    inputs: list[HeldRow] = [{"steps": b.steps, "inputs": dict(b.changes)} for b in run.blocks]
    return {"inputs": inputs, "output": run.output, "first": run.one, "second": run.other}


def _cases(part: DiagnosedPart) -> list[CaseRow]:
    found: list[CaseRow] = []
    for evidence in part.evidence:
        for run in evidence.deviating:
            found += [_case(run.run.name, case.mismatch) for case in run.cases(evidence.name)]
    return found[:MOST_CASES]


def _case(name: str, mismatch: LogMismatch) -> CaseRow:
    return {
        "recording": name,
        "tick": mismatch.tick,
        "line": mismatch.line,
        "outputs": list(mismatch.outputs),
        "expected": [d.values()[0] for d in mismatch.differences],
        "recorded": [d.values()[1] for d in mismatch.differences],
        "charts": list(mismatch.moves),
        "inputs": dict(mismatch.inputs),
    }
