"""Operators of MATLAB and C between formulas of numbers, truth values and matrices."""

from collections.abc import Callable, Mapping
from fractions import Fraction
from functools import reduce

from rovercheck.checker.drawn.lower.bits import BIT_SIGNS, bitwise, complement, shifted
from rovercheck.checker.drawn.lower.conversions import IntegerRules, as_condition, as_number, in_range
from rovercheck.checker.drawn.lower.kinds import is_member
from rovercheck.checker.drawn.lower.rounding import by_cases, nearest_of, negated, remainder, toward_zero
from rovercheck.checker.drawn.lower.symbols import (
    INTEGERS,
    LOGICAL,
    REALS,
    UNTYPED,
    NotLowered,
    Symbolic,
    SymbolicArray,
    SymbolicScalar,
    SymbolicStructure,
    chosen,
    flat,
    folded,
    least_and_greatest,
    matrix,
    size_of,
    truth,
)
from rovercheck.spec_model.lang.domain import Num
from rovercheck.spec_model.lang.expr import Apply, Const, Expr, all_of, any_of, const
from rovercheck.spec_model.lang.lower.ranges import possible

_COMPARISONS: Mapping[str, Callable[[Expr, Expr], Expr]] = {
    "==": lambda a, b: a == b, "!=": lambda a, b: a != b, "<": lambda a, b: a < b,
    "<=": lambda a, b: a <= b, ">": lambda a, b: a > b, ">=": lambda a, b: a >= b,
}  # fmt: skip
_EXACT: Mapping[str, Callable[[Expr, Expr], Expr]] = {
    "+": lambda a, b: a + b, "-": lambda a, b: a - b, "*": lambda a, b: a * b, ".*": lambda a, b: a * b,
}  # fmt: skip


def binary(sign: str, left: Symbolic, right: Symbolic, rules: IntegerRules) -> Symbolic:
    """An operator between two values, matrices element by element.  Raises ``NotLowered``."""
    if isinstance(left, SymbolicArray) and isinstance(right, SymbolicArray):
        if sign == "*":
            return _product(left, right, rules)
        if sign in ("/", "^", "\\"):
            raise NotLowered(f"{sign} between matrices: write .{sign} for element by element")
        if size_of(left) != size_of(right):
            shown = " and ".join("x".join(map(str, size_of(one))) for one in (left, right))
            raise NotLowered(f"{sign} between matrices of {shown}")
    rows, columns = size_of(left if isinstance(left, SymbolicArray) else right)
    count = rows * columns
    lefts, rights = (
        tuple(flat(one)) * count if size_of(one) == (1, 1) else flat(one) for one in (left, right)
    )
    made = [scalar_of(sign, one, other, rules) for one, other in zip(lefts, rights, strict=True)]
    return matrix(made, rows, columns)


def _product(left: SymbolicArray, right: SymbolicArray, rules: IntegerRules) -> Symbolic:
    if left.columns != right.rows:
        raise NotLowered(f"* between matrices of {left.rows}x{left.columns} and {right.rows}x{right.columns}")

    def entry(row: int, column: int) -> SymbolicScalar:
        pairs = zip(left.values[row * left.columns :], right.values[column :: right.columns], strict=False)
        terms = [scalar_of("*", one, other, rules) for one, other in pairs]
        return reduce(lambda sofar, one: scalar_of("+", sofar, one, rules), terms)

    made = [entry(row, column) for row in range(left.rows) for column in range(right.columns)]
    return matrix(made, left.rows, right.columns)


def scalar_of(sign: str, left: SymbolicScalar, right: SymbolicScalar, rules: IntegerRules) -> SymbolicScalar:
    """An operator between two scalars.  Raises ``NotLowered``."""
    if sign in _COMPARISONS:
        return truth(_compared(sign, left, right))
    if sign in ("|", "||"):
        return truth(folded(any_of(as_condition(left), as_condition(right))))
    if sign in ("&", "&&"):
        return truth(folded(all_of(as_condition(left), as_condition(right))))
    if is_member(left.kind) or is_member(right.kind):
        raise NotLowered(f"{sign} computes with a member of an enumeration: convert it, as in int32(x)")
    kind = kind_of_both(sign, left, right, rules)
    one, other = as_number(left), as_number(right)
    if sign in BIT_SIGNS:
        return SymbolicScalar(kind, bitwise(sign, one, other, kind))
    if sign in ("<<", ">>"):
        moved = shifted(one, other if sign == "<<" else negated(other), left.kind)
        return SymbolicScalar(left.kind, moved)
    if sign in _EXACT:
        exact = folded(_EXACT[sign](one, other))
    elif sign in ("/", "./"):
        exact = _quotient(one, other, kind, rules)
    elif sign == "%%":
        exact = remainder(one, other, rules.zero_noted)
    elif sign in ("^", ".^"):
        exact = _power(one, right)
    else:
        raise NotLowered(f"the operator {sign} is not known here")
    if kind in INTEGERS:
        return SymbolicScalar(kind, in_range(_whole(exact, rules), kind, rules))
    return SymbolicScalar(kind, toward_zero(exact) if kind == UNTYPED else exact)


def _whole(exact: Expr, rules: IntegerRules) -> Expr:
    """A whole number as MATLAB rounds it, or as C cuts it."""
    return toward_zero(exact) if rules.c else nearest_of(exact)


def _compared(sign: str, left: SymbolicScalar, right: SymbolicScalar) -> Expr:
    one, other = left.expr, right.expr
    same = one.sort == other.sort and not isinstance(one.sort, Num) and sign in ("==", "!=")
    if not same:
        one, other = as_number(left), as_number(right)
    made = folded(_COMPARISONS[sign](one, other))
    if isinstance(made, Apply) and not same:
        decided = _decided(sign, one, other)
        if decided is not None:
            return const(decided)
    return made


def _decided(sign: str, one: Expr, other: Expr) -> bool | None:
    """The truth of a comparison, where the ranges of its sides leave no doubt."""
    (low, high), (least, most) = least_and_greatest(one), least_and_greatest(other)
    if sign in ("==", "!=") and (high < least or most < low):
        return sign == "!="
    if sign in ("<", ">=") and (high < least or low >= most):
        return (high < least) == (sign == "<")
    if sign in (">", "<=") and (low > most or high <= least):
        return (low > most) == (sign == ">")
    return None


def kind_of_both(sign: str, left: SymbolicScalar, right: SymbolicScalar, rules: IntegerRules) -> str:
    """The type in which two scalars are computed with.  Raises ``NotLowered``."""
    return _kind_in_c(left, right) if rules.c else _kind(sign, left, right)


def _kind(sign: str, left: SymbolicScalar, right: SymbolicScalar) -> str:
    if left.kind == right.kind == UNTYPED:
        return UNTYPED
    kinds = dict.fromkeys(one.kind for one in (left, right) if one.kind in INTEGERS)
    if len(kinds) > 1:
        raise NotLowered(f"{sign} between {' and '.join(kinds)}: MATLAB takes integers of one type only")
    return next(iter(kinds), "single" if "single" in (left.kind, right.kind) else "double")


def _kind_in_c(left: SymbolicScalar, right: SymbolicScalar) -> str:
    """Of integers the larger type, the unsigned one of two that are as large."""
    kinds = [("uint8" if one.kind == LOGICAL else one.kind) for one in (left, right)]
    for kind in REALS:
        if kind in kinds:
            return kind
    typed = [kind for kind in kinds if kind != UNTYPED]
    return max(typed, key=lambda kind: (int(kind.lstrip("uint")), kind[0] == "u")) if typed else UNTYPED


DIVISIONS = ("/", "./", "%%")


def zeros_of(sign: str, one: Symbolic, other: Symbolic, rules: IntegerRules) -> list[Expr]:
    """The conditions under which an operator divides by 0, where that has no meaning.

    A constant 0 is refused where it is computed with, and integers of MATLAB stop at their ends.
    """
    if sign not in DIVISIONS or isinstance(other, SymbolicStructure):
        return []
    if not rules.c and {one.kind, other.kind} & INTEGERS.keys():
        return []
    divisors = (as_number(one) for one in flat(other) if one.constant is None)
    return [folded(by == 0) for by in divisors if 0 in possible(by)]


def _quotient(one: Expr, other: Expr, kind: str, rules: IntegerRules) -> Expr:
    def by(divisor: Fraction) -> Expr:
        if divisor:  # integers are rounded here: no resolution is common to the quotients of all divisors
            exact = folded(one / divisor)
            return _whole(exact, rules) if kind in INTEGERS else exact
        if rules.zero_noted and not isinstance(other, Const):
            return const(0)
        if kind not in INTEGERS or rules.c:
            raise NotLowered(f"`{one} / {other}` may divide by 0")
        low, high = INTEGERS[kind]
        return chosen(folded(one > 0), const(high), chosen(folded(one < 0), const(low), const(0)))

    return by_cases(other, by)


def _power(one: Expr, exponent: SymbolicScalar) -> Expr:
    times = exponent.constant
    if times is None or times.denominator != 1 or not 0 <= times <= 16:
        raise NotLowered("a power with another exponent than a constant from 0 to 16: multiply")
    first: Expr = const(1)
    return reduce(lambda sofar, _: folded(sofar * one), range(int(times)), first)


def unary(sign: str, value: Symbolic, rules: IntegerRules) -> Symbolic:
    """An operator before a value, or a transpose behind it.  Raises ``NotLowered``."""
    rows, columns = size_of(value)
    if sign in ("'", ".'"):
        every = flat(value)
        return matrix((every[r * columns + c] for c in range(columns) for r in range(rows)), columns, rows)
    return matrix((_one(sign, one, rules) for one in flat(value)), rows, columns)


def _one(sign: str, value: SymbolicScalar, rules: IntegerRules) -> SymbolicScalar:
    if sign == "!":
        return truth(folded(~as_condition(value)))
    if sign == "bit~":
        return complement(value)
    if sign in ("-", "+") and not is_member(value.kind):
        kind = "double" if value.kind == LOGICAL else value.kind
        plain = as_number(value)
        if sign == "-":
            plain = negated(plain)
            plain = in_range(plain, kind, rules) if kind in INTEGERS else plain
        return SymbolicScalar(kind, plain)
    raise NotLowered(f"{sign} has no meaning before a value of the type {value.kind}")


__all__ = ["DIVISIONS", "binary", "kind_of_both", "scalar_of", "unary", "zeros_of"]
