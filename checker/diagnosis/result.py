"""Causes of a board's deviations over all of its recordings, each once, with what would tell two apart."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field, replace

from rovercheck.checker.conformance.recording import Recording
from rovercheck.checker.diagnosis.decide import DecidingRun, RunSearch
from rovercheck.checker.diagnosis.evidence import EvidenceCollector, PartEvidence
from rovercheck.checker.diagnosis.search import SECONDS, ExplainingCause, PartDiagnosis, diagnosed
from rovercheck.checker.diagnosis.trial import TrialBench
from rovercheck.checker.diagnosis.variant import WrittenChange, with_change
from rovercheck.spec_model.abstraction import Board
from rovercheck.spec_model.lang.errors import ModelError

MOST_RIVALS = 3
"""Other causes that explain as much, told beside the nearest."""


@dataclass(frozen=True)
class RivalCause:
    """Another cause that explains as much; ``run``: what would decide, ``None`` if no such run was found."""

    cause: ExplainingCause
    run: DecidingRun | None


@dataclass(frozen=True)
class DiagnosedPart:
    """What one part of a board does otherwise, over all recordings.

    ``cause``: the nearest change or changes that explain every case; ``None``: none was found.
    ``partial`` explains some of them.  ``prediction``: a run in which the cause shows in a way that no
    recording does.
    """

    name: str
    cases: int
    runs: tuple[str, ...]
    cause: ExplainingCause | None
    partial: ExplainingCause | None
    rivals: tuple[RivalCause, ...]
    more_rivals: int
    prediction: DecidingRun | None
    tried: int
    of: int
    seconds: float
    evidence: tuple[PartEvidence, ...]

    @property
    def complete(self) -> bool:
        """Whether all changes were tried."""
        return self.tried == self.of


@dataclass
class BoardDiagnosis:
    """All parts of a board that deviate; ``undecided`` and ``conforming`` name recordings."""

    board: Board
    runs: tuple[str, ...] = ()
    conforming: tuple[str, ...] = ()
    undecided: tuple[str, ...] = ()
    parts: list[DiagnosedPart] = field(default_factory=list)

    @property
    def causes(self) -> list[ExplainingCause]:
        """The nearest cause of each part that has one."""
        return [p.cause for p in self.parts if p.cause is not None]


def diagnose_board(
    board: Board,
    runs: Iterable[Recording],
    seconds: float = SECONDS,
    progress: Callable[[str], None] = lambda _: None,
    deciding: bool = True,
) -> BoardDiagnosis:
    """The causes of what recorded runs of a board do otherwise than its charts.

    ``seconds`` are those for each part; ``deciding``: whether runs are looked for that would tell causes
    apart.  Raises what reading the blocks of a run raises.
    """
    collector, names = EvidenceCollector(board), list[str]()
    for run in runs:
        progress(f"following {run.name}")
        collector.add(run)
        names.append(run.name)
    evidence = collector.evidence()
    found = BoardDiagnosis(board, tuple(names))
    deviating = {run.run.name for part in evidence.parts for run in part.deviating}
    found.undecided = tuple(n for n in names if evidence.behaviours[n].undecided)
    found.conforming = tuple(n for n in names if n not in deviating and n not in found.undecided)
    same: dict[str, list[PartDiagnosis]] = {}
    for part in evidence.parts:
        progress(f"looking for the cause in {part.name}")
        same.setdefault(part.name, []).append(diagnosed(part, seconds))
    for name, diagnoses in same.items():
        progress(f"telling causes apart in {name}")
        found.parts += [_told(name, group, deciding) for group in _together(diagnoses)]
    return found


def _together(diagnoses: Sequence[PartDiagnosis]) -> list[list[PartDiagnosis]]:
    """Recordings with other columns take a part apart in another way: those with a common cause together.

    The first of each group, which has most cases, keeps the causes that explain all of the group.
    """
    groups: list[list[PartDiagnosis]] = []
    for one in sorted(diagnoses, key=lambda d: -d.evidence.cases):
        for group in groups:
            common = [cause for cause in group[0].causes if _explains(cause, one)]
            if common or not (group[0].causes or one.causes):
                group[0].causes[:] = common
                group.append(one)
                break
        else:
            groups.append([one])
    return groups


def _explains(cause: ExplainingCause, other: PartDiagnosis) -> bool:
    """Whether a cause explains the recordings of another diagnosis of the part, too."""
    evidence, group = other.evidence, other.evidence.group
    taken = len(group.board.interface.taken)
    board = replace(group.board, system=group.system)
    try:
        for change in cause.changes:
            board = with_change(board, WrittenChange(*change.key))
        cone = group.cone(board.system)
        same = len(cone.outputs) == len(evidence.cone.outputs)
        return same and TrialBench(evidence, board.interface.taken[taken:]).rejected(cone) is None
    except (ModelError, StopIteration, TypeError, ValueError, ZeroDivisionError):
        return False  # it has no meaning there; bits of a fraction or of -1, a division by 0


def _told(name: str, group: Sequence[PartDiagnosis], deciding: bool) -> DiagnosedPart:
    first = group[0]
    runs = tuple(run.run.name for one in group for run in one.evidence.deviating)
    cause, others = (first.causes[0], first.causes[1:]) if first.causes else (None, [])
    rivals: list[RivalCause] = []
    prediction = None
    if cause is not None and deciding:
        for rival in others[:MOST_RIVALS]:
            rivals.append(RivalCause(rival, RunSearch(first.evidence, cause.cone, rival.cone).found()))
        seen = frozenset(_seen(group))
        prediction = RunSearch(first.evidence, first.evidence.cone, cause.cone, seen).found()
    return DiagnosedPart(
        name,
        sum(one.evidence.cases for one in group),
        runs,
        cause,
        next((one.partial for one in group if one.partial is not None), None) if cause is None else None,
        tuple(rivals),
        len(others) - len(rivals),
        prediction,
        sum(one.tried for one in group),
        sum(one.of for one in group),
        sum(one.seconds for one in group),
        tuple(one.evidence for one in group),
    )


def _seen(group: Sequence[PartDiagnosis]) -> Iterable[tuple[object, ...]]:
    """What was required and recorded in its place, of each output."""
    for one in group:
        for run in one.evidence.deviating:
            for _, mismatch in run.wrong[one.evidence.name]:
                for d in mismatch.differences:
                    for expected in d.expected:
                        yield d.output.name, expected, d.logged


__all__ = ["BoardDiagnosis", "DiagnosedPart", "RivalCause", "diagnose_board"]
