"""Whether the changes that explained known deviations still do: a fault on top may look like one of them."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace

from rovercheck.checker.conformance.deviations import Deviation
from rovercheck.checker.conformance.known import KnownCause, KnownDeviation
from rovercheck.checker.diagnosis.evidence import DecodedRun, Evidence, PartEvidence
from rovercheck.checker.diagnosis.part_causes import PartChanges
from rovercheck.checker.diagnosis.pieces import differing, rows_of
from rovercheck.checker.diagnosis.trial import TrialBench
from rovercheck.checker.diagnosis.variant import with_changes
from rovercheck.spec_model.abstraction import Board
from rovercheck.spec_model.lang.errors import ModelError


def no_longer_explained(
    evidence: Evidence,
    found: Sequence[Deviation],
    known: Sequence[KnownDeviation],
    causes: Iterable[KnownCause],
) -> list[Deviation]:
    """Of the deviations that were found those that are known, and that their cause does not explain.

    In each run the steps up to the first deviation that is not known are looked at: what comes later may
    follow from it.  Raises ``ModelError`` for a cause that does not fit the charts.
    """
    left: list[Deviation] = []
    known = [one for one in known if one.board == evidence.board.name]
    for cause in causes:
        records = [one for one in known if one.id in cause.deviations]
        own = [one for one in found if any(record.covers(one) for record in records)]
        new = [
            one
            for one in found
            if one.scope.part == cause.part and not any(record.covers(one) for record in known)
        ]
        if own:
            for part in evidence.parts:
                if part.name == cause.part:
                    left += _left(evidence.board, part, [*own, *new], len(own), cause)
    return list({id(one): one for one in left}.values())


def that_hold(evidence: Evidence, found: PartChanges) -> PartChanges:
    """The changes of a part with those deviations only that they explain when they are made anew.

    As they are read from a file, one on top of the other: a known deviation must not change by itself.
    """
    own = list(found.deviations)
    cause = KnownCause(evidence.board.name, found.part, tuple(change.key for change in found.changes), ())
    left: list[Deviation] = []
    for part in evidence.parts:
        if part.name == found.part and own:
            try:
                left += _left(evidence.board, part, own, len(own), cause)
            except ModelError:
                left += own
    ids = {id(one) for one in left}
    return replace(found, deviations=tuple(one for one in own if id(one) not in ids))


def _left(
    board: Board, part: PartEvidence, deviations: Sequence[Deviation], own: int, cause: KnownCause
) -> Iterator[Deviation]:
    """Of the first ``own`` deviations of a part those of which some step is wrong with the changes.

    All of them, where a step is wrong that is right without the changes.
    """
    variant = changed(replace(board, system=part.group.system), cause)
    cone = part.group.cone(variant.system)
    rows = rows_of(part, deviations)
    bench = TrialBench(part, variant.interface.taken[len(board.interface.taken) :])
    for number, run in enumerate(bench.runs):
        end = min((row for n in range(own, len(deviations)) for row in _of(run, rows[n])), default=len(run))
        base = {row for row, _ in run.wrong.get(part.name, ())}
        for row, mismatch in bench.mismatches(cone, number):
            if row >= end or mismatch is None:
                break
            if row not in base:
                yield from deviations[:own]
                return
            wrong = differing(mismatch)
            yield from (
                one
                for n, one in enumerate(deviations[:own])
                if wrong & rows[n].get((id(run), row), frozenset())
            )


def _of(run: DecodedRun, rows: Iterable[tuple[int, int]]) -> Iterator[int]:
    return (row for number, row in rows if number == id(run))


def changed(board: Board, cause: KnownCause) -> Board:
    """A board, or some of its charts, with the changes of a cause.  Raises ``ModelError``."""
    return with_changes(board, cause.changes)


def causes_to_keep(
    board: str,
    parts: Iterable[PartChanges],
    records: Sequence[KnownDeviation],
    before: Iterable[KnownCause],
) -> Iterator[KnownCause]:
    """What is written of the causes of records: those found now, and those of parts not searched now."""
    searched = set[str]()
    for part in parts:
        searched.add(part.part)
        ids = sorted(record.id for record in records if any(map(record.covers, part.deviations)))
        if part.changes and ids:
            yield KnownCause(board, part.part, tuple(change.key for change in part.changes), tuple(ids))
    for cause in before:
        ids = sorted(record.id for record in records if record.id in cause.deviations)
        if cause.board == board and cause.part not in searched and ids:
            yield KnownCause(board, cause.part, cause.changes, tuple(ids))


__all__ = ["causes_to_keep", "changed", "no_longer_explained", "that_hold"]
