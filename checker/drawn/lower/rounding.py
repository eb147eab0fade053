"""Whole numbers of the formulas of real ones, which are exact fractions: floors, roundings, remainders.

What a computer rounds in the last digits of a real number is not rounded here.
"""

from collections.abc import Callable
from fractions import Fraction

from rovercheck.checker.drawn.lower.symbols import NotLowered, chosen, folded, least_and_greatest
from rovercheck.spec_model.lang.domain import Num
from rovercheck.spec_model.lang.expr import Apply, Const, Expr, aligned, const, rescale
from rovercheck.spec_model.lang.lower.ranges import possible
from rovercheck.spec_model.lang.operators import Op


def floor_of(expr: Expr) -> Expr:
    """The greatest whole number that is not above the value."""
    assert isinstance(expr.sort, Num)
    parts = expr.sort.resolution.denominator
    if parts == 1:
        return rescale(expr, Num())
    fine = rescale(expr, Num(Fraction(1, parts)))
    return folded(Apply(Op.DIV, (fine, Const(parts, Num())), Num()))


def ceiling_of(expr: Expr) -> Expr:
    """The least whole number that is not below the value."""
    return negated(floor_of(negated(expr)))


def nearest_of(expr: Expr) -> Expr:
    """The nearest whole number, of two the one that is farther from 0."""
    return _whole_by_sign(expr, lambda one: floor_of(sum_of(one, const(Fraction(1, 2)))))


def toward_zero(expr: Expr) -> Expr:
    """The whole part."""
    return _whole_by_sign(expr, floor_of)


def _by_sign(expr: Expr, of_positive: Callable[[Expr], Expr]) -> Expr:
    """What is known of positive numbers; below 0 it is the same with the other sign."""
    low, high = least_and_greatest(expr)
    if low >= 0:
        return of_positive(expr)
    below = negated(of_positive(negated(expr)))
    return below if high < 0 else chosen(folded(expr >= 0), of_positive(expr), below)


def _whole_by_sign(expr: Expr, of_positive: Callable[[Expr], Expr]) -> Expr:
    assert isinstance(expr.sort, Num)
    if expr.sort.resolution.denominator == 1:
        return rescale(expr, Num())
    return _by_sign(expr, of_positive)


def negated(expr: Expr) -> Expr:
    """The number with the other sign."""
    return folded(-expr)


def sum_of(one: Expr, other: Expr) -> Expr:
    """The sum of two numbers."""
    return folded(one + other)


MOST_CASES = 512
"""Values of an operand that are told apart, where an operator takes a constant only."""


def by_cases(operand: Expr, of: Callable[[Fraction], Expr]) -> Expr:
    """A formula that is known for each value of an operand.  Raises ``NotLowered`` for too many of them."""
    assert isinstance(operand.sort, Num)
    if isinstance(operand, Const):
        return of(operand.value * operand.sort.resolution)
    values = possible(operand)
    if len(values) > MOST_CASES:
        raise NotLowered(f"`{operand}` has more than {MOST_CASES} values here, and must be a constant")
    first, *others = sorted(values)
    made = of(first * operand.sort.resolution)
    for raw in others:
        made = chosen(operand == Const(raw, operand.sort), of(raw * operand.sort.resolution), made)
    return made


def remainder(one: Expr, other: Expr, zero_noted: bool = False) -> Expr:
    """The remainder of a division that is cut towards 0: it has the sign of ``one``.

    Raises ``NotLowered`` for a division by 0, unless the steps with one are noted.
    """

    def by(divisor: Fraction) -> Expr:
        if not divisor and zero_noted:
            return const(0)
        if not divisor:
            raise NotLowered(f"`{one}` may be divided by 0")
        return _by_sign(one, lambda positive: _modulo(positive, abs(divisor)))

    return by_cases(other, by)


def modulo(one: Expr, other: Expr) -> Expr:
    """MATLAB's ``mod``: it has the sign of ``other``, and is ``one`` where that is 0."""

    def by(divisor: Fraction) -> Expr:
        if divisor < 0:
            return negated(_modulo(negated(one), -divisor))
        return _modulo(one, divisor) if divisor else one

    return by_cases(other, by)


def _modulo(one: Expr, divisor: Fraction) -> Expr:
    (value, by), sort = aligned("mod", one, const(divisor))
    return folded(Apply(Op.MOD, (value, by), sort))


__all__ = [
    "MOST_CASES", "by_cases", "ceiling_of", "floor_of", "modulo", "nearest_of", "negated", "remainder",
    "sum_of", "toward_zero",
]  # fmt: skip
