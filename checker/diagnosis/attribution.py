"""Which of several changes is the cause of which deviation: that without which most of its rows are wrong."""

from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace

from rovercheck.checker.diagnosis.change import ChartChange
from rovercheck.checker.diagnosis.cover import PartCover
from rovercheck.checker.diagnosis.pieces import differing
from rovercheck.checker.diagnosis.trial import TrialBench
from rovercheck.checker.diagnosis.variant import WrittenChange, with_change
from rovercheck.spec_model.lang.errors import ModelError


@dataclass(frozen=True)
class AttributedChange:
    """A change with the places of the deviations of which it is the cause.

    ``beside``: of each of these another change is the cause, too, and more than this one.
    """

    change: ChartChange
    places: frozenset[int]
    beside: bool = False


def attributed(cover: PartCover) -> list[AttributedChange]:
    """The changes of a part with the deviations of which they are the cause.

    One that is needed for rows of several, and most for none, has that for which it is needed most.  One
    that is needed for none is left out.
    """
    if all(explained for _, explained in cover.changes):
        return [AttributedChange(change, explained) for change, explained in cover.changes]
    changes = [change for change, _ in cover.changes]
    explained = frozenset[int]().union(*(places for _, places in cover.changes))
    needed = [_needed(cover, number, changes, explained) for number in range(len(changes))]
    most = {n: max(range(len(changes)), key=lambda c: _weight(needed[c], n)) for n in explained}
    found: list[AttributedChange] = []
    for number, change in enumerate(changes):
        places = frozenset(n for n in explained if most[n] == number)
        if places:
            found.append(AttributedChange(change, places))
        elif own := needed[number]:
            found.append(AttributedChange(change, frozenset({max(own, key=lambda n: own[n])}), True))
    return found


def _weight(needed: Mapping[int, int], place: int) -> tuple[int, int]:
    """For how many rows of a deviation a change is needed, then for how many of all."""
    return needed.get(place, 0), sum(needed.values())


def _needed(
    cover: PartCover, number: int, changes: Sequence[ChartChange], explained: frozenset[int]
) -> dict[int, int]:
    """How many rows of each deviation are wrong without one of the changes, where some are."""
    part = cover.evidence
    taken = len(part.group.board.interface.taken)
    board = replace(part.group.board, system=part.group.system)
    for place, change in enumerate(changes):
        if place != number:
            with suppress(ModelError):  # it changes something that only this one has made
                board = with_change(board, WrittenChange(*change.key))
    try:
        cone = part.group.cone(board.system)
    except (ModelError, StopIteration):
        return dict.fromkeys(cover.changes[number][1], 1)
    bench = TrialBench(part, board.interface.taken[taken:], cover.bench.ends if cover.bench else {})
    found: dict[int, int] = {}
    for at, run in enumerate(bench.runs):
        if not run.wrong.get(part.name):
            continue
        for row, mismatch in bench.mismatches(cone, at):
            for place in explained:
                own = cover.rows[place].get((id(run), row), frozenset())
                if own and (mismatch is None or own & differing(mismatch)):
                    found[place] = found.get(place, 0) + 1
    return found


__all__ = ["AttributedChange", "attributed"]
