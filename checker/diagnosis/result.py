"""Causes of a board's deviations over all of its recordings, each once, with what would tell two apart."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field, replace
from functools import partial

from rovercheck.checker.conformance.deviations import Deviation, DeviationTally, WholeEvidence
from rovercheck.checker.conformance.recording import Recording
from rovercheck.checker.diagnosis.evidence import Evidence, EvidenceCollector, PartEvidence
from rovercheck.checker.diagnosis.part_diagnosis import DiagnosedPart, Elsewhere, RivalCause, diagnosed
from rovercheck.checker.diagnosis.search import SECONDS, ExplainingCause
from rovercheck.checker.process.beside import beside
from rovercheck.checker.process.pool import cores
from rovercheck.spec_model.abstraction import Board


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
        """The nearest cause of each part that has one, or what explains some of its cases."""
        return [told for p in self.parts if (told := p.told) is not None]


def diagnose_board(
    board: Board,
    runs: Iterable[Recording],
    seconds: float = SECONDS,
    progress: Callable[[str], None] = lambda _: None,
    deciding: bool = True,
) -> BoardDiagnosis:
    """The causes of what recorded runs of a board do otherwise than its charts.

    ``seconds`` are those for each part, of which several are searched at a time; ``deciding``: whether runs
    are looked for that would tell causes apart.  Raises what reading the blocks of a run raises.
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
    deviations = _deviations(evidence)
    same: dict[str, list[PartEvidence]] = {}
    for part in evidence.parts:
        same.setdefault(part.name, []).append(part)
    works = [
        partial(diagnosed, some, [d for d in deviations if d.scope.part == name], seconds, deciding)
        for name, some in same.items()
    ]
    said = f"looking for causes in {len(works)} parts"
    progress(said)
    done: dict[int, list[Elsewhere]] = {}
    for number, parts in beside(works, cores()):
        done[number] = parts
        progress(f"{said}, {len(done)} of them searched")
    for number, some in enumerate(same.values()):
        for told, places in done[number]:
            found.parts.append(replace(told, evidence=tuple(some[n] for n in places)))
    return found


def _deviations(evidence: Evidence) -> Sequence[Deviation]:
    tally = DeviationTally()
    for name, behaviour in evidence.behaviours.items():
        found = behaviour.tally
        tally.add(found.groups.values(), found.evidence or WholeEvidence(), name)
    return tally.deviations()


__all__ = ["BoardDiagnosis", "DiagnosedPart", "RivalCause", "diagnose_board"]
