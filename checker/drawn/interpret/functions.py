"""MATLAB's functions of numbers, as far as charts use them."""

from collections.abc import Callable, Mapping, Sequence
from math import ceil, floor, fmod, inf, isfinite, isinf, isnan, nan, sqrt, trunc

from rovercheck.checker.drawn.faults import DrawnFault
from rovercheck.checker.drawn.interpret.operations import BITS, binary
from rovercheck.checker.drawn.interpret.values import (
    FLOATS,
    TYPES,
    WHOLE,
    ArrayOf,
    MatlabValue,
    NumberRules,
    Scalar,
    array,
    converted,
    double,
    each_converted,
    in_range,
    logical,
    nearest,
    scalar,
    scalars,
    shape,
    single,
)

Arguments = Sequence[MatlabValue]
Builtin = Callable[[Arguments, NumberRules], MatlabValue]


def _each(change: Callable[[float], float]) -> Builtin:
    """A function of one number, which whole numbers keep their type in."""

    def apply(arguments: Arguments, rules: NumberRules) -> MatlabValue:
        [value] = arguments
        made = [_of_one(change, one, rules) for one in scalars(value)]
        return array(made, *shape(value)) if isinstance(value, ArrayOf) else made[0]

    return apply


def _of_one(change: Callable[[float], float], one: Scalar, rules: NumberRules) -> Scalar:
    kind = "double" if one.kind == "logical" else one.kind
    found = change(one.value)
    if kind in WHOLE:
        return Scalar(kind, in_range(int(found), kind, rules.saturates))
    return Scalar(kind, single(found) if kind == "single" else float(found))


def _plain(change: Callable[[float], int]) -> Callable[[float], float]:
    """What has no meaning for infinities and NaN leaves them."""
    return lambda value: change(value) if isfinite(value) else value


def _two(change: Callable[[float, float], float]) -> Builtin:
    """A function of two numbers, of which one may be a scalar: in the type of their sum."""

    def apply(arguments: Arguments, rules: NumberRules) -> MatlabValue:
        left, right = arguments
        kinds = binary("+", left, right, NumberRules(rules.c, True))
        size = max(len(scalars(left)), len(scalars(right)))
        lefts, rights = (tuple(scalars(one)) * (size if len(scalars(one)) == 1 else 1) for one in arguments)
        pairs = zip(lefts, rights, scalars(kinds), strict=True)
        made = [converted(_exact(change(a.value, b.value)), k.kind, rules) for a, b, k in pairs]
        return array(made, *shape(kinds)) if isinstance(kinds, ArrayOf) else made[0]

    return apply


def _exact(value: float) -> Scalar:
    return Scalar("literal", value) if isinstance(value, int) else double(value)


def _modulo(left: float, right: float) -> float:
    if right == 0:
        return left
    if isinstance(left, int) and isinstance(right, int):
        return left % right
    if isinf(right) and isfinite(left):
        return left if left == 0 or (left < 0) == (right < 0) else right
    return nan if isnan(right) or not isfinite(left) else left - floor(left / right) * right


def _remainder(left: float, right: float) -> float:
    if isinstance(left, int) and isinstance(right, int) and right:
        return abs(left) % abs(right) * (-1 if left < 0 else 1)
    return nan if right == 0 or not isfinite(left) else fmod(left, right)


def _extreme(better: Callable[[float, float], bool]) -> Builtin:
    """The least or the greatest, of one matrix or of two values; NaN only where there is nothing else."""

    def of_two(left: float, right: float) -> float:
        if isnan(left):
            return right
        return left if isnan(right) or better(left, right) else right

    def apply(arguments: Arguments, rules: NumberRules) -> MatlabValue:
        if len(arguments) == 2:
            return _two(of_two)(arguments, rules)
        first, *rest = scalars(arguments[0])
        found = first
        for one in rest:
            found = found if of_two(found.value, one.value) == found.value else one
        return found

    return apply


def _bitwise(sign: str) -> Builtin:
    def apply(arguments: Arguments, rules: NumberRules) -> MatlabValue:
        left, right = map(scalar, arguments[:2])
        kind = left.kind if left.kind in WHOLE else right.kind if right.kind in WHOLE else "double"
        one, other = (int(v.value) for v in (left, right))
        if min(one, other) < 0 and kind not in WHOLE:
            raise DrawnFault(f"bits of {min(one, other)}: give an integer type, as in uint8(x)")
        return Scalar(kind, BITS[sign](one, other) if kind in WHOLE else float(BITS[sign](one, other)))

    return apply


def _shift(arguments: Arguments, rules: NumberRules) -> MatlabValue:
    value, by = map(scalar, arguments[:2])
    steps = int(by.value)
    moved = int(value.value) << min(steps, 64) if steps >= 0 else int(value.value) >> min(-steps, 64)
    if value.kind not in WHOLE:
        return double(moved)
    return Scalar(value.kind, in_range(moved, value.kind, saturates=False))


def _complement(arguments: Arguments, rules: NumberRules) -> MatlabValue:
    value = scalar(arguments[0])
    if value.kind not in WHOLE:
        raise DrawnFault("bitcmp of a number without an integer type: write bitcmp(uint8(x))")
    return Scalar(value.kind, in_range(~int(value.value), value.kind, saturates=False))


def _get_bit(arguments: Arguments, rules: NumberRules) -> MatlabValue:
    value, place = map(scalar, arguments)
    return converted(Scalar("literal", int(value.value) >> (int(place.value) - 1) & 1), value.kind, rules)


def _set_bit(arguments: Arguments, rules: NumberRules) -> MatlabValue:
    value, place, *to = map(scalar, arguments)
    bit = 1 << (int(place.value) - 1)
    on = not to or to[0].truth
    changed = int(value.value) | bit if on else int(value.value) & ~bit
    return Scalar(value.kind, changed if value.kind in WHOLE else float(changed))


def real_of(value: MatlabValue) -> MatlabValue:
    """What sums and products are made of: real numbers stay as they are, others are double."""
    return value if value.kind in FLOATS else each_converted(value, "double", NumberRules())


def _sum(arguments: Arguments, rules: NumberRules) -> MatlabValue:
    found: MatlabValue = double(0)
    for number, one in enumerate(scalars(real_of(arguments[0]))):
        found = binary("+", found, one, rules) if number else binary("+", one, double(0), rules)
    return found


def _filled(value: float) -> Builtin:
    def apply(arguments: Arguments, rules: NumberRules) -> MatlabValue:
        sizes = [int(one.value) for argument in arguments for one in scalars(argument)]
        rows, columns = (sizes * 2)[:2] if len(sizes) == 1 else (sizes or [1, 1])[:2]
        if not 0 <= rows * columns <= MOST_VALUES:
            raise DrawnFault(f"a matrix of {rows}x{columns} is too large")
        return array([double(value)] * (rows * columns), rows, columns)

    return apply


MOST_VALUES = 1_000_000


def _equal(arguments: Arguments, rules: NumberRules) -> MatlabValue:
    first, *others = arguments
    same = (
        shape(one) == shape(first)
        and all(a.value == b.value for a, b in zip(scalars(one), scalars(first), strict=True))
        for one in others
    )
    return logical(all(same))


def _number(count: Callable[[MatlabValue], float]) -> Builtin:
    return lambda arguments, rules: double(count(arguments[0]))


def _truths(joined: Callable[[Sequence[bool]], bool]) -> Builtin:
    return lambda arguments, rules: logical(joined([one.truth for one in scalars(arguments[0])]))


def _conversion(kind: str) -> Builtin:
    return lambda arguments, rules: each_converted(arguments[0], kind, rules)


def _constant(value: Scalar) -> Builtin:
    return lambda arguments, rules: value


BUILTINS: Mapping[str, Builtin] = {
    **{kind: _conversion(kind) for kind in TYPES},
    "boolean": _conversion("logical"),
    "inf": _constant(double(inf)), "Inf": _constant(double(inf)),
    "nan": _constant(double(nan)), "NaN": _constant(double(nan)),
    "abs": _each(abs), "floor": _each(_plain(floor)), "ceil": _each(_plain(ceil)),
    "round": _each(_plain(nearest)), "fix": _each(_plain(trunc)),
    "sign": _each(lambda value: value if isnan(value) else (value > 0) - (value < 0)),
    "sqrt": _each(lambda value: sqrt(value) if value >= 0 else nan),
    "mod": _two(_modulo), "rem": _two(_remainder),
    "min": _extreme(lambda a, b: a <= b), "max": _extreme(lambda a, b: a >= b),
    "bitand": _bitwise("bit&"), "bitor": _bitwise("bit|"), "bitxor": _bitwise("bit^"),
    "bitshift": _shift, "bitcmp": _complement, "bitget": _get_bit, "bitset": _set_bit,
    "sum": _sum, "any": _truths(any), "all": _truths(all),
    "zeros": _filled(0), "ones": _filled(1), "isequal": _equal,
    "numel": _number(lambda value: len(scalars(value))),
    "length": _number(lambda value: max(shape(value)) if len(scalars(value)) else 0),
    "isempty": lambda arguments, rules: logical(not scalars(arguments[0])),
    "isnan": _each(lambda value: float(isnan(value))),
}  # fmt: skip
"""By name; conversions are functions of their types' names."""
WITHOUT_EFFECT = frozenset({"fprintf", "disp", "printf", "coder.inline", "coder.extrinsic", "assert"})
"""Calls that do nothing to a chart."""

__all__ = ["BUILTINS", "WITHOUT_EFFECT", "Builtin"]
