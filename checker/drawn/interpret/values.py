"""Numbers, members and structures as MATLAB and Simulink have them, and conversions between their types."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from math import copysign, inf, isinf, isnan, trunc
from struct import pack, unpack
from typing import TypeAlias, Union

from rovercheck.checker.drawn.faults import DrawnFault

WHOLE: Mapping[str, tuple[int, int]] = {
    f"{sign}int{bits}": (0, 2**bits - 1) if sign else (-(2 ** (bits - 1)), 2 ** (bits - 1) - 1)
    for bits in (8, 16, 32, 64)
    for sign in ("", "u")
}
"""The integer types, with the least and the greatest value of each."""
FLOATS = ("double", "single")
LITERAL = "literal"
"""A whole number in a text of C, which takes the type of what it is computed with."""
TYPES = (*WHOLE, *FLOATS, "logical")


@dataclass(frozen=True, slots=True)
class NumberRules:
    """Whether a text is of C, and whether integers stop at their ends; else they wrap."""

    c: bool = False
    saturates: bool = True


@dataclass(frozen=True, slots=True)
class Scalar:
    """One value: ``kind`` is a type of numbers, ``logical``, ``literal``, or ``Enum: NAME``."""

    kind: str
    value: int | float

    @property
    def whole(self) -> bool:
        """Whether it is of an integer type."""
        return self.kind in WHOLE or self.kind == LITERAL

    @property
    def truth(self) -> bool:
        """As a condition: anything but 0."""
        if isnan(self.value):
            raise DrawnFault("NaN is no condition: it is neither true nor false")
        return self.value != 0


@dataclass(frozen=True, slots=True)
class ArrayOf:
    """A matrix of scalars of one kind, row by row."""

    kind: str
    rows: int
    columns: int
    values: tuple[Scalar, ...]

    @property
    def truth(self) -> bool:
        """As a condition: all of it, if there is anything."""
        return bool(self.values) and all(one.truth for one in self.values)


@dataclass(frozen=True, slots=True)
class Structure:
    """A value of a bus, or ``struct`` where a script makes one: its elements by name."""

    kind: str
    elements: Mapping[str, "MatlabValue"] = field(default_factory=dict)


MatlabValue: TypeAlias = Union[Scalar, ArrayOf, Structure]

TRUE, FALSE = Scalar("logical", 1), Scalar("logical", 0)


def logical(value: bool) -> Scalar:
    """A truth value."""
    return TRUE if value else FALSE


def double(value: float) -> Scalar:
    """A real number."""
    return Scalar("double", float(value))


def scalars(value: MatlabValue) -> Sequence[Scalar]:
    """The scalars of a value.  Raises ``DrawnFault`` for a structure."""
    match value:
        case Scalar():
            return (value,)
        case ArrayOf():
            return value.values
    raise DrawnFault("a structure is no number: name one of its elements")


def scalar(value: MatlabValue) -> Scalar:
    """A value that is one number.  Raises ``DrawnFault``."""
    found = scalars(value)
    if len(found) != 1:
        raise DrawnFault(f"{len(found)} values stand where one must")
    return found[0]


def array(values: Iterable[Scalar], rows: int, columns: int, kind: str = "double") -> MatlabValue:
    """A matrix; one of a single value is a scalar."""
    made = tuple(values)
    if rows == columns == 1:
        return made[0]
    return ArrayOf(made[0].kind if made else kind, rows, columns, made)


def shape(value: MatlabValue) -> tuple[int, int]:
    """Rows and columns."""
    return (value.rows, value.columns) if isinstance(value, ArrayOf) else (1, 1)


def in_range(value: int, kind: str, saturates: bool) -> int:
    """A whole number in an integer type."""
    low, high = WHOLE[kind]
    if saturates:
        return min(max(value, low), high)
    return (value - low) % (high - low + 1) + low


def nearest(value: float) -> int:
    """The nearest whole number, of two the one that is farther from 0."""
    below = trunc(value)
    return below + (1 if value > 0 else -1) * (abs(value - below) >= 0.5)


def single(value: float) -> float:
    """The number in single precision."""
    try:
        [found] = unpack("f", pack("f", value))
    except OverflowError:
        return copysign(inf, value)
    return float(found)


def converted(value: Scalar, kind: str, rules: NumberRules) -> Scalar:
    """A scalar in another type: rounded, and in its range.  Raises ``DrawnFault``."""
    if value.kind == kind:
        return value
    number = value.value
    if kind in WHOLE:
        return Scalar(kind, _whole(number, kind, rules))
    if kind == "double":
        return Scalar(kind, float(number))
    if kind == "single":
        return Scalar(kind, single(float(number)))
    if kind == "logical":
        return logical(value.truth)
    if kind == LITERAL or kind.startswith("Enum:"):
        if isinstance(number, float) and not number.is_integer():
            raise DrawnFault(f"{number:g} is no member of {kind.removeprefix('Enum:').strip()}")
        return Scalar(kind, int(number))
    raise DrawnFault(f"the type {kind!r} is not known")


def _whole(number: float, kind: str, rules: NumberRules) -> int:
    if isinstance(number, float):
        if isnan(number):
            return 0
        if isinf(number):
            return WHOLE[kind][number > 0]
        number = trunc(number) if rules.c else nearest(number)
    return in_range(int(number), kind, rules.saturates)


def each_converted(value: MatlabValue, kind: str, rules: NumberRules) -> MatlabValue:
    """All scalars of a value in another type; of a structure none."""
    match value:
        case Scalar():
            return converted(value, kind, rules)
        case ArrayOf(_, rows, columns, values):
            return ArrayOf(kind, rows, columns, tuple(converted(one, kind, rules) for one in values))
    return value


__all__ = [
    "FALSE", "LITERAL", "TRUE", "TYPES", "WHOLE", "ArrayOf", "MatlabValue",
    "NumberRules", "Scalar", "Structure", "array", "converted", "double", "each_converted", "in_range",
    "logical", "nearest", "scalar", "scalars", "shape", "single",
]  # fmt: skip
