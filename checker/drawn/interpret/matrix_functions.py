"""Further functions of MATLAB and C: operators by their names, sizes, sums along vectors, limits of types."""

from collections.abc import Callable, Mapping, Sequence
from functools import reduce
from math import fmod, inf, isfinite, isinf, ldexp, pi, pow

from rovercheck.checker.drawn.faults import DrawnFault
from rovercheck.checker.drawn.interpret.functions import BUILTINS, Builtin, real_of
from rovercheck.checker.drawn.interpret.operations import binary, unary
from rovercheck.checker.drawn.interpret.values import (
    FALSE,
    FLOATS,
    LITERAL,
    TRUE,
    WHOLE,
    ArrayOf,
    MatlabValue,
    NumberRules,
    Scalar,
    array,
    converted,
    double,
    each_converted,
    logical,
    scalar,
    scalars,
    shape,
)

Arguments = Sequence[MatlabValue]
SIGNS: Mapping[str, str] = {
    "plus": "+", "minus": "-", "times": ".*", "mtimes": "*", "rdivide": "./", "mrdivide": "/", "power": ".^",
    "mpower": "^", "eq": "==", "ne": "!=", "lt": "<", "le": "<=", "gt": ">", "ge": ">=", "and": "&",
    "or": "|",
}  # fmt: skip
"""Operators by the names of their functions."""


def _operator(sign: str) -> Builtin:
    def apply(arguments: Arguments, rules: NumberRules) -> MatlabValue:
        left, right = arguments
        return binary(sign, left, right, rules)

    return apply


def _before(sign: str) -> Builtin:
    return lambda arguments, rules: unary(sign, arguments[0], rules)


def _unlike(arguments: Arguments, rules: NumberRules) -> MatlabValue:
    left, right = (unary("!", one, rules) for one in arguments)
    return binary("!=", left, right, rules)


def _of_c(change: Callable[[float, float], float]) -> Builtin:
    """A function of C's library, which computes with real numbers."""

    def apply(arguments: Arguments, rules: NumberRules) -> MatlabValue:
        left, right = (float(scalar(one).value) for one in arguments)
        try:
            return double(change(left, right))
        except OverflowError:
            return double(inf)
        except ValueError as error:
            raise DrawnFault(f"{left:g} and {right:g} give no real number") from error

    return apply


def _power(base: float, exponent: float) -> float:
    return inf if base == 0 and exponent < 0 else pow(base, exponent)


def _remainder(left: float, right: float) -> float:
    if not right or isinf(left):
        raise DrawnFault("the remainder of a division by 0")
    return fmod(left, right)


def _integer_quotient(arguments: Arguments, rules: NumberRules) -> MatlabValue:
    """``idivide``, which cuts towards 0."""
    left, right = map(scalar, arguments)
    kind = binary("+", left, right, rules).kind
    if kind not in WHOLE:
        raise DrawnFault("idivide divides integers: convert one of them, as in int32(x)")
    if not right.value:
        return binary("/", left, right, NumberRules(False, rules.saturates))
    cut = abs(int(left.value)) // abs(int(right.value))
    return converted(Scalar("literal", cut if (left.value < 0) == (right.value < 0) else -cut), kind, rules)


def _size(arguments: Arguments, rules: NumberRules) -> MatlabValue:
    rows, columns = shape(arguments[0])
    if len(arguments) == 1:
        return array([double(rows), double(columns)], 1, 2)
    along = int(scalar(arguments[1]).value)
    return double({1: rows, 2: columns}.get(along, 1))


def _product(arguments: Arguments, rules: NumberRules) -> MatlabValue:
    found: MatlabValue = double(1)
    for one in scalars(real_of(arguments[0])):
        found = binary("*", found, one, rules)
    return found


def _mean(arguments: Arguments, rules: NumberRules) -> MatlabValue:
    total = BUILTINS["sum"](arguments, rules)
    return binary("/", total, double(len(scalars(arguments[0]))), rules)


def _running_sum(arguments: Arguments, rules: NumberRules) -> MatlabValue:
    [value] = arguments
    if min(shape(value)) > 1:
        raise DrawnFault("cumsum of a matrix: take its rows one by one")
    made = list(scalars(value)[:1])
    for one in scalars(value)[1:]:
        made.append(scalar(binary("+", made[-1], one, rules)))
    return array(made, *shape(value))


def _scalar_product(arguments: Arguments, rules: NumberRules) -> MatlabValue:
    left, right = (scalars(one) for one in arguments)
    if len(left) != len(right):
        raise DrawnFault(f"dot of vectors with {len(left)} and {len(right)} elements")
    first, *others = (binary("*", one, other, rules) for one, other in zip(left, right, strict=True))
    return reduce(lambda sofar, one: binary("+", sofar, one, rules), others, first)


def _flipped(rows: bool, columns: bool) -> Builtin:
    def apply(arguments: Arguments, rules: NumberRules) -> MatlabValue:
        value = arguments[0]
        down, across = shape(value)
        lines = [list(scalars(value)[n * across : (n + 1) * across]) for n in range(down)]
        lines = lines[::-1] if rows else lines
        return array((one for line in lines for one in (line[::-1] if columns else line)), down, across)

    return apply


def _flip(arguments: Arguments, rules: NumberRules) -> MatlabValue:
    row = shape(arguments[0])[0] == 1
    return _flipped(not row, row)(arguments, rules)


def _shifted(arguments: Arguments, rules: NumberRules) -> MatlabValue:
    """``circshift`` of a vector."""
    every, steps = list(scalars(arguments[0])), scalars(arguments[1])
    by = steps[-1 if shape(arguments[0])[0] == 1 else 0].value
    if min(shape(arguments[0])) > 1:
        raise DrawnFault("circshift is known of a vector, by a constant")
    at = -int(by) % len(every)
    return array(every[at:] + every[:at], *shape(arguments[0]))


def _is_member(arguments: Arguments, rules: NumberRules) -> MatlabValue:
    value, among = arguments
    every = {one.value for one in scalars(among)}
    return array((logical(one.value in every) for one in scalars(value)), *shape(value))


def _repeated(arguments: Arguments, rules: NumberRules) -> MatlabValue:
    """``repmat``: a matrix beside and below itself."""
    value, *sizes = arguments
    times = [int(one.value) for size in sizes for one in scalars(size)]
    down, across = (times * 2)[:2]
    rows, columns = shape(value)
    lines = [scalars(value)[at * columns : (at + 1) * columns] for at in range(rows)]
    made = [one for _ in range(down) for line in lines for _ in range(across) for one in line]
    return array(made, rows * down, columns * across, value.kind)


def _unit_matrix(arguments: Arguments, rules: NumberRules) -> MatlabValue:
    sizes = [int(one.value) for argument in arguments for one in scalars(argument)] or [1]
    rows, columns = (sizes * 2)[:2]
    return array((double(r == c) for r in range(rows) for c in range(columns)), rows, columns)


def _all_of(value: Scalar) -> Builtin:
    """``true`` and ``false``, perhaps as a matrix."""

    def apply(arguments: Arguments, rules: NumberRules) -> MatlabValue:
        if not arguments:
            return value
        made = BUILTINS["zeros"](arguments, rules)
        return array((value for _ in scalars(made)), *shape(made), value.kind)

    return apply


def reduced(name: str, arguments: Arguments, rules: NumberRules) -> MatlabValue | None:
    """A function of ``REDUCTIONS`` along the columns of a matrix, or along the dimension that is given.

    ``None`` where it has nothing to go along, as of two values the greater.
    """
    value, *more = arguments
    if name in EXTREMES and len(more) == 2 and not scalars(more[0]):
        more = more[1:]
    elif name in EXTREMES and more:
        return None
    rows, columns = shape(value)
    along = int(scalar(more[0]).value) if more else 2 if rows == 1 else 1
    every = scalars(value)
    if not every or along not in (1, 2):
        return None
    lines = [every[at::columns] for at in range(columns)]
    if along == 2:
        lines = [every[at * columns : (at + 1) * columns] for at in range(rows)]
    function = BUILTINS.get(name) or FURTHER[name]
    made = [scalar(function([array(line, 1, len(line))], rules)) for line in lines]
    return array(made, 1, columns) if along == 1 else array(made, rows, 1)


def sorted_values(value: MatlabValue, descends: bool) -> MatlabValue:
    """``sort`` of a vector."""
    if min(shape(value)) > 1:
        raise DrawnFault("sort of a matrix: take its rows one by one")
    made = sorted(scalars(value), key=lambda one: one.value, reverse=descends)
    return array(made, *shape(value))


def joined(rows: Sequence[Sequence[MatlabValue]], rules: NumberRules) -> MatlabValue:
    """Matrices beside each other and below each other, as in ``[a b; c]``; those without a value are none."""
    lines: list[list[Scalar]] = []
    for row in rows:
        blocks = [one for one in row if scalars(one)]
        heights = {shape(one)[0] for one in blocks}
        if len(heights) > 1:
            raise DrawnFault("matrices that stand beside each other have not as many rows")
        for at in range(max(heights, default=0)):
            wide = ((one, shape(one)[1]) for one in blocks)
            lines.append(
                [v for one, columns in wide for v in scalars(one)[at * columns : (at + 1) * columns]]
            )
    width = len(lines[0]) if lines else 0
    if any(len(line) != width for line in lines):
        raise DrawnFault("the rows of a matrix are not as long as each other")
    kind = kind_together([one.kind for line in lines for one in line])
    values = ArrayOf(kind, len(lines), width, tuple(one for line in lines for one in line))
    found = each_converted(values, kind, rules) if lines else values
    assert isinstance(found, ArrayOf)
    return array(found.values, found.rows, found.columns)


def kind_together(kinds: Sequence[str]) -> str:
    """The type of a matrix of these: the first of integers or members, else single, double, logical."""
    found = [one for one in kinds if one not in (*FLOATS, "logical", LITERAL)]
    weaker = (one for one in ("single", "double", LITERAL, "logical") if one in kinds)
    return found[0] if found else next(weaker, "double")


def _each_is(asked: Callable[[float], bool]) -> Builtin:
    return lambda arguments, rules: array(
        (logical(asked(one.value)) for one in scalars(arguments[0])), *shape(arguments[0])
    )


FURTHER: Mapping[str, Builtin] = {
    **{name: _operator(sign) for name, sign in SIGNS.items()},
    "not": _before("!"), "uminus": _before("-"), "uplus": _before("+"), "xor": _unlike,
    "idivide": _integer_quotient, "size": _size, "prod": _product, "mean": _mean, "cumsum": _running_sum,
    "dot": _scalar_product, "flip": _flip, "fliplr": _flipped(False, True), "flipud": _flipped(True, False),
    "ismember": _is_member, "circshift": _shifted, "isinf": _each_is(isinf), "isfinite": _each_is(isfinite),
    "nnz": lambda arguments, rules: double(sum(one.value != 0 for one in scalars(arguments[0]))),
    "isscalar": lambda arguments, rules: logical(shape(arguments[0]) == (1, 1)),
    "pi": lambda arguments, rules: double(pi), "eps": lambda arguments, rules: double(2**-52),
    "repmat": _repeated, "eye": _unit_matrix, "true": _all_of(TRUE), "false": _all_of(FALSE),
    "deal": lambda arguments, rules: arguments[0],
    "fabs": lambda arguments, rules: double(abs(scalar(arguments[0]).value)), "labs": BUILTINS["abs"],
    "fmod": _of_c(_remainder), "pow": _of_c(_power),
    "ldexp": _of_c(lambda value, bits: ldexp(value, int(bits))),
}  # fmt: skip
"""By name."""


def place_of_extreme(name: str, value: MatlabValue) -> MatlabValue:
    """The second result of ``min`` and ``max``: where the first of the values is that they give."""
    every = [one.value for one in scalars(value)]
    return double(every.index(min(every) if name == "min" else max(every)) + 1)


def limit_of(name: str, kind: str) -> MatlabValue:
    """``intmax`` and ``intmin`` of an integer type."""
    if kind not in WHOLE:
        raise DrawnFault(f"{name} of {kind!r}, which is no type of integers")
    return Scalar(kind, WHOLE[kind][name == "intmax"])


CODER_VALUES = ("const", "nullcopy", "ignoreConst")
"""Functions of ``coder`` that give their argument."""
CODER_WORDS = ("inline", "extrinsic", "varsize", "unroll", "allowpcode", "cinclude", "updateBuildInfo")
"""Functions of ``coder`` without an effect."""
TYPED = ("cast", "isa", "intmax", "intmin")
"""Functions that ask for, or make, a type."""
EXTREMES = ("min", "max")
"""Functions with two results."""
REDUCTIONS = ("sum", "prod", "mean", "min", "max", "any", "all")
"""Functions that make one value of many."""

__all__ = [
    "CODER_VALUES", "CODER_WORDS", "EXTREMES", "FURTHER", "REDUCTIONS", "TYPED", "joined", "limit_of",
    "place_of_extreme", "reduced",
    "sorted_values",
]  # fmt: skip
