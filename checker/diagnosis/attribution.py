"""Which of several changes is the cause of which deviation: that without which most of its rows are wrong."""

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import replace

from rovercheck.checker.diagnosis.change import ChartChange
from rovercheck.checker.diagnosis.cover import PartCover
from rovercheck.checker.diagnosis.pieces import differing
from rovercheck.checker.diagnosis.trial import TrialBench
from rovercheck.checker.diagnosis.variant import WrittenChange, with_change
from rovercheck.spec_model.lang.errors import ModelError


def attributed(cover: PartCover) -> list[tuple[ChartChange, frozenset[int]]]:
    """The changes of a part, each with the places of the deviations of which it is the cause.

    One that is needed for rows of several, and most for none, has that for which it is needed most.  One
    that is needed for none is left out.
    """
    changes = [change for change, _ in cover.changes]
    if all(explained for _, explained in cover.changes):
        return cover.changes
    explained = frozenset[int]().union(*(places for _, places in cover.changes))
    needed = [_needed(cover, number, changes, explained) for number in range(len(changes))]
    found: list[tuple[ChartChange, frozenset[int]]] = []
    for number, change in enumerate(changes):
        own = needed[number]
        places = {n for n, rows in own.items() if rows == max(other.get(n, 0) for other in needed)}
        if not places and own:
            places = {max(own, key=lambda n: own[n])}
        if places:
            found.append((change, frozenset(places)))
    return found


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
    bench = TrialBench(part, board.interface.taken[taken:])
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


__all__ = ["attributed"]
