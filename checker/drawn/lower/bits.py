"""Whole numbers joined, shifted and turned bit by bit; negative ones are in two's complement."""

import operator
from collections.abc import Callable, Mapping
from fractions import Fraction

from rovercheck.checker.drawn.lower.conversions import WRAPS, in_range
from rovercheck.checker.drawn.lower.rounding import by_cases, sum_of
from rovercheck.checker.drawn.lower.symbols import (
    INTEGERS,
    UNTYPED,
    NotLowered,
    SymbolicScalar,
    chosen,
    folded,
    least_and_greatest,
)
from rovercheck.spec_model.lang.domain import Num
from rovercheck.spec_model.lang.expr import Apply, Const, Expr, all_of, any_of, const
from rovercheck.spec_model.lang.operators import Op
from rovercheck.spec_model.lang.words import bit

BIT_SIGNS: Mapping[str, Callable[[Expr, Expr], Expr]] = {
    "bit|": any_of,
    "bit&": all_of,
    "bit^": lambda a, b: any_of(all_of(a, ~b), all_of(~a, b)),
}
"""How two bits are joined by each operator."""


WHOLE_SIGNS: Mapping[str, Callable[[int, int], int]] = {
    "bit|": operator.or_, "bit&": operator.and_, "bit^": operator.xor
}  # fmt: skip
"""The same of whole numbers."""


def bitwise(sign: str, one: Expr, other: Expr, kind: str) -> Expr:
    """Two whole numbers joined by one of ``BIT_SIGNS``.  Raises ``NotLowered`` for those of another type."""
    if kind not in INTEGERS and kind not in (UNTYPED, "double"):
        raise NotLowered(f"{sign.removeprefix('bit')} between numbers that are not whole")
    if isinstance(one, Const) and isinstance(other, Const) and kind == UNTYPED:
        return const(WHOLE_SIGNS[sign](one.value, other.value))
    if kind in INTEGERS:  # as a literal, or a shorter type of C, may be negative beside an unsigned one
        one, other = (in_range(side, kind, WRAPS) for side in (one, other))
    low, high = INTEGERS[kind] if kind in INTEGERS else (0, 2**53 - 1)
    total = _joined_bits(one, other, low, high, BIT_SIGNS[sign])
    return in_range(total, kind, WRAPS) if kind in INTEGERS else total


def _joined_bits(one: Expr, other: Expr, low: int, high: int, join: Callable[[Expr, Expr], Expr]) -> Expr:
    """Two numbers joined bit by bit; negative ones in two's complement."""
    span = high - low + 1
    sides = []
    for side in (one, other):
        least, greatest = least_and_greatest(side)
        if least < low or greatest > high:
            raise NotLowered(f"the bits of `{side}`, which may lie outside its type")
        sides.append(side if least >= 0 else folded(Apply(Op.MOD, (side, const(span)), Num())))
    widest = max(int(least_and_greatest(side)[1]) for side in sides)
    total: Expr = const(0)
    for place in range(widest.bit_length()):
        both = folded(join(bit_of(sides[0], place), bit_of(sides[1], place)))
        if not (isinstance(both, Const) and not both.value):
            total = sum_of(total, chosen(both, const(2**place), const(0)))
    return total


def bit_of(expr: Expr, place: int) -> Expr:
    """A bit of a number that is not negative."""
    if int(least_and_greatest(expr)[1]) < 2**place:
        return const(False)
    return folded(bit(expr, place))


def shifted(expr: Expr, by: Expr, kind: str) -> Expr:
    """A whole number with its bits moved up, or down where ``by`` is negative.

    Bits that leave the type are lost.  Raises ``NotLowered`` for a ``by`` of too many values.
    """

    def moved(places: Fraction) -> Expr:
        if places < 0:
            return folded(Apply(Op.DIV, (expr, const(2 ** int(-places))), Num()))
        up = folded(expr * 2 ** int(places))
        return in_range(up, kind, WRAPS) if kind in INTEGERS else up

    return by_cases(by, moved)


def complement(value: SymbolicScalar) -> SymbolicScalar:
    """All bits turned.  Raises ``NotLowered`` for a value without an integer type."""
    if value.kind == UNTYPED:
        return SymbolicScalar(UNTYPED, folded(const(-1) - value.expr))
    if value.kind not in INTEGERS:
        raise NotLowered("the complement of a number without an integer type: convert it, as in uint8(x)")
    low, high = INTEGERS[value.kind]
    return SymbolicScalar(value.kind, folded(const(high + low) - value.expr))


__all__ = ["BIT_SIGNS", "bit_of", "bitwise", "complement", "shifted"]
