"""Maximal repetitions of a sequence: stretches with a period, which cannot be made longer at either end."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

BETWEEN = -1
"""No item of a sequence: it parts two sequences of which one is looked for in the other."""


@dataclass(frozen=True, order=True)
class Repetition:
    """Items ``start`` to ``end`` (exclusive), at least two periods: each is as the one ``period`` after it.

    ``period`` is the smallest there is.  The items just before and just after are not in it.
    """

    start: int
    end: int
    period: int


def repetitions(items: Sequence[int]) -> tuple[Repetition, ...]:
    """All maximal repetitions ("runs") of a sequence of numbers from 0 on, in order of their start.

    By Main and Lorentz, "An O(n log n) algorithm for finding all repetitions in a string" (Journal of
    Algorithms 5, 1984): those that cross the middle are found in linear time, then those in each half.  There
    are fewer than items (Bannai et al., "The runs theorem", SIAM Journal on Computing 46, 2017).
    """
    found: dict[tuple[int, int], int] = {}
    halves = [(0, len(items))]
    while halves:
        low, high = halves.pop()
        if high - low < 2:
            continue
        middle = (low + high) // 2
        halves += [(low, middle), (middle, high)]
        for start, end, period in _crossing(items, low, middle, high):
            if _maximal(items, start, end, period):
                found[start, end] = min(period, found.get((start, end), period))
    return tuple(sorted(Repetition(start, end, period) for (start, end), period in found.items()))


def _maximal(items: Sequence[int], start: int, end: int, period: int) -> bool:
    """Whether neither end can be moved outwards, as it can where a half ends within a repetition."""
    before = start > 0 and items[start - 1] == items[start - 1 + period]
    return not before and not (end < len(items) and items[end] == items[end - period])


def _crossing(items: Sequence[int], low: int, middle: int, high: int) -> Iterator[tuple[int, int, int]]:
    """Repetitions between ``low`` and ``high`` that have an item on both sides of the middle."""
    left, right = list(items[low:middle]), list(items[middle:high])
    back = left[::-1]
    own, across = _prefixes(back), _prefixes([*right, BETWEEN, *left, *right])
    for period in range(1, len(left) + 1):
        before = own[period] if period < len(left) else 0
        after = across[len(right) + 1 + len(left) - period]
        if before + after >= period:
            yield middle - period - before, middle + after, period
    own, across = _prefixes(right), _prefixes([*back, BETWEEN, *right[::-1], *back])
    for period in range(1, len(right) + 1):
        after = own[period] if period < len(right) else 0
        before = across[len(left) + 1 + len(right) - period]
        if before + after >= period:
            yield middle - before, middle + period + after, period


def _prefixes(items: Sequence[int]) -> list[int]:
    """The Z-function: for each position, how many items from there on are as at the start."""
    count = len(items)
    found = [0] * count
    if items:
        found[0] = count
    left = right = 0
    for i in range(1, count):
        length = min(right - i, found[i - left]) if i < right else 0
        while i + length < count and items[length] == items[i + length]:
            length += 1
        if i + length > right:
            left, right = i, i + length
        found[i] = length
    return found
