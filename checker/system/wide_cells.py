"""Cells of a variable with so many values that they are not listed: a clock in 32 bits.

Where it is only compared with constants, the cells are what lies between these limits.
"""

from bisect import bisect_right
from collections.abc import Iterator, Mapping, Sequence
from typing import overload

from rovercheck.spec_model.lang.domain import Bool
from rovercheck.spec_model.lang.evaluate import evaluate
from rovercheck.spec_model.lang.expr import Apply, Const, Expr, Named, Var
from rovercheck.spec_model.lang.operators import COMPARISONS, Op

MOST_LISTED = 1 << 20
"""Values of a variable that are listed; of one with more, only the limits are looked for."""
_RISING = frozenset({Op.SCALE, Op.ADD, Op.SUB, Op.MUL, Op.DIV, Op.MIN, Op.MAX, Op.NEG})
"""Operators that keep the order of their one variable argument, or turn it round."""
_JOINING = frozenset({Op.AND, Op.OR, Op.NOT, Op.ITE, Op.EQ, Op.NE})


class TooManyValues(MemoryError):
    """Each of the values of a variable matters, and there are too many to tell them apart one by one."""


class Stretches(Sequence[int]):
    """The number of the cell of each value of a row: the same from each start up to the next."""

    def __init__(self, length: int, starts: Sequence[int], numbers: Sequence[int]) -> None:
        self._length, self._starts, self._numbers = length, starts, numbers

    def __len__(self) -> int:
        return self._length

    @overload
    def __getitem__(self, at: int) -> int: ...

    @overload
    def __getitem__(self, at: slice) -> Sequence[int]: ...

    def __getitem__(self, at: int | slice) -> int | Sequence[int]:
        if isinstance(at, slice):
            return [self[one] for one in range(*at.indices(self._length))]
        if not -self._length <= at < self._length:
            raise IndexError(at)
        return self._numbers[bisect_right(self._starts, at % self._length) - 1]


class CellNumbers(Mapping[int, int]):
    """The number of the cell of each value of a range."""

    def __init__(self, values: range, numbers: Sequence[int]) -> None:
        self._values, self._numbers = values, numbers

    def __getitem__(self, value: int) -> int:
        if value not in self._values:
            raise KeyError(value)
        return self._numbers[value - self._values.start]

    def __iter__(self) -> Iterator[int]:
        return iter(self._values)

    def __len__(self) -> int:
        return len(self._values)


def split_wide(
    var: Var, alone: Sequence[Expr], required: Sequence[Expr]
) -> tuple[list[tuple[int, int]], Sequence[int], Sequence[int]]:
    """The cells of a variable that is only compared with constants, as ``cells.split`` gives them.

    Raises ``TooManyValues`` where it is used otherwise.
    """
    low, high = var.domain.low, var.domain.high
    starts = {low}
    for expr in (*alone, *required):
        starts |= set(_changes(expr, var))
    limits = sorted(one for one in starts if low <= one <= high)
    allowed = [all(evaluate(c, {var.name: one}) for c in required) for one in limits]
    if not any(allowed):
        return [], range(low, low), ()
    if not all(allowed):  # the values that are left must be one row
        first, last = allowed.index(True), len(allowed) - allowed[::-1].index(True)
        if not all(allowed[first:last]):
            raise TooManyValues(f"{len(var.domain):,} values of {var.name}, some of which are not allowed")
        high = limits[last] - 1 if last < len(limits) else high
        limits = limits[first:last]
    numbers, cells, known = list[int](), list[list[int]](), dict[tuple[int, ...], int]()
    for one, following in zip(limits, [*limits[1:], high + 1], strict=True):
        told = tuple(evaluate(expr, {var.name: one}) for expr in alone)
        if told not in known:
            known[told] = len(cells)
            cells.append([one, 0])
        numbers.append(known[told])
        cells[known[told]][1] += following - one
    values = range(limits[0], high + 1)
    starts_ = [one - values.start for one in limits]
    return [(one, size) for one, size in cells], values, Stretches(len(values), starts_, numbers)


def _changes(expr: Expr, var: Var) -> Iterator[int]:
    """The values at which a condition about one variable may begin to have another truth."""
    match expr:
        case Named(_, body):
            yield from _changes(body, var)
        case Apply(op, args, _) if op in COMPARISONS and _is_monotone(args[0]) and _is_monotone(args[1]):
            if isinstance(args[0], Const) or isinstance(args[1], Const):
                yield from _limits(Apply(op, args, Bool()), var)
                return
            raise _too_many(var)
        case Apply(op, args, _) if op in _JOINING:
            for arg in args:
                yield from _changes(arg, var)
        case Const():
            return
        case _:
            raise _too_many(var)


def _too_many(var: Var) -> TooManyValues:
    return TooManyValues(f"each of {len(var.domain):,} values of {var.name} matters")


def _is_monotone(side: Expr) -> bool:
    """Whether a side rises or falls all the way with its variable."""
    match side:
        case Var() | Const():
            return True
        case Named(_, body):
            return _is_monotone(body)
        case Apply(op, args, _) if op in _RISING:
            varying = [arg for arg in args if not isinstance(arg, Const)]
            return len(varying) <= 1 and all(map(_is_monotone, varying))
    return False


def _limits(comparison: Apply, var: Var) -> Iterator[int]:
    """Where a comparison of a monotone side with a constant changes: it does so twice at most."""
    left, right = comparison.args
    for op in (Op.LT, Op.LE):
        test = Apply(op, (left, right), Bool())
        low, high = var.domain.low, var.domain.high
        first = evaluate(test, {var.name: low})
        if evaluate(test, {var.name: high}) == first:
            continue
        while high - low > 1:
            middle = (low + high) // 2
            if evaluate(test, {var.name: middle}) == first:
                low = middle
            else:
                high = middle
        yield high


__all__ = ["MOST_LISTED", "CellNumbers", "Stretches", "TooManyValues", "split_wide"]
