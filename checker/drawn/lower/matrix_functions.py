"""Further functions of MATLAB and C as formulas: operators by their names, sizes, sums along vectors."""

from collections.abc import Mapping
from fractions import Fraction
from functools import reduce
from math import pi

from rovercheck.checker.drawn.lower.arithmetic import binary, scalar_of, unary
from rovercheck.checker.drawn.lower.builtins import BUILTINS, Arguments, Builtin
from rovercheck.checker.drawn.lower.conversions import IntegerRules, as_condition, as_number, in_range
from rovercheck.checker.drawn.lower.kinds import KindTable
from rovercheck.checker.drawn.lower.rounding import by_cases, remainder, sum_of, toward_zero
from rovercheck.checker.drawn.lower.symbols import (
    INTEGERS,
    NotLowered,
    Symbolic,
    SymbolicScalar,
    chosen,
    flat,
    folded,
    matrix,
    number,
    single_of,
    size_of,
    truth,
)
from rovercheck.spec_model.lang.expr import Expr, any_of, const

PLAIN = {
    "plus": "+", "minus": "-", "times": ".*", "mtimes": "*", "rdivide": "./", "mrdivide": "/", "power": ".^",
    "mpower": "^", "eq": "==", "ne": "!=", "lt": "<", "le": "<=", "gt": ">", "ge": ">=", "and": "&",
    "or": "|",
}  # fmt: skip
"""The operators that functions stand for."""


def _operator(sign: str) -> Builtin:
    def apply(arguments: Arguments, rules: IntegerRules, kinds: KindTable) -> Symbolic:
        one, other = arguments
        return binary(sign, one, other, rules)

    return apply


def _before(sign: str) -> Builtin:
    return lambda arguments, rules, kinds: unary(sign, arguments[0], rules)


def _either(arguments: Arguments, rules: IntegerRules, kinds: KindTable) -> Symbolic:
    one, other = arguments
    return binary("!=", unary("!", one, rules), unary("!", other, rules), rules)


def _quotient(arguments: Arguments, rules: IntegerRules, kinds: KindTable) -> Symbolic:
    """``idivide``, which cuts towards 0."""
    left, right = map(single_of, arguments)
    kind = scalar_of("+", left, right, rules).kind
    if kind not in INTEGERS:
        raise NotLowered("idivide divides integers: convert one of them, as in int32(x)")
    one = as_number(left)

    def by(divisor: Fraction) -> Expr:
        if divisor:
            return in_range(toward_zero(folded(one / divisor)), kind, rules.saturates)
        low, high = INTEGERS[kind]
        return chosen(folded(one > 0), const(high), chosen(folded(one < 0), const(low), const(0)))

    return SymbolicScalar(kind, by_cases(as_number(right), by))


def _real_power(arguments: Arguments, rules: IntegerRules, kinds: KindTable) -> Symbolic:
    return binary("^", _real(arguments[0]), arguments[1], IntegerRules(False, True))


def _real_remainder(arguments: Arguments, rules: IntegerRules, kinds: KindTable) -> Symbolic:
    one, other = (as_number(single_of(value)) for value in arguments)
    return SymbolicScalar("double", remainder(one, other))


def _scaled(arguments: Arguments, rules: IntegerRules, kinds: KindTable) -> Symbolic:
    value, bits = (as_number(single_of(one)) for one in arguments)
    return SymbolicScalar("double", by_cases(bits, lambda n: folded(value * Fraction(2) ** int(n))))


def _real(value: Symbolic) -> SymbolicScalar:
    return SymbolicScalar("double", as_number(single_of(value)))


def _size(arguments: Arguments, rules: IntegerRules, kinds: KindTable) -> Symbolic:
    rows, columns = size_of(arguments[0])
    if len(arguments) == 1:
        return matrix([number("double", rows), number("double", columns)], 1, 2)
    along = single_of(arguments[1]).constant
    if along is None:
        raise NotLowered("size along a dimension that is no constant")
    return number("double", {1: rows, 2: columns}.get(int(along), 1))


def _mean(arguments: Arguments, rules: IntegerRules, kinds: KindTable) -> Symbolic:
    total, count = BUILTINS["sum"](arguments, rules, kinds), len(flat(arguments[0]))
    return binary("/", total, number("double", count), rules)


def _running_sum(arguments: Arguments, rules: IntegerRules, kinds: KindTable) -> Symbolic:
    rows, columns = size_of(arguments[0])
    if min(rows, columns) > 1:
        raise NotLowered("cumsum of a matrix: take its rows one by one")
    made: list[SymbolicScalar] = []
    for one in flat(arguments[0]):
        made.append(scalar_of("+", made[-1], one, rules) if made else one)
    return matrix(made, rows, columns)


def _scalar_product(arguments: Arguments, rules: IntegerRules, kinds: KindTable) -> Symbolic:
    left, right = (flat(one) for one in arguments)
    if len(left) != len(right):
        raise NotLowered(f"dot of vectors with {len(left)} and {len(right)} elements")
    made = [scalar_of("*", one, other, rules) for one, other in zip(left, right, strict=True)]
    return reduce(lambda sofar, one: scalar_of("+", sofar, one, rules), made[1:], made[0])


def _flipped(rows: bool, columns: bool) -> Builtin:
    def apply(arguments: Arguments, rules: IntegerRules, kinds: KindTable) -> Symbolic:
        down, across = size_of(arguments[0])
        every = flat(arguments[0])
        lines = [every[n * across : (n + 1) * across] for n in range(down)]
        ordered = lines[::-1] if rows else lines
        return matrix((one for line in ordered for one in (line[::-1] if columns else line)), down, across)

    return apply


def _flip(arguments: Arguments, rules: IntegerRules, kinds: KindTable) -> Symbolic:
    row = size_of(arguments[0])[0] == 1
    return _flipped(not row, row)(arguments, rules, kinds)


def _shifted(arguments: Arguments, rules: IntegerRules, kinds: KindTable) -> Symbolic:
    """``circshift`` of a vector."""
    every, by = flat(arguments[0]), single_of(arguments[1]).constant
    if by is None or min(size_of(arguments[0])) > 1:
        raise NotLowered("circshift is known of a vector, by a constant")
    at = -int(by) % len(every)
    return matrix((*every[at:], *every[:at]), *size_of(arguments[0]))


def _is_member(arguments: Arguments, rules: IntegerRules, kinds: KindTable) -> Symbolic:
    among = flat(arguments[1])
    made = [
        truth(folded(any_of(*(scalar_of("==", one, other, rules).expr for other in among))))
        for one in flat(arguments[0])
    ]
    return matrix(made, *size_of(arguments[0]))


def _always(arguments: Arguments, rules: IntegerRules, kinds: KindTable) -> Symbolic:
    return matrix([truth(const(True)) for _ in flat(arguments[0])], *size_of(arguments[0]))


def _not_zero(arguments: Arguments, rules: IntegerRules, kinds: KindTable) -> Symbolic:
    made: Expr = const(0)
    for one in flat(arguments[0]):
        made = sum_of(made, chosen(as_condition(one), const(1), const(0)))
    return SymbolicScalar("double", made)


FURTHER: Mapping[str, Builtin] = {
    **{name: _operator(sign) for name, sign in PLAIN.items()},
    "not": _before("!"), "uminus": _before("-"), "uplus": _before("+"), "xor": _either,
    "idivide": _quotient, "size": _size, "mean": _mean, "cumsum": _running_sum, "dot": _scalar_product,
    "flip": _flip, "fliplr": _flipped(False, True), "flipud": _flipped(True, False), "ismember": _is_member,
    "circshift": _shifted, "isfinite": _always, "nnz": _not_zero,
    "isscalar": lambda arguments, rules, kinds: truth(const(size_of(arguments[0]) == (1, 1))),
    "pi": lambda arguments, rules, kinds: number("double", Fraction(pi)),
    "eps": lambda arguments, rules, kinds: number("double", Fraction(1, 2**52)),
    "fabs": lambda arguments, rules, kinds: BUILTINS["abs"]([_real(arguments[0])], rules, kinds),
    "labs": BUILTINS["abs"], "fmod": _real_remainder, "pow": _real_power, "ldexp": _scaled,
}  # fmt: skip
"""By name."""


def place_of_extreme(name: str, value: Symbolic, rules: IntegerRules) -> Symbolic:
    """The second result of ``min`` and ``max``: where the first of the values is that they give."""
    sign = "<" if name == "min" else ">"
    best, *others = flat(value)
    place: Expr = const(1)
    for at, one in enumerate(others, 2):
        better = scalar_of(sign, one, best, rules).expr
        best = SymbolicScalar(best.kind, chosen(better, one.expr, best.expr))
        place = chosen(better, const(at), place)
    return SymbolicScalar("double", place)


def limit_of(name: str, kind: str) -> Symbolic:
    """``intmax`` and ``intmin`` of an integer type."""
    if kind not in INTEGERS:
        raise NotLowered(f"{name} of {kind!r}, which is no type of integers")
    return number(kind, INTEGERS[kind][name == "intmax"])


TYPED = ("cast", "isa", "intmax", "intmin")
"""Functions that ask for, or make, a type."""
EXTREMES = ("min", "max")
"""Functions with two results."""

__all__ = ["EXTREMES", "FURTHER", "TYPED", "limit_of", "place_of_extreme"]
