"""``rovercheck compare --json``: charts against an implementation (``checker/schemas/crosscheck-1.json``)."""

from collections.abc import Sequence
from typing import Annotated, Literal

from annotated_types import MinLen
from typing_extensions import TypedDict

from rovercheck.checker.commands.compare.text import CrosscheckReport, shown
from rovercheck.checker.commands.diagnose.document import ChangeRow, change_row
from rovercheck.checker.commands.shared.campaign_document import CampaignDocument, campaign_document
from rovercheck.checker.commands.shared.cause_text import says
from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.commands.shared.known import KnownRow, known_rows
from rovercheck.checker.compare.beside import StepMismatch
from rovercheck.checker.compare.result import CompareResult, Failure
from rovercheck.checker.conformance.deviations import Deviation, DeviationKind
from rovercheck.checker.conformance.known import FoundWord
from rovercheck.checker.diagnosis.causes import DeviationCause
from rovercheck.checker.io.document import Count, Ordinal, Text
from rovercheck.checker.results.campaign import CampaignRecord
from rovercheck.spec_model.abstraction import Value

CompareWord = Literal["mismatch", "failure", "known", "conforms", "inconclusive"]


class TransitionsRow(TypedDict):
    """Transitions that the charts took, of how many."""

    taken: Count
    all: Count
    missing: list[str]
    """Those that they took in no run."""


class BoundariesRow(TypedDict):
    """Sides of boundaries that were met, of how many."""

    met: Count
    all: Count


class StageRow(TypedDict):
    """How many runs of a kind were tried."""

    kind: str
    tried: Count
    of: Count | None
    """Of how many; null: not counted."""
    because: str
    """Why not all, if not all."""


class DifferingOutput(TypedDict):
    """An output that is not as the charts require."""

    output: str
    expected: Value
    actual: Value | None


class MismatchRow(TypedDict):
    """A deviation, and a run in whose last step it is met."""

    id: str
    """Its name in a file of known deviations."""
    known: FoundWord
    part: str
    """The part of the board in which it arises."""
    decided_by: str
    """The charts that decide the outputs."""
    kind: DeviationKind
    on_top: bool
    """Whether it is left beside the charts with the changes that explain what is known of the part."""
    runs: Ordinal
    """In how many runs it was met."""
    ticks: Ordinal
    """In how many steps of all runs."""
    step: Ordinal
    origin: str
    """The run that led to it."""
    small: bool
    """Whether the run was made as small as it can be made."""
    earlier: Count
    """Steps before in which other outputs than required are given, too."""
    inputs: dict[str, Value]
    differences: list[DifferingOutput]
    arrows: list[str]
    """What the charts that decide the outputs did in the step: transitions, or the states kept."""
    test: str
    """The test that was written for it, if any."""


class CauseGroup(TypedDict):
    """A finding: deviations of one cause, each in no other; one by itself where no cause is known."""

    id: str
    part: str
    says: str
    """What explains them, in words: a change of the charts, or other values of an input that is computed
    from stamps; empty where nothing does."""
    change: ChangeRow | None
    other_places: list[ChangeRow]
    """The same change in other places, as a limit that two charts have in common."""
    rivals: list[ChangeRow]
    """Other changes that explain exactly as much, up to two of those that were tried."""
    complete: bool
    """Whether the changes found in the part explain all that it does otherwise."""
    runs: Ordinal
    """In how many runs some of them was met."""
    ticks: Ordinal
    """In how many steps of all runs."""
    deviations: Annotated[list[str], MinLen(1)]
    """Their ids, that which was met in most runs first."""


class CutSearchRow(TypedDict):
    """A part in which not all changes were tried in the time: one cause may be several there."""

    part: str
    tried: Count
    seconds: float


class UndecidedRuns(TypedDict):
    """A part of the board that was not wholly decided after a deviation."""

    part: str
    because: str
    runs: Ordinal


class FailureRow(TypedDict):
    """A run that the implementation did not survive."""

    origin: str
    step: Count
    """0: at power-up."""
    inputs: dict[str, Value]
    message: str
    test: str


class ComparedRow(TypedDict):
    """The result of one board."""

    system: str
    implementation: Text
    charts: str
    """How the charts differ from those specified, in words."""
    verdict: CompareWord
    steps: Count
    runs: Count
    examples: Count
    seed: int
    arrows: TransitionsRow
    boundaries: BoundariesRow
    uncompared: list[str]
    """Outputs that the implementation never gave."""
    tried: list[StageRow]
    compared: Count
    """The steps in which the implementation was compared: those that it answered."""
    distinct: Count
    mismatches: list[MismatchRow]
    causes: list[CauseGroup]
    """The findings: all deviations by cause."""
    causes_cut: list[CutSearchRow]
    causes_unfit: list[str]
    """Where the search for causes came to no end."""
    failures: list[FailureRow]
    undecided: list[UndecidedRuns]
    known: list[KnownRow]
    """The known deviations of the board that were named."""


class CompareDocument(TypedDict):
    """What ``rovercheck compare --json`` prints."""

    schema: Literal["rovercheck/crosscheck/1"]
    complete: bool
    """False after an interruption: this is what was found so far."""
    exit: Exit
    results: list[ComparedRow]
    campaign: CampaignDocument
    """What ``--html`` shows of it."""


def document(reports: Sequence[CrosscheckReport], code: Exit, record: CampaignRecord) -> CompareDocument:
    """The results as JSON."""
    return {
        "schema": "rovercheck/crosscheck/1",
        "complete": not any(r.result.interrupted for r in reports),
        "exit": code,
        "results": [_row(r) for r in reports],
        "campaign": campaign_document(record),
    }


def _row(of: CrosscheckReport) -> ComparedRow:
    result, (took, every) = of.result, of.result.transitions
    met, sides = result.coverage.boundaries()
    return {
        "system": result.board.name,
        "implementation": of.address,
        "charts": of.charts or "as specified",
        "verdict": _word(of, result),
        "steps": result.coverage.steps,
        "runs": result.coverage.runs,
        "examples": result.examples,
        "seed": result.seed,
        "arrows": {"taken": took, "all": every, "missing": [str(a) for a in result.missing]},
        "boundaries": {"met": met, "all": sides},
        "uncompared": list(result.uncompared),
        "tried": [
            {"kind": s.kind, "tried": s.tried, "of": s.of, "because": s.because} for s in result.stages
        ],
        "compared": result.compared,
        "distinct": len(result.mismatches),
        "mismatches": [_mismatch(m, m.deviation, of) for m in result.mismatches if m.deviation is not None],
        "causes": [_cause(one, of) for one in of.findings],
        "causes_cut": [
            {"part": cut.part, "tried": cut.tried, "seconds": round(cut.seconds, 1)} for cut in of.groups.cut
        ],
        "causes_unfit": list(of.groups.unfit),
        "failures": [_failure(f, _file_of(f, of)) for f in result.failures],
        "undecided": [
            {"part": part, "because": because, "runs": runs}
            for (part, because), runs in result.undecided.items()
        ],
        "known": known_rows(of.judgement),
    }


def _cause(cause: DeviationCause, of: CrosscheckReport) -> CauseGroup:
    change = cause.change
    return {
        "id": cause.id(of.result.board.name),
        "part": cause.part,
        "says": says(cause),
        "change": None if change is None else change_row(change),
        "other_places": [change_row(one) for one in cause.other_places],
        "rivals": [change_row(one) for one in cause.rivals],
        "complete": cause.alone,
        "runs": cause.runs,
        "ticks": cause.ticks,
        "deviations": [of.judgement.of(one).id for one in cause.deviations],
    }


def _file_of(found: StepMismatch | Failure, of: CrosscheckReport) -> str:
    """The test that was written for it, if any."""
    return next(
        (str(file) for one, file in zip(shown(of.result), of.files, strict=False) if one is found), ""
    )


def _word(of: CrosscheckReport, result: CompareResult) -> CompareWord:
    if result.mismatches and not of.differs:
        return "known" if of.as_expected else "inconclusive"
    if of.differs and result.mismatches:
        return "mismatch"
    return "failure" if result.failures else "conforms" if result.conforms else "inconclusive"


def _failure(failure: Failure, file: str) -> FailureRow:
    return {
        "origin": failure.origin,
        "step": failure.tick,
        "inputs": dict(failure.steps[-1].inputs) if failure.steps else {},
        "message": failure.message,
        "test": file,
    }


def _mismatch(mismatch: StepMismatch, deviation: Deviation, of: CrosscheckReport) -> MismatchRow:
    judged = of.judgement.of(deviation)
    met = of.result.met.get(deviation.scope, deviation)
    return {
        "id": judged.id,
        "known": judged.word,
        "part": deviation.scope.part,
        "decided_by": deviation.first.decided_by,
        "kind": deviation.kind,
        "on_top": deviation.scope.on_top,
        "runs": met.runs,
        "ticks": met.count,
        "step": mismatch.tick,
        "origin": mismatch.origin,
        "small": mismatch.small,
        "earlier": mismatch.earlier,
        "inputs": dict(mismatch.steps[-1].inputs),
        "differences": [
            {"output": d.name, "expected": d.expected, "actual": d.actual} for d in mismatch.differences
        ],
        "arrows": list(deviation.first.moves),
        "test": _file_of(mismatch, of),
    }


__all__ = ["document"]
