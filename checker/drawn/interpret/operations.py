"""Operators on MATLAB's values, in both languages; matrices element by element."""

import operator
from collections.abc import Callable, Mapping
from math import copysign, fmod, inf, isinf, isnan, nan, trunc

from rovercheck.checker.drawn.faults import DrawnFault
from rovercheck.checker.drawn.interpret.values import (
    LITERAL,
    WHOLE,
    ArrayOf,
    MatlabValue,
    NumberRules,
    Scalar,
    array,
    converted,
    double,
    in_range,
    logical,
    nearest,
    scalars,
    shape,
    single,
)

Compare = Callable[[float, float], bool]
COMPARISONS: Mapping[str, Compare] = {
    "==": operator.eq, "!=": operator.ne, "<": operator.lt, "<=": operator.le, ">": operator.gt,
    ">=": operator.ge,
}  # fmt: skip
ARITHMETIC: Mapping[str, Callable[[float, float], float]] = {
    "+": operator.add, "-": operator.sub, "*": operator.mul, ".*": operator.mul
}  # fmt: skip
BITS: Mapping[str, Callable[[int, int], int]] = {
    "bit|": operator.or_, "bit&": operator.and_, "bit^": operator.xor
}  # fmt: skip


def binary(sign: str, left: MatlabValue, right: MatlabValue, rules: NumberRules) -> MatlabValue:
    """An operator between two values, of which one may be a scalar.  Raises ``DrawnFault``."""
    if not isinstance(left, ArrayOf) and not isinstance(right, ArrayOf):
        [one], [other] = scalars(left), scalars(right)
        return _scalar(sign, one, other, rules)
    if sign in ("*", "/", "^", "\\") and isinstance(left, ArrayOf) and isinstance(right, ArrayOf):
        if sign == "*":
            return _product(left, right, rules)
        raise DrawnFault(f"{sign} between matrices is not known here: write .{sign} for element by element")
    rows, columns = shape(left if isinstance(left, ArrayOf) else right)
    if isinstance(left, ArrayOf) and isinstance(right, ArrayOf) and shape(right) != (rows, columns):
        raise DrawnFault(
            f"{sign} between matrices of {rows}x{columns} and {'x'.join(map(str, shape(right)))}"
        )
    size = rows * columns
    lefts = left.values if isinstance(left, ArrayOf) else tuple(scalars(left)) * size
    rights = right.values if isinstance(right, ArrayOf) else tuple(scalars(right)) * size
    made = [_scalar(sign, one, other, rules) for one, other in zip(lefts, rights, strict=True)]
    return array(made, rows, columns)


def _product(left: ArrayOf, right: ArrayOf, rules: NumberRules) -> MatlabValue:
    if left.columns != right.rows:
        raise DrawnFault(f"* between matrices of {left.rows}x{left.columns} and {right.rows}x{right.columns}")
    made = []
    for row in range(left.rows):
        for column in range(right.columns):
            across = left.values[row * left.columns : (row + 1) * left.columns]
            terms = [
                _scalar("*", a, b, rules)
                for a, b in zip(across, right.values[column :: right.columns], strict=True)
            ]
            total = terms[0]
            for term in terms[1:]:
                total = _scalar("+", total, term, rules)
            made.append(total)
    return array(made, left.rows, right.columns)


def _scalar(sign: str, left: Scalar, right: Scalar, rules: NumberRules) -> Scalar:
    if sign in COMPARISONS:
        return logical(_compared(sign, left, right))
    if sign == "|":
        return logical(left.truth or right.truth)
    if sign == "&":
        return logical(left.truth and right.truth)
    kind = _kind(sign, left, right, rules)
    if sign in BITS:
        return Scalar(kind, _pattern(BITS[sign](int(left.value), int(right.value)), kind))
    if sign in ("<<", ">>"):
        return _shifted(sign, left, right)
    if kind in WHOLE or kind == LITERAL:
        return Scalar(kind, _of_integers(sign, left.value, right.value, kind, rules))
    one, other = float(left.value), float(right.value)
    if kind == "single":
        return Scalar(kind, single(_of_floats(sign, single(one), single(other))))
    return Scalar(kind, _of_floats(sign, one, other))


def _compared(sign: str, left: Scalar, right: Scalar) -> bool:
    """Values are compared; where one is in single precision, in single precision."""
    one, other = left.value, right.value
    if "single" in (left.kind, right.kind):
        one, other = single(float(one)), single(float(other))
    return COMPARISONS[sign](one, other)


def _kind(sign: str, left: Scalar, right: Scalar, rules: NumberRules) -> str:
    """The type of a result."""
    if left.kind.startswith("Enum:") or right.kind.startswith("Enum:"):
        raise DrawnFault(f"{sign} computes with no member of an enumeration: convert it, as in int32(x)")
    if rules.c or left.kind == right.kind == LITERAL:
        return _kind_in_c(left, right)
    kinds = dict.fromkeys(one.kind for one in (left, right) if one.kind in WHOLE)
    if len(kinds) > 1:
        raise DrawnFault(f"{sign} between {' and '.join(kinds)}: MATLAB takes integers of one type only")
    return next(iter(kinds), "single" if "single" in (left.kind, right.kind) else "double")


def _kind_in_c(left: Scalar, right: Scalar) -> str:
    """Of integers the larger type, the unsigned one of two that are as large; a literal takes the other's."""
    kinds = [("uint8" if one.kind == "logical" else one.kind) for one in (left, right)]
    for kind in ("double", "single"):
        if kind in kinds:
            return kind
    typed = [kind for kind in kinds if kind != LITERAL]
    if not typed:
        return LITERAL
    return max(typed, key=lambda kind: (int(kind.lstrip("uint")), kind.startswith("u")))


def _pattern(value: int, kind: str) -> int:
    return value if kind == LITERAL else in_range(value, kind, saturates=False)


def _shifted(sign: str, left: Scalar, right: Scalar) -> Scalar:
    by, kind = int(right.value), left.kind
    if not 0 <= by < 64 or not left.whole:
        raise DrawnFault(f"{left.kind} {sign} {by} has no meaning: integers are shifted by 0 to 63 bits")
    moved = int(left.value) << by if sign == "<<" else int(left.value) >> by
    return Scalar(kind, _pattern(moved, kind))


def _of_integers(sign: str, one: float, other: float, kind: str, rules: NumberRules) -> int:
    if sign in ARITHMETIC:
        exact: float = ARITHMETIC[sign](one, other)
    elif sign in ("/", "./"):
        return _divided(one, other, kind, rules)
    elif sign == "%%":
        if other == 0:
            raise DrawnFault("the remainder of a division by 0")
        exact = int(fmod(one, other))
    elif sign in ("^", ".^"):
        exact = one**other if other >= 0 or one != 0 else inf
    else:
        raise DrawnFault(f"{sign} has no meaning between integers")
    if isinstance(exact, float):
        return int(converted(Scalar("double", exact), kind, rules).value) if kind != LITERAL else trunc(exact)
    return exact if kind == LITERAL else in_range(exact, kind, rules.saturates)


def _divided(one: float, other: float, kind: str, rules: NumberRules) -> int:
    """C cuts towards 0; MATLAB rounds to the nearest, and stops at the ends of a division by 0."""
    if other == 0:
        if rules.c:
            raise DrawnFault("a division by 0")
        low, high = WHOLE.get(kind, (0, 0))
        return 0 if one == 0 or isnan(one) else high if one > 0 else low
    if isinstance(one, int) and isinstance(other, int):
        whole, rest = divmod(abs(one), abs(other))
        if not rules.c:
            whole += 2 * rest >= abs(other)
        exact = whole if (one < 0) == (other < 0) else -whole
    else:
        quotient = one / other
        exact = trunc(quotient) if rules.c else nearest(quotient) if not isinf(quotient) else 0
    return exact if kind == LITERAL else in_range(exact, kind, rules.saturates)


def _of_floats(sign: str, one: float, other: float) -> float:
    if sign in ARITHMETIC:
        return ARITHMETIC[sign](one, other)
    if sign in ("/", "./"):
        if other == 0:
            return nan if one == 0 or isnan(one) else copysign(inf, one) * copysign(1.0, other)
        return one / other
    if sign in ("^", ".^"):
        try:
            found = one**other
        except ZeroDivisionError:
            return inf
        except OverflowError:
            return inf
        if isinstance(found, complex):
            raise DrawnFault(f"{one:g} to the power of {other:g} is no real number")
        return float(found)
    if sign == "%%" and other != 0:
        return fmod(one, other)
    raise DrawnFault(f"{sign} has no meaning between {one:g} and {other:g}")


def unary(sign: str, value: MatlabValue, rules: NumberRules) -> MatlabValue:
    """An operator before a value, or a transpose behind it.  Raises ``DrawnFault``."""
    if sign in ("'", ".'"):
        if not isinstance(value, ArrayOf):
            return value
        turned = (
            value.values[r * value.columns + c] for c in range(value.columns) for r in range(value.rows)
        )
        return ArrayOf(value.kind, value.columns, value.rows, tuple(turned))
    if isinstance(value, ArrayOf):
        made = [_one(sign, one, rules) for one in value.values]
        return array(made, value.rows, value.columns)
    [one] = scalars(value)
    return _one(sign, one, rules)


def _one(sign: str, value: Scalar, rules: NumberRules) -> Scalar:
    if sign == "!":
        return logical(not value.truth)
    if sign == "bit~" and value.whole:
        return Scalar(value.kind, _pattern(~int(value.value), value.kind))
    if sign in ("-", "+"):
        plain = double(value.value) if value.kind == "logical" else value
        if sign == "+":
            return plain
        return (
            Scalar(plain.kind, in_range(-int(plain.value), plain.kind, rules.saturates))
            if (plain.kind in WHOLE)
            else Scalar(plain.kind, -plain.value)
        )
    raise DrawnFault(f"{sign} has no meaning before a value of the type {value.kind}")


__all__ = ["binary", "unary"]
