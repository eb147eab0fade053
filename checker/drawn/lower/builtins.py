"""MATLAB's functions of numbers as formulas, as far as charts use them."""

from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction
from functools import reduce
from math import isqrt

from rovercheck.checker.drawn.lower.arithmetic import binary, kind_of_both, scalar_of
from rovercheck.checker.drawn.lower.bits import bit_of, complement, shifted
from rovercheck.checker.drawn.lower.conversions import (
    IntegerRules,
    as_condition,
    as_number,
    each_converted,
    in_range,
)
from rovercheck.checker.drawn.lower.kinds import KindTable
from rovercheck.checker.drawn.lower.rounding import (
    by_cases,
    ceiling_of,
    floor_of,
    modulo,
    nearest_of,
    negated,
    remainder,
    sum_of,
    toward_zero,
)
from rovercheck.checker.drawn.lower.symbols import (
    INTEGERS,
    LOGICAL,
    REALS,
    NotLowered,
    Symbolic,
    SymbolicScalar,
    chosen,
    flat,
    folded,
    least_and_greatest,
    matrix,
    number,
    single_of,
    size_of,
    truth,
)
from rovercheck.spec_model.lang.domain import Num
from rovercheck.spec_model.lang.expr import FALSE, TRUE, Apply, Const, Expr, aligned, all_of, any_of, const
from rovercheck.spec_model.lang.operators import Op

Arguments = Sequence[Symbolic]
Builtin = Callable[[Arguments, IntegerRules, KindTable], Symbolic]
MOST_FILLED = 10_000


def _each(change: Callable[[Expr], Expr]) -> Builtin:
    """A function of one number; integers keep their type, and stay in its range."""

    def apply(arguments: Arguments, rules: IntegerRules, kinds: KindTable) -> Symbolic:
        [value] = arguments
        return matrix((one_(one, rules) for one in flat(value)), *size_of(value))

    def one_(one: SymbolicScalar, rules: IntegerRules) -> SymbolicScalar:
        kind = "double" if one.kind == LOGICAL else one.kind
        made = change(as_number(one))
        return SymbolicScalar(kind, in_range(made, kind, rules) if kind in INTEGERS else made)

    return apply


def _magnitude(expr: Expr) -> Expr:
    low, high = least_and_greatest(expr)
    if low >= 0:
        return expr
    return negated(expr) if high <= 0 else folded(Apply(Op.ABS, (expr,), expr.sort))


def _sign(expr: Expr) -> Expr:
    return chosen(folded(expr > 0), const(1), chosen(folded(expr < 0), const(-1), const(0)))


def _root(expr: Expr) -> Expr:
    if isinstance(expr, Const) and isinstance(expr.sort, Num):
        value = expr.value * expr.sort.resolution
        if value >= 0:
            up, down = isqrt(value.numerator), isqrt(value.denominator)
            if up * up == value.numerator and down * down == value.denominator:
                return const(up) / down
    raise NotLowered("a square root: compare squares in its place")


def _two(join: Callable[[Expr, Expr], Expr]) -> Builtin:
    """A function of two numbers, in the type that an operator between them would have."""

    def apply(arguments: Arguments, rules: IntegerRules, kinds: KindTable) -> Symbolic:
        left, right = arguments
        rows, columns = size_of(left if size_of(left) != (1, 1) else right)
        count = rows * columns
        lefts, rights = ((tuple(flat(one)) * count)[:count] for one in (left, right))
        return matrix((one_(*pair, rules) for pair in zip(lefts, rights, strict=True)), rows, columns)

    def one_(left: SymbolicScalar, right: SymbolicScalar, rules: IntegerRules) -> SymbolicScalar:
        kind = kind_of_both("+", left, right, rules)
        made = join(as_number(left), as_number(right))
        return SymbolicScalar(kind, in_range(made, kind, rules) if kind in INTEGERS else made)

    return apply


def least(one: Expr, other: Expr) -> Expr:
    """The lesser of two numbers."""
    return _extreme_of(one, other, Op.MIN)


def greatest(one: Expr, other: Expr) -> Expr:
    """The greater of two numbers."""
    return _extreme_of(one, other, Op.MAX)


def _extreme_of(one: Expr, other: Expr, op: Op) -> Expr:
    (low, high), (least_, most) = least_and_greatest(one), least_and_greatest(other)
    if high <= least_:
        return one if op is Op.MIN else other
    if most <= low:
        return other if op is Op.MIN else one
    (left, right), sort = aligned(op.value, one, other)
    return folded(Apply(op, (left, right), sort))


def _extreme(join: Callable[[Expr, Expr], Expr]) -> Builtin:
    pair = _two(join)

    def apply(arguments: Arguments, rules: IntegerRules, kinds: KindTable) -> Symbolic:
        if len(arguments) == 2:
            return pair(arguments, rules, kinds)
        every = flat(arguments[0])
        if not every:
            raise NotLowered("the least or greatest of no values")
        return reduce(lambda sofar, one: single_of(pair([sofar, one], rules, kinds)), every[1:], every[0])

    return apply


def _bitwise(sign: str) -> Builtin:
    return lambda arguments, rules, kinds: binary(sign, arguments[0], arguments[1], rules)


def _shift(arguments: Arguments, rules: IntegerRules, kinds: KindTable) -> Symbolic:
    value, by = map(single_of, arguments)
    return SymbolicScalar(value.kind, shifted(as_number(value), as_number(by), value.kind))


def _get_bit(arguments: Arguments, rules: IntegerRules, kinds: KindTable) -> Symbolic:
    value, place = map(single_of, arguments)

    def at(number_: Fraction) -> Expr:
        return chosen(bit_of(as_number(value), _whole(number_) - 1), const(1), const(0))

    return SymbolicScalar(value.kind, by_cases(as_number(place), at))


def _whole(value: Fraction) -> int:
    """The number of a bit.  Raises ``ValueError`` where it is not whole."""
    if value.denominator != 1:
        raise ValueError(f"{value} is not whole")
    return value.numerator


def _set_bit(arguments: Arguments, rules: IntegerRules, kinds: KindTable) -> Symbolic:
    value, place, *to = map(single_of, arguments)
    on, expr = as_condition(to[0]) if to else TRUE, as_number(value)

    def at(number_: Fraction) -> Expr:
        bit = _whole(number_) - 1
        weight, now = 2**bit, bit_of(expr, bit)
        added = chosen(folded(all_of(on, ~now)), const(weight), const(0))
        taken = chosen(folded(all_of(~on, now)), const(-weight), const(0))
        return sum_of(expr, sum_of(added, taken))

    return SymbolicScalar(value.kind, by_cases(as_number(place), at))


def _complement(arguments: Arguments, rules: IntegerRules, kinds: KindTable) -> Symbolic:
    return complement(single_of(arguments[0]))


def real_of(value: Symbolic) -> Sequence[SymbolicScalar]:
    """What sums and products are made of: real numbers stay as they are, others are double."""
    return [one if one.kind in REALS else SymbolicScalar("double", as_number(one)) for one in flat(value)]


def _sum(arguments: Arguments, rules: IntegerRules, kinds: KindTable) -> Symbolic:
    every = real_of(arguments[0])
    first = scalar_of("+", every[0], number("double", 0), rules) if every else number("double", 0)
    return reduce(lambda sofar, one: scalar_of("+", sofar, one, rules), every[1:], first)


def _product(arguments: Arguments, rules: IntegerRules, kinds: KindTable) -> Symbolic:
    return reduce(
        lambda sofar, one: scalar_of("*", sofar, one, rules), real_of(arguments[0]), number("double", 1)
    )


def _filled(value: int) -> Builtin:
    def apply(arguments: Arguments, rules: IntegerRules, kinds: KindTable) -> Symbolic:
        given = [one.constant for argument in arguments for one in flat(argument)]
        if any(one is None for one in given):
            raise NotLowered("a matrix whose size is no constant")
        found = [int(one) for one in given if one is not None]
        rows, columns = (found * 2)[:2] if len(found) == 1 else (found or [1, 1])[:2]
        if not 0 < rows * columns <= MOST_FILLED:
            raise NotLowered(f"a matrix of {rows}x{columns}")
        return matrix([number("double", value)] * (rows * columns), rows, columns)

    return apply


def _equal(arguments: Arguments, rules: IntegerRules, kinds: KindTable) -> Symbolic:
    first, *others = arguments
    if any(size_of(one) != size_of(first) for one in others):
        return truth(FALSE)
    pairs = (pair for one in others for pair in zip(flat(first), flat(one), strict=True))
    return truth(folded(all_of(*(scalar_of("==", a, b, rules).expr for a, b in pairs))))


def _count(of: Callable[[Symbolic], int]) -> Builtin:
    return lambda arguments, rules, kinds: number("double", of(arguments[0]))


def _truths(join: Callable[..., Expr]) -> Builtin:
    return lambda arguments, rules, kinds: truth(folded(join(*map(as_condition, flat(arguments[0])))))


def _conversion(kind: str) -> Builtin:
    return lambda arguments, rules, kinds: each_converted(arguments[0], kind, rules, kinds)


def _never(arguments: Arguments, rules: IntegerRules, kinds: KindTable) -> Symbolic:
    every = [truth(FALSE) for _ in flat(arguments[0])]
    return matrix(every, *size_of(arguments[0]))


BUILTINS: Mapping[str, Builtin] = {
    **{kind: _conversion(kind) for kind in (*INTEGERS, *REALS, LOGICAL)},
    "boolean": _conversion(LOGICAL),
    "abs": _each(_magnitude), "floor": _each(floor_of), "ceil": _each(ceiling_of),
    "round": _each(nearest_of), "fix": _each(toward_zero), "sign": _each(_sign), "sqrt": _each(_root),
    "mod": _two(modulo), "rem": _two(remainder), "min": _extreme(least), "max": _extreme(greatest),
    "bitand": _bitwise("bit&"), "bitor": _bitwise("bit|"), "bitxor": _bitwise("bit^"),
    "bitshift": _shift, "bitcmp": _complement, "bitget": _get_bit, "bitset": _set_bit,
    "sum": _sum, "prod": _product, "any": _truths(any_of), "all": _truths(all_of),
    "zeros": _filled(0), "ones": _filled(1), "isequal": _equal,
    "numel": _count(lambda value: len(flat(value))),
    "length": _count(lambda value: max(size_of(value)) if flat(value) else 0),
    "isempty": lambda arguments, rules, kinds: truth(const(not flat(arguments[0]))),
    "isnan": _never, "isinf": _never,
}  # fmt: skip
"""By name; conversions are functions of their types' names."""
NOTHING = frozenset({"fprintf", "disp", "printf", "coder.inline", "coder.extrinsic", "assert"})
"""Calls that do nothing to a chart."""

__all__ = ["BUILTINS", "NOTHING", "greatest", "least"]
