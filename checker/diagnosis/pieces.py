"""What differs, row by row, and to which deviation it belongs."""

from collections.abc import Iterable, Iterator, Mapping, Sequence

from rovercheck.checker.conformance.deviations import Deviation, DeviationScope, Grouping, whole_of
from rovercheck.checker.conformance.mismatch import LogMismatch
from rovercheck.checker.diagnosis.evidence import DecodedRun, PartEvidence

Wrong = Mapping[int, frozenset[tuple[str, int]]]
"""The rows of a run that are wrong: in which outputs, of masks in which bits."""

NOT_DECIDED = frozenset({("", 0)})
"""In place of what differs in a row of which it is not known."""

Pieces = dict[tuple[int, int], frozenset[tuple[str, int]]]


def rows_of(evidence: PartEvidence, deviations: Sequence[Deviation]) -> dict[int, Pieces]:
    """For each deviation, by its place, the rows of the runs in which it is, and what differs there.

    Numbers that follow from a discrete output are left out: they may differ for a reason of their own, too.
    """
    found: dict[int, Pieces] = {n: {} for n, one in enumerate(deviations)}
    places: dict[tuple[DeviationScope, tuple[str, ...]], int | None] = {}
    for run in evidence.deviating:
        rows = {tick: row for row, tick in enumerate(run.ticks)}
        for mismatch, scope in _told(run, evidence.name):
            key = scope, mismatch.outputs
            if key not in places:
                whole = whole_of(deviations, scope, mismatch.outputs)
                places[key] = next((n for n, one in enumerate(deviations) if one is whole), None)
            place = places[key]
            if place is not None:
                at = id(run), rows[mismatch.tick]
                own = {piece for piece in differing(mismatch) if piece[0] in scope.outputs}
                found[place][at] = found[place].get(at, frozenset()) | own
    return found


def _told(run: DecodedRun, part: str) -> Iterator[tuple[LogMismatch, DeviationScope]]:
    """The pieces of the mismatches of a part, with the scopes of their groups."""
    told: list[tuple[LogMismatch, DeviationScope]] = []
    grouping = Grouping(may_freeze=False)
    grouping.told = lambda mismatch, scope: told.append((mismatch, scope))
    wrong = dict(run.wrong[part])
    for row in sorted({*wrong, *(row + 1 for row in wrong)}):
        if row < len(run):
            grouping.tick(run.ticks[row], [wrong[row]] if row in wrong else [], True)
    grouping.end()
    yield from told


def wrong_of(wrong: Sequence[tuple[int, LogMismatch]]) -> Wrong:
    return {row: differing(mismatch) for row, mismatch in wrong}


def with_new(
    runs: Sequence[DecodedRun],
    before: Sequence[Wrong],
    now: Sequence[Wrong],
    rows: Mapping[int, Pieces],
    left: frozenset[int],
    deviations: Sequence[Deviation],
) -> tuple[dict[int, Pieces], frozenset[int]]:
    """The rows of deviations with what a change makes wrong, and to which of them that belongs.

    It belongs to one of the same outputs, one that is ``left`` if there is such.
    """
    found, more = {place: dict(own) for place, own in rows.items()}, set[int]()
    places = sorted(found, key=lambda n: n not in left)
    for run, old, new in zip(runs, before, now, strict=True):
        for row, pieces in new.items():
            for piece in pieces - old.get(row, frozenset()):
                own = (n for n in places if piece[0] in deviations[n].scope.outputs)
                if (place := next(own, None)) is not None:
                    at = id(run), row
                    found[place][at] = found[place].get(at, frozenset()) | {piece}
                    more.add(place)
    return found, frozenset(more)


def differing(mismatch: LogMismatch) -> frozenset[tuple[str, int]]:
    return frozenset((d.output.name, d.bit) for one in mismatch.differences for d in one.each_bit())


def nothing_new(before: Sequence[Wrong], now: Sequence[Wrong], ends: Iterable[int]) -> bool:
    """Whether of the rows of each run that are decided none is wrong that was right before."""
    runs = zip(before, now, ends, strict=True)
    return all(row in old or row >= end for old, new, end in runs for row in new)


def more_wrong(one: Sequence[Wrong], other: Sequence[Wrong]) -> int:
    """How much is wrong in one that is right in the other, in outputs of all rows."""
    pairs = zip(one, other, strict=True)
    return sum(len(own - there.get(row, frozenset())) for here, there in pairs for row, own in here.items())


__all__ = [
    "NOT_DECIDED", "Pieces", "Wrong", "differing", "more_wrong", "nothing_new", "rows_of", "with_new",
    "wrong_of",
]  # fmt: skip
