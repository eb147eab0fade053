"""Other numbers for a limit that was found: on the same side of all that was met, until more is met."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from fractions import Fraction
from itertools import islice
from math import ceil, floor, log10

from rovercheck.checker.diagnosis.change import ChartChange, only_told
from rovercheck.checker.diagnosis.evidence import DecodedRun, PartEvidence
from rovercheck.checker.diagnosis.limits import number_slots
from rovercheck.checker.diagnosis.met_values import MetValues
from rovercheck.checker.diagnosis.variant import with_changes
from rovercheck.spec_model.abstraction import Board
from rovercheck.spec_model.lang.domain import show
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.operators import Op

FEWEST = 8
"""Numbers between two that were met, of the fewest digits with which there are so many."""
MOST = 40


def other_limits(board: Board, changes: Iterable[ChartChange]) -> Iterator[Board]:
    """The board with other numbers for all limits that were found, each with some of them.

    What a limit is told as is the number of the fewest digits that explains what was met; the firmware may
    have any other one that does.
    """
    every = [list(_alternatives(change)) for change in changes if change.span is not None]
    for number in range(max(map(len, every), default=0)):
        made = board
        for keys in every:
            if number < len(keys):
                try:
                    made = with_changes(made, [keys[number]])
                except ModelError:  # what the chart has, or a place that another change has taken
                    continue
        if made is not board:
            yield made


def _alternatives(change: ChartChange) -> Iterator[Sequence[str]]:
    assert change.span is not None
    head = change.new.rpartition(" ")[0]
    for value in between(*change.span):
        new = f"{head} {show(value)}"
        if new != change.new:
            yield (change.kind, change.chart, change.at, change.old, new)


def between(low: Fraction, high: Fraction) -> list[Fraction]:
    """Some numbers from ``low`` to ``high``, of as few digits as there are some of."""
    if low >= high:
        return []
    exponent = ceil(log10(high - low))
    while True:
        for unit in (Fraction(10) ** exponent, Fraction(5) * Fraction(10) ** (exponent - 1)):
            first, last = ceil(low / unit), floor(high / unit)
            if last - first + 1 >= FEWEST:
                return [k * unit for k in islice(range(first, last + 1), MOST)]
        exponent -= 1


def narrowed(change: ChartChange, part: PartEvidence, runs: list[DecodedRun]) -> ChartChange:
    """The change with the numbers that are left when these runs, which it explains, have met some of them."""
    if change.span is None:
        return change
    head, _, text = change.new.rpartition(" ")
    op = Op(head.rpartition(" ")[2])
    for slot in number_slots(part.group.system, frozenset({change.chart})):
        raw, size = Fraction(text) / slot.sort.resolution, slot.sort.resolution
        if slot.left is None or slot.at != change.at or slot.change(op, raw).key != change.key:
            continue
        met = MetValues(replace(part, runs=runs)).of_all((slot.left, *slot.beside))[0]
        low, high = change.span[0] / size, change.span[1] / size
        upper = op in (Op.LT, Op.GE)  # whether the number itself is on the upper side
        inside = [v for v in met if low <= v <= high]
        below = [v for v in inside if v < raw or (v == raw and not upper)]
        above = [v for v in inside if v > raw or (v == raw and upper)]
        left = max(below, default=low), min(above, default=high)
        return replace(slot.change(op, raw, left), make=only_told)
    return change  # of charts that another change has made otherwise


__all__ = ["between", "narrowed", "other_limits"]
