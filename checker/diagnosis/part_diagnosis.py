"""What one part of a board does otherwise, over all recordings, and what would tell its causes apart."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace

from rovercheck.checker.conformance.cones import LogCone
from rovercheck.checker.conformance.deviations import Deviation
from rovercheck.checker.diagnosis.cause_cover import covered
from rovercheck.checker.diagnosis.change import only_told
from rovercheck.checker.diagnosis.cover import PartCover
from rovercheck.checker.diagnosis.decide import DecidingRun, RunSearch
from rovercheck.checker.diagnosis.evidence import PartEvidence
from rovercheck.checker.diagnosis.search import ExplainingCause, SingleCauses, single_causes
from rovercheck.checker.diagnosis.trial import NO_VALUE, TrialBench
from rovercheck.checker.diagnosis.variant import with_changes
from rovercheck.spec_model.lang.errors import ModelError

MOST_RIVALS = 3
"""Other causes that explain as much, told beside the nearest."""

NO_MEANING = (ModelError, StopIteration, *NO_VALUE)
"""Of changes: they do not fit, or a step has no value with them."""


@dataclass(frozen=True)
class RivalCause:
    """Another cause that explains as much; ``run``: what would decide, ``None`` if no such run was found."""

    cause: ExplainingCause
    run: DecidingRun | None


@dataclass(frozen=True)
class DiagnosedPart:
    """What one part of a board does otherwise, over all recordings.

    ``cause``: the nearest change or changes that explain every case; ``None``: none was found.
    ``partial`` explains some of what differs, and contradicts nothing.  ``prediction``: a run in which the
    cause shows in a way that no recording does.  ``evidence``: of recordings with the same columns each.
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
    def told(self) -> ExplainingCause | None:
        """The cause, or what explains some cases."""
        return self.cause or self.partial

    @property
    def complete(self) -> bool:
        """Whether all changes were tried."""
        return self.tried == self.of


Elsewhere = tuple[DiagnosedPart, tuple[int, ...]]
"""A part as it comes from where it was searched, with the places of its evidence among all."""


@dataclass
class _Group:
    """Recordings of one part with a common cause, and what was found of those that have most cases."""

    found: SingleCauses
    partial: ExplainingCause | None
    evidence: list[PartEvidence] = field(default_factory=list)


def diagnosed(
    evidence: Sequence[PartEvidence], deviations: Sequence[Deviation], seconds: float, deciding: bool
) -> list[Elsewhere]:
    """The causes of what one part does otherwise than the charts.

    Recordings with other columns take a part apart in another way.  They are looked at from those with most
    cases on; what explains some explains others, too, or another cause is looked for in them.
    """
    groups: list[_Group] = []
    told = set[int]()
    for one in sorted(evidence, key=lambda e: -e.cases):
        for group in groups:
            common = [cause for cause in group.found.causes if _explains(cause, one)]
            if common:
                group.found.causes[:] = common
                group.evidence.append(one)
                break
        else:
            left = [d for n, d in enumerate(deviations) if n not in told]
            cover = covered(one, left, seconds)
            own = frozenset[int]().union(*(places for _, places in cover.changes))
            told |= {n for n, d in enumerate(deviations) if any(left[place] is d for place in own)}
            group = _group(cover, seconds)
            same = (g for g in groups if not (g.found.causes or group.found.causes or group.partial))
            first = next(same, group)
            if first is group:
                groups.append(group)
            else:
                first.found.tried += group.found.tried
                first.found.of += group.found.of
                first.found.seconds += group.found.seconds
            first.evidence.append(one)
    places = {id(e): n for n, e in enumerate(evidence)}
    return [(_told(one, deciding), tuple(places[id(e)] for e in one.evidence)) for one in groups]


def _group(cover: PartCover, seconds: float) -> _Group:
    """What was found in some recordings; where all is explained, also by single changes alone."""
    found = SingleCauses() if cover.left else single_causes(cover.evidence, seconds - cover.seconds)
    found.tried += cover.tried
    found.of += cover.of if cover.late else cover.tried
    found.seconds += cover.seconds
    partial = None
    if cover.changes and not found.causes:
        together = _explaining(cover)
        if together.trial.full:
            found.causes.append(together)
        elif not together.trial.wrong:
            partial = together
    return _Group(found, partial)


def _explaining(cover: PartCover) -> ExplainingCause:
    """All changes of a part, and what they explain together."""
    assert cover.system is not None and cover.bench is not None, "it has changes"
    cone = cover.evidence.group.cone(cover.system)
    return ExplainingCause(tuple(change for change, _ in cover.changes), cover.bench.trial(cone))


def changed_part(evidence: PartEvidence, cause: ExplainingCause) -> tuple[LogCone, TrialBench]:
    """A part with the changes of a cause, and its recordings as it takes them then.

    Raises ``NO_MEANING``.
    """
    drawn = replace(evidence.group.board, system=evidence.group.system)
    board = with_changes(drawn, (change.key for change in cause.changes))
    taken = len(evidence.group.board.interface.taken)
    return evidence.group.cone(board.system), TrialBench(evidence, board.interface.taken[taken:])


def _explains(cause: ExplainingCause, other: PartEvidence) -> bool:
    """Whether a cause explains other recordings of the part, too."""
    try:
        cone, bench = changed_part(other, cause)
        return len(cone.outputs) == len(other.cone.outputs) and bench.rejected(cone) is None
    except NO_MEANING:
        return False


def _told(group: _Group, deciding: bool) -> DiagnosedPart:
    found, first = group.found, group.evidence[0]
    runs = tuple(run.run.name for one in group.evidence for run in one.deviating)
    cause, others = (found.causes[0], found.causes[1:]) if found.causes else (None, [])
    rivals: list[RivalCause] = []
    prediction = None
    if cause is not None and deciding and (cone := _cone(first, cause)) is not None:
        for rival in others[:MOST_RIVALS]:
            other = _cone(first, rival)
            run = None if other is None else RunSearch(first, cone, other).found()
            rivals.append(RivalCause(_only_told(rival), run))
        seen = frozenset(_seen(group.evidence))
        prediction = RunSearch(first, first.cone, cone, seen).found()
    return DiagnosedPart(
        first.name,
        sum(one.cases for one in group.evidence),
        runs,
        None if cause is None else _only_told(cause),
        None if group.partial is None else _only_told(group.partial),
        tuple(rivals),
        len(others) - len(rivals),
        prediction,
        found.tried,
        found.of,
        found.seconds,
        (),
    )


def _cone(evidence: PartEvidence, cause: ExplainingCause) -> LogCone | None:
    """The changed part, where its changes can be made anew one after the other."""
    try:
        return changed_part(evidence, cause)[0]
    except NO_MEANING:
        return None


def _only_told(cause: ExplainingCause) -> ExplainingCause:
    return replace(cause, changes=tuple(replace(change, make=only_told) for change in cause.changes))


def _seen(evidence: Iterable[PartEvidence]) -> Iterable[tuple[object, ...]]:
    """What was required and recorded in its place, of each output."""
    for one in evidence:
        for run in one.deviating:
            for _, mismatch in run.wrong[one.name]:
                for d in mismatch.differences:
                    for expected in d.expected:
                        yield d.output.name, expected, d.logged


__all__ = ["DiagnosedPart", "RivalCause", "changed_part", "diagnosed"]
