"""Further functions of MATLAB and C as formulas: operators by their names, sizes, sums along vectors."""

from collections.abc import Mapping
from fractions import Fraction
from functools import reduce
from math import pi

from rovercheck.checker.drawn.lower.arithmetic import binary, kind_of_both, scalar_of, unary
from rovercheck.checker.drawn.lower.builtins import BUILTINS, Arguments, Builtin, greatest, least
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
from rovercheck.spec_model.lang.domain import Num
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
    kind = kind_of_both("+", left, right, rules)
    if kind not in INTEGERS:
        raise NotLowered("idivide divides integers: convert one of them, as in int32(x)")
    one = as_number(left)

    def by(divisor: Fraction) -> Expr:
        if divisor:
            return toward_zero(folded(one / divisor))
        low, high = INTEGERS[kind]
        return chosen(folded(one > 0), const(high), chosen(folded(one < 0), const(low), const(0)))

    return SymbolicScalar(kind, in_range(by_cases(as_number(right), by), kind, rules))


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
    every, steps = flat(arguments[0]), flat(arguments[1])
    by = steps[-1 if size_of(arguments[0])[0] == 1 else 0].constant
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


def _repeated(arguments: Arguments, rules: IntegerRules, kinds: KindTable) -> Symbolic:
    """``repmat``: a matrix beside and below itself."""
    times = _constants(arguments[1:], "repmat")
    down, across = (times * 2)[:2]
    rows, columns = size_of(arguments[0])
    every = flat(arguments[0])
    line = [every[at * columns : (at + 1) * columns] for at in range(rows)]
    made = [one for _ in range(down) for row in line for _ in range(across) for one in row]
    return matrix(made, rows * down, columns * across)


def _constants(arguments: Arguments, name: str) -> list[int]:
    given = [one.constant for argument in arguments for one in flat(argument)]
    if any(one is None for one in given):
        raise NotLowered(f"{name} with a size that is no constant")
    return [int(one) for one in given if one is not None]


def _unit_matrix(arguments: Arguments, rules: IntegerRules, kinds: KindTable) -> Symbolic:
    rows, columns = ((_constants(arguments, "eye") or [1]) * 2)[:2]
    return matrix((number("double", r == c) for r in range(rows) for c in range(columns)), rows, columns)


def _all_of(value: bool) -> Builtin:
    """``true`` and ``false``, perhaps as a matrix."""

    def apply(arguments: Arguments, rules: IntegerRules, kinds: KindTable) -> Symbolic:
        if not arguments:
            return truth(const(value))
        made = BUILTINS["zeros"](arguments, rules, kinds)
        return matrix((truth(const(value)) for _ in flat(made)), *size_of(made))

    return apply


def reduced(name: str, arguments: Arguments, rules: IntegerRules, kinds: KindTable) -> Symbolic | None:
    """A function of ``REDUCTIONS`` along the columns of a matrix, or along the dimension that is given.

    ``None`` where the whole value is meant.
    """
    value, more = arguments[0], list(arguments[1:])
    if name in EXTREMES and more:
        if len(more) != 2 or flat(more[0]):
            return None
        del more[0]
    rows, columns = size_of(value)
    if not flat(value) or (not more and min(rows, columns) == 1):
        return None
    along = _constants(more, name)[0] if more else 1
    if along not in (1, 2):
        raise NotLowered(f"{name} along dimension {along}: matrices have two here")
    every = flat(value)
    if along == 1:
        lines = [every[at::columns] for at in range(columns)]
    else:
        lines = [every[at * columns : (at + 1) * columns] for at in range(rows)]
    function = BUILTINS.get(name) or FURTHER[name]
    made = [single_of(function([matrix(line, 1, len(line))], rules, kinds)) for line in lines]
    return matrix(made, 1, columns) if along == 1 else matrix(made, rows, 1)


def sorted_values(value: Symbolic, descends: bool) -> Symbolic:
    """``sort`` of a vector: neighbours change places until all are in order."""
    if min(size_of(value)) > 1:
        raise NotLowered("sort of a matrix: take its rows one by one")
    every = list(flat(value))
    if any(not isinstance(one.expr.sort, Num) for one in every):
        raise NotLowered("sort of what are no numbers: convert them, as in double(x)")
    for done in range(len(every)):
        for at in range(len(every) - 1 - done):
            one, other = every[at], every[at + 1]
            low = SymbolicScalar(one.kind, least(one.expr, other.expr))
            high = SymbolicScalar(one.kind, greatest(one.expr, other.expr))
            every[at : at + 2] = (high, low) if descends else (low, high)
    return matrix(every, *size_of(value))


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
    "repmat": _repeated, "eye": _unit_matrix, "true": _all_of(True), "false": _all_of(False),
    "deal": lambda arguments, rules, kinds: arguments[0],
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


CODER_VALUES = ("const", "nullcopy", "ignoreConst")
"""Functions of ``coder`` that give their argument."""
CODER_WORDS = ("inline", "extrinsic", "varsize", "unroll", "allowpcode", "cinclude", "updateBuildInfo")
"""Functions of ``coder`` without an effect."""
REDUCTIONS = ("sum", "prod", "mean", "min", "max", "any", "all")
"""Functions that make one value of many."""
TYPED = ("cast", "isa", "intmax", "intmin")
"""Functions that ask for, or make, a type."""
EXTREMES = ("min", "max")
"""Functions with two results."""

__all__ = [
    "CODER_VALUES", "CODER_WORDS", "EXTREMES", "FURTHER", "REDUCTIONS", "TYPED", "limit_of",
    "place_of_extreme", "reduced", "sorted_values",
]  # fmt: skip
