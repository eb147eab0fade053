"""What other recordings show: a change that explains much there, and as much here as what was found here.

Recordings in which columns are lost say little of a part, and many changes explain that little: another bit
in one place where two are exchanged.  Where a part is followed together with those before it, one of many
changes of all of these is told, though one is known from recordings that show it alone.
"""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial

from rovercheck.checker.conformance.deviations import Deviation
from rovercheck.checker.diagnosis.change import ChartChange
from rovercheck.checker.diagnosis.evidence import PartEvidence
from rovercheck.checker.diagnosis.hypotheses import stamp_changes
from rovercheck.checker.diagnosis.part_causes import SearchedPart, searched_part
from rovercheck.checker.process.beside import beside
from rovercheck.spec_model.abstraction import Board
from rovercheck.spec_model.lang.chart import parts as all_parts

KNOWN = -1.0
"""How near a change lies that others show: before all others."""

FollowedPart = tuple[PartEvidence, SearchedPart]
"""What recordings of the same columns say of a part, and what was found in it."""


def explained_elsewhere(
    board: Board, every: Sequence[FollowedPart], deviations: Sequence[Deviation], seconds: float, at_once: int
) -> list[SearchedPart]:
    """The parts, each with changes of others: of those that deviate more often, where these explain as much.

    Of those that deviate less often where something is left, and more is explained with them.
    """
    found = [part for _, part in every]
    offered = {n: own for n in range(len(every)) if (own := _offered(board, every, n, deviations))}
    works = [
        partial(
            searched_part,
            every[n][0],
            deviations,
            _places(found, n, deviations),
            seconds,
            own.with_own(found[n].changes),
        )
        for n, own in offered.items()
    ]
    places = list(offered)
    for number, made in beside(works, at_once):
        place = places[number]
        if _better(made, found[place], offered[place]):
            found[place] = replace(made, cut=found[place].cut)
    return found


@dataclass(frozen=True)
class OfferedChanges:
    """Changes of parts that deviate more often, and of those that deviate less often."""

    often: tuple[ChartChange, ...]
    seldom: tuple[ChartChange, ...]

    def with_own(self, changes: Iterable[ChartChange]) -> list[ChartChange]:
        """All to be tried of a part in which these were found, each once."""
        found: dict[tuple[str, ...], ChartChange] = {}
        for change in (*self.often, *changes, *self.seldom):
            found.setdefault(change.key, change)
        return list(found.values())


def _offered(
    board: Board, every: Sequence[FollowedPart], place: int, deviations: Sequence[Deviation]
) -> OfferedChanges | None:
    """Changes of other parts, where another one was found here, or something is left.

    Those of parts that deviate more often come before those that were met here alone.
    """
    evidence, part = every[place]
    others = sorted((one for _, one in every if one is not part), key=lambda one: -one.cases)

    def of(some: Iterable[SearchedPart]) -> dict[tuple[str, ...], ChartChange]:
        return {c.key: c for c in _of_charts(board, evidence, (c for one in some for c in one.changes))}

    often = of(one for one in others if one.cases > part.cases)
    mine = {change.key for change in part.changes}
    left = len(_places([one for _, one in every], place, deviations)) > len(part.explained)
    seldom = of(one for one in others if one.cases <= part.cases) if left else {}
    others_known = often.keys() | seldom.keys()
    if not others_known or (mine <= often.keys() and not (left and not others_known <= mine)):
        return None
    return OfferedChanges(
        tuple(replace(change, tier=KNOWN) for change in often.values()), tuple(seldom.values())
    )


def _of_charts(board: Board, evidence: PartEvidence, found: Iterable[ChartChange]) -> Iterator[ChartChange]:
    """Those of charts of a part, and the stamps that it reads, too."""
    system = evidence.group.system
    charts = frozenset(one.name for one in all_parts(system.components))
    stamps = list(stamp_changes(board, system, charts))
    for change in found:
        if change.reading is not None and change.at.startswith("stamp/"):
            yield from (one for one in stamps if (one.at, one.new) == (change.at, change.new))
        elif change.chart in charts:
            yield change


def _places(every: Sequence[SearchedPart], place: int, deviations: Sequence[Deviation]) -> list[int]:
    """What a part is asked about: all deviations of it that recordings of other columns do not explain."""
    part = every[place]
    told = {n for n, one in enumerate(every) if n != place and one.part == part.part}
    explained = {at for n in told for at in every[n].explained}
    return [n for n, d in enumerate(deviations) if d.scope.part == part.part and n not in explained]


def _better(made: SearchedPart, before: SearchedPart, offered: OfferedChanges) -> bool:
    """Whether more is explained, or as much with fewer changes that are met here alone."""
    if not set(made.explained) >= set(before.explained):
        return False
    often = {change.key for change in offered.often}
    alone, was = (sum(c.key not in often for c in part.changes) for part in (made, before))
    return len(made.explained) > len(before.explained) or alone < was


__all__ = ["FollowedPart", "explained_elsewhere"]
