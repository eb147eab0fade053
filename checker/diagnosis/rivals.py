"""Other changes that explain exactly as much as the nearest one: nothing recorded tells them apart."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from itertools import takewhile

from rovercheck.checker.diagnosis.change import ChartChange
from rovercheck.checker.diagnosis.cover import CoveringChange
from rovercheck.spec_model.abstraction.readings import StampReading

MOST_RIVALS = 2
"""Changes that are told beside the nearest one."""


def rivals(good: Sequence[CoveringChange]) -> tuple[ChartChange, ...]:
    """What explains exactly as much as the first of changes that are ranked, each in another place.

    Another value of one limit is none: the change says between which values it lies.
    """
    first, *others = good
    found = {_place(first.change): first.change}
    for one in others:
        if one.explains == first.explains and (one.behind, one.cases) == (first.behind, first.cases):
            found.setdefault(_place(one.change), one.change)
    return tuple(found.values())[1 : MOST_RIVALS + 1]


def read_earlier(
    taken: list[tuple[ChartChange, frozenset[int]]], added: Callable[[ChartChange], bool]
) -> None:
    """A stamp that is new in every step from an update on, from an earlier one on, where that explains more.

    ``taken`` are the changes found so far; ``added`` takes a change on top of them if it explains something.
    """
    for place, (change, own) in enumerate(taken):
        for one in change.reading.earlier if change.reading is not None else ():
            if added(replace(change, new=one.how, text=one.text, note="", reading=one)):
                del taken[place]
                taken[-1] = (taken[-1][0], taken[-1][1] | own)
                return


def with_earlier(one: CoveringChange, explained: Callable[[StampReading], frozenset[int]]) -> CoveringChange:
    """Of a stamp that is new in every step from an update on: with the earlier ones that explain the same."""
    earlier = one.change.reading.earlier if one.explains and one.change.reading is not None else ()
    same = list(takewhile(lambda reading: explained(reading) == one.explains, earlier))
    if not same:
        return one
    others = " and ".join(filter(None, (", ".join(r.since for r in same[:-1]), same[-1].since)))
    note = f"{others} explain{'s' if len(same) == 1 else ''} the same"
    return replace(one, change=replace(one.change, note=note))


def _place(change: ChartChange) -> tuple[str, ...]:
    """A place, and what is read otherwise in it."""
    at = change.at.removesuffix("/compared")  # of ages, also where they are compared alone
    return (change.chart, at, change.new if change.kind == "interpretation" else change.old)


__all__ = ["read_earlier", "rivals", "with_earlier"]
