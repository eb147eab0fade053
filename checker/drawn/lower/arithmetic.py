"""Conversions and operators on formulas of MATLAB's and C's numbers.

Real numbers are exact fractions: what a computer rounds in their last digits is not rounded here.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import reduce

from rovercheck.checker.drawn.lower.kinds import KindTable, is_member
from rovercheck.checker.drawn.lower.symbols import (
    INTEGERS,
    LOGICAL,
    REALS,
    UNTYPED,
    NotLowered,
    Symbolic,
    SymbolicArray,
    SymbolicScalar,
    chosen,
    flat,
    folded,
    least_and_greatest,
    matrix,
    number,
    size_of,
    truth,
)
from rovercheck.spec_model.lang.domain import Bool, Num
from rovercheck.spec_model.lang.expr import Apply, Const, Expr, aligned, all_of, any_of, const, rescale
from rovercheck.spec_model.lang.lower.ranges import possible
from rovercheck.spec_model.lang.operators import Op
from rovercheck.spec_model.lang.words import bit

MOST_CASES = 512
"""Values of an operand that are told apart, where an operator takes a constant only."""
Number1 = Callable[[Expr], Expr]


@dataclass(frozen=True)
class IntegerRules:
    """Whether numbers are those of C, and whether integers stop at their ends; else they wrap."""

    c: bool = False
    saturates: bool = True


# --- rounding ----------------------------------------------------------------------------------------------


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
    return _by_sign(expr, lambda one: floor_of(sum_of(one, const(Fraction(1, 2)))))


def toward_zero(expr: Expr) -> Expr:
    """The whole part."""
    return _by_sign(expr, floor_of)


def _by_sign(expr: Expr, of_positive: Number1) -> Expr:
    assert isinstance(expr.sort, Num)
    if expr.sort.resolution.denominator == 1:
        return rescale(expr, Num())
    low, high = least_and_greatest(expr)
    if low >= 0:
        return of_positive(expr)
    below = negated(of_positive(negated(expr)))
    return below if high < 0 else chosen(folded(expr >= 0), of_positive(expr), below)


def negated(expr: Expr) -> Expr:
    return folded(-expr)


def sum_of(one: Expr, other: Expr) -> Expr:
    return folded(one + other)


# --- conversions -------------------------------------------------------------------------------------------


def as_number(value: SymbolicScalar) -> Expr:
    """Any scalar as a formula of numbers: true is 1, a member its number."""
    sort = value.expr.sort
    if isinstance(sort, Num):
        return value.expr
    if isinstance(sort, Bool):
        return chosen(value.expr, const(1), const(0))
    if isinstance(value.expr, Const):
        return const(value.expr.value)
    first, *others = (raw for _, raw in sort.members)
    made: Expr = const(first)
    for raw in others:
        made = chosen(folded(value.expr == Const(raw, sort)), const(raw), made)
    return made


def as_condition(value: SymbolicScalar) -> Expr:
    """Any scalar as a condition: anything but 0."""
    if isinstance(value.expr.sort, Bool):
        return value.expr
    return folded(as_number(value) != 0)


def condition_of(value: Symbolic) -> Expr:
    """A value as a condition: of a matrix all of it, if there is anything."""
    every = [as_condition(one) for one in flat(value)]
    return folded(all_of(*every)) if every else folded(~all_of())


def in_range(expr: Expr, kind: str, saturates: bool) -> Expr:
    """A whole number in an integer type."""
    low, high = INTEGERS[kind]
    least, greatest = least_and_greatest(expr)
    if low <= least and greatest <= high:
        return expr
    if saturates:
        if greatest > high:
            expr = folded(Apply(Op.MIN, (expr, const(high)), Num()))
        return folded(Apply(Op.MAX, (expr, const(low)), Num())) if least < low else expr
    shifted = sum_of(expr, const(-low)) if low else expr
    turned = folded(Apply(Op.MOD, (shifted, const(high - low + 1)), Num()))
    return sum_of(turned, const(low)) if low else turned


def converted(value: SymbolicScalar, kind: str, rules: IntegerRules, kinds: KindTable) -> SymbolicScalar:
    """A scalar in another type: rounded, and in its range.  Raises ``NotLowered``."""
    if value.kind == kind:
        return value
    if kind == LOGICAL:
        return truth(as_condition(value))
    expr = as_number(value)
    if kind in REALS:
        return SymbolicScalar(kind, expr)
    if kind in INTEGERS:
        whole = toward_zero(expr) if rules.c else nearest_of(expr)
        return SymbolicScalar(kind, in_range(whole, kind, rules.saturates))
    if is_member(kind):
        return _member(expr, kind, kinds)
    if kind == UNTYPED:
        return SymbolicScalar(kind, toward_zero(expr))
    raise NotLowered(f"the type {kind!r} is not known")


def _member(expr: Expr, kind: str, kinds: KindTable) -> SymbolicScalar:
    """The member of a number; of a number that is none, the default one."""
    domain = kinds.domain(kind)
    assert domain is not None
    if isinstance(expr, Const):
        if expr.value not in domain or expr.sort != Num():
            raise NotLowered(f"{expr} is no member of {domain.sort}")
        return SymbolicScalar(kind, Const(expr.value, domain.sort))
    low, high = least_and_greatest(expr)
    outside = high - low >= MOST_CASES or any(value not in domain for value in range(int(low), int(high) + 1))
    if outside:
        raise NotLowered(f"`{expr}` may be no member of {domain.sort}: convert each number by itself")
    first, *others = domain.values
    made: Expr = Const(first, domain.sort)
    for raw in others:
        made = chosen(folded(expr == raw), Const(raw, domain.sort), made)
    return SymbolicScalar(kind, made)


def each_converted(value: Symbolic, kind: str, rules: IntegerRules, kinds: KindTable) -> Symbolic:
    """All scalars of a value in another type; of a structure none."""
    match value:
        case SymbolicScalar():
            return converted(value, kind, rules, kinds)
        case SymbolicArray(_, rows, columns, values):
            made = tuple(converted(one, kind, rules, kinds) for one in values)
            return SymbolicArray(kind, rows, columns, made)
    return value


# --- operators ---------------------------------------------------------------------------------------------

COMPARISONS: Mapping[str, Callable[[Expr, Expr], Expr]] = {
    "==": lambda a, b: a == b, "!=": lambda a, b: a != b, "<": lambda a, b: a < b,
    "<=": lambda a, b: a <= b, ">": lambda a, b: a > b, ">=": lambda a, b: a >= b,
}  # fmt: skip
_EXACT: Mapping[str, Callable[[Expr, Expr], Expr]] = {
    "+": lambda a, b: a + b, "-": lambda a, b: a - b, "*": lambda a, b: a * b, ".*": lambda a, b: a * b,
}  # fmt: skip
_BITS: Mapping[str, Callable[[Expr, Expr], Expr]] = {
    "bit|": lambda a, b: any_of(a, b), "bit&": lambda a, b: all_of(a, b),
    "bit^": lambda a, b: any_of(all_of(a, ~b), all_of(~a, b)),
}  # fmt: skip


def binary(sign: str, left: Symbolic, right: Symbolic, rules: IntegerRules) -> Symbolic:
    """An operator between two values, matrices element by element.  Raises ``NotLowered``."""
    if isinstance(left, SymbolicArray) and isinstance(right, SymbolicArray):
        if sign in ("*", "/", "^", "\\"):
            raise NotLowered(f"a product of matrices: write .{sign} for element by element")
        if size_of(left) != size_of(right):
            shown = " and ".join("x".join(map(str, size_of(one))) for one in (left, right))
            raise NotLowered(f"{sign} between matrices of {shown}")
    rows, columns = size_of(left if isinstance(left, SymbolicArray) else right)
    count = rows * columns
    lefts, rights = (
        (flat(one) * count)[:count] if size_of(one) == (1, 1) else flat(one) for one in (left, right)
    )
    made = [scalar_of(sign, one, other, rules) for one, other in zip(lefts, rights, strict=True)]
    return matrix(made, rows, columns)


def scalar_of(sign: str, left: SymbolicScalar, right: SymbolicScalar, rules: IntegerRules) -> SymbolicScalar:
    """An operator between two scalars.  Raises ``NotLowered``."""
    if sign in COMPARISONS:
        return truth(_compared(sign, left, right))
    if sign in ("|", "||"):
        return truth(folded(any_of(as_condition(left), as_condition(right))))
    if sign in ("&", "&&"):
        return truth(folded(all_of(as_condition(left), as_condition(right))))
    if is_member(left.kind) or is_member(right.kind):
        raise NotLowered(f"{sign} computes with a member of an enumeration: convert it, as in int32(x)")
    kind = _kind_in_c(left, right) if rules.c else _kind(sign, left, right)
    one, other = as_number(left), as_number(right)
    if sign in _BITS:
        return SymbolicScalar(kind, _bitwise(sign, one, other, kind))
    if sign in ("<<", ">>"):
        moved = shifted(one, other if sign == "<<" else negated(other), left.kind)
        return SymbolicScalar(left.kind, moved)
    if sign in _EXACT:
        exact = folded(_EXACT[sign](one, other))
    elif sign in ("/", "./"):
        exact = _quotient(one, other, kind, rules)
    elif sign == "%%":
        exact = remainder(one, other)
    elif sign in ("^", ".^"):
        exact = _power(one, right)
    else:
        raise NotLowered(f"the operator {sign} is not known here")
    if kind in INTEGERS:
        whole = toward_zero(exact) if rules.c else nearest_of(exact)
        return SymbolicScalar(kind, in_range(whole, kind, rules.saturates))
    return SymbolicScalar(kind, toward_zero(exact) if kind == UNTYPED else exact)


def _compared(sign: str, left: SymbolicScalar, right: SymbolicScalar) -> Expr:
    one, other = left.expr, right.expr
    same = one.sort == other.sort and not isinstance(one.sort, Num) and sign in ("==", "!=")
    if not same:
        one, other = as_number(left), as_number(right)
    made = folded(COMPARISONS[sign](one, other))
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


def _kind(sign: str, left: SymbolicScalar, right: SymbolicScalar) -> str:
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


def _quotient(one: Expr, other: Expr, kind: str, rules: IntegerRules) -> Expr:
    def by(divisor: Fraction) -> Expr:
        if divisor:
            return folded(one / divisor)
        if kind not in INTEGERS or rules.c:
            raise NotLowered(f"`{one} / {other}` may divide by 0")
        low, high = INTEGERS[kind]
        return chosen(folded(one > 0), const(high), chosen(folded(one < 0), const(low), const(0)))

    return by_cases(other, by)


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


def remainder(one: Expr, other: Expr) -> Expr:
    """The remainder of a division that is cut towards 0: it has the sign of ``one``."""

    def by(divisor: Fraction) -> Expr:
        if not divisor:
            raise NotLowered(f"`{one}` may be divided by 0")
        return _by_sign_of(one, lambda positive: _modulo(positive, abs(divisor)))

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


def _by_sign_of(expr: Expr, of_positive: Number1) -> Expr:
    low, high = least_and_greatest(expr)
    if low >= 0:
        return of_positive(expr)
    below = negated(of_positive(negated(expr)))
    return below if high < 0 else chosen(folded(expr >= 0), of_positive(expr), below)


def _power(one: Expr, exponent: SymbolicScalar) -> Expr:
    times = exponent.constant
    if times is None or times.denominator != 1 or not 0 <= times <= 16:
        raise NotLowered("a power with another exponent than a constant from 0 to 16: multiply")
    return reduce(lambda sofar, _: folded(sofar * one), range(int(times)), const(1))


# --- bits --------------------------------------------------------------------------------------------------


def _bitwise(sign: str, one: Expr, other: Expr, kind: str) -> Expr:
    if kind not in INTEGERS and kind not in (UNTYPED, "double"):
        raise NotLowered(f"{sign.removeprefix('bit')} between numbers that are not whole")
    low, high = INTEGERS[kind] if kind in INTEGERS else (0, 2**53 - 1)
    total = _joined_bits(one, other, low, high, _BITS[sign])
    return in_range(total, kind, saturates=False) if kind in INTEGERS else total


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
    """A whole number with its bits moved up, or down where ``by`` is negative; what leaves the type is lost."""

    def moved(places: Fraction) -> Expr:
        if places < 0:
            return folded(Apply(Op.DIV, (expr, const(2 ** int(-places))), Num()))
        up = folded(expr * 2 ** int(places))
        return in_range(up, kind, saturates=False) if kind in INTEGERS else up

    return by_cases(by, moved)


def complement(value: SymbolicScalar) -> SymbolicScalar:
    """All bits turned.  Raises ``NotLowered`` for a value without an integer type."""
    if value.kind not in INTEGERS:
        raise NotLowered("the complement of a number without an integer type: convert it, as in uint8(x)")
    low, high = INTEGERS[value.kind]
    return SymbolicScalar(value.kind, folded(const(high + low) - value.expr))


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
            plain = in_range(plain, kind, rules.saturates) if kind in INTEGERS else plain
        return SymbolicScalar(kind, plain)
    raise NotLowered(f"{sign} has no meaning before a value of the type {value.kind}")


__all__ = [
    "COMPARISONS", "IntegerRules", "as_condition", "as_number", "binary", "bit_of", "by_cases", "ceiling_of",
    "complement", "condition_of", "converted", "each_converted", "floor_of", "in_range", "modulo",
    "nearest_of", "negated", "number", "remainder", "scalar_of", "shifted", "sum_of", "toward_zero", "unary",
]  # fmt: skip
