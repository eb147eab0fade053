"""Deviations merged by cause: those that one change of the charts explains, or that evidence joins."""

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from hashlib import sha256

from rovercheck.checker.conformance.deviations import Deviation, DeviationScope, scope_of
from rovercheck.checker.conformance.mismatch import LogMismatch
from rovercheck.checker.diagnosis.change import ChartChange
from rovercheck.checker.diagnosis.evidence import PartEvidence
from rovercheck.checker.diagnosis.result import DiagnosedPart
from rovercheck.checker.diagnosis.search import ExplainingCause
from rovercheck.checker.diagnosis.trial import TrialBench
from rovercheck.spec_model.lang.errors import ModelError

Explained = Mapping[DeviationScope, Counter[int | None]]
"""By the scope of a mismatch, in how many rows each change of a cause explains it; ``None``: none does."""


@dataclass(frozen=True)
class DeviationCause:
    """Deviations of one cause, each in no other one.

    ``change`` explains them; ``None``: nothing does, and what they have in common are the outputs, and the
    moves of the charts.  ``alone``: whether the changes found in the part explain
    everything that it does otherwise.
    """

    part: str
    change: ChartChange | None
    deviations: tuple[Deviation, ...]
    alone: bool = False

    def id(self, board: str) -> str:
        """A short name: that of the change, or of the first deviation."""
        if self.change is None:
            return self.deviations[0].scope.id(board)
        digest = sha256(repr((board, *self.change.key)).encode()).hexdigest()[:6]
        return f"{board}-{self.change.chart}-{digest}"


def by_cause(deviations: Sequence[Deviation], parts: Iterable[DiagnosedPart]) -> tuple[DeviationCause, ...]:
    """Every deviation under its cause, in the order of the first ones."""
    found: dict[tuple[str, ...], list[Deviation]] = {}
    changes: dict[tuple[str, ...], tuple[ChartChange, bool]] = {}
    left = list(deviations)
    for part in parts:
        cause = part.cause or part.partial
        if cause is None:
            continue
        explained = _explained(part, cause)
        for one in [d for d in left if d.scope.part == part.name]:
            number = _most(one, explained)
            if number is not None:
                change = cause.changes[number]
                changes[change.key] = change, part.cause is not None
                found.setdefault(change.key, []).append(one)
                left.remove(one)
    causes = [
        DeviationCause(group[0].scope.part, changes[key][0], tuple(group), changes[key][1])
        for key, group in found.items()
    ]
    causes += [DeviationCause(group[0].scope.part, None, tuple(group)) for group in alike(left)]
    places = {one.scope: place for place, one in enumerate(deviations)}
    return tuple(sorted(causes, key=lambda c: places[c.deviations[0].scope]))


def _explained(part: DiagnosedPart, cause: ExplainingCause) -> Explained:
    """Which change explains each row: the first after which it is right."""
    found: dict[DeviationScope, Counter[int | None]] = {}
    for evidence in part.evidence:
        for mismatch, number in _numbers(evidence, cause):
            for piece in mismatch.pieces():
                found.setdefault(scope_of(piece), Counter())[number] += 1
    return found


def _numbers(evidence: PartEvidence, cause: ExplainingCause) -> Iterator[tuple[LogMismatch, int | None]]:
    """Each mismatch, and the change that explains it."""
    bench = TrialBench(evidence)
    try:
        cones = [evidence.group.cone(change.make()) for change in cause.changes]
    except (ModelError, StopIteration):  # other recordings, which take the part apart in another way
        return
    for run in evidence.deviating:
        left = dict(run.wrong[evidence.name])
        for number, cone in enumerate(cones):
            wrong = set(bench.wrong_rows(cone, run))
            yield from ((left.pop(row), number) for row in left.keys() - wrong)
        yield from ((mismatch, None) for mismatch in left.values())


def _most(one: Deviation, explained: Explained) -> int | None:
    """The change that explains most of a deviation's rows.

    One that was made of others, such as what is always late, has the rows of its outputs.
    """
    rows = explained.get(one.scope)
    if rows is None:
        outputs = set(one.scope.outputs)
        rows = sum((n for s, n in explained.items() if set(s.outputs) <= outputs), Counter[int | None]())
    return rows.most_common(1)[0][0] if rows else None


def alike(deviations: Sequence[Deviation]) -> list[list[Deviation]]:
    """Groups of deviations in which the same outputs differ after the same moves of the charts of a part.

    What no chart decides stays by itself.
    """
    groups: dict[tuple[object, ...], list[Deviation]] = {}
    for one in deviations:
        scope = one.scope
        key = (scope.part, scope.kind, scope.outputs, scope.charts or scope.differences)
        groups.setdefault(key, []).append(one)
    return list(groups.values())


__all__ = ["DeviationCause", "alike", "by_cause"]
