"""Values of which only the formulas are known: scalars of MATLAB's types, arrays, and structures of them."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import TypeAlias, Union

from rovercheck.spec_model.lang.domain import Bool, Num
from rovercheck.spec_model.lang.evaluate import operate
from rovercheck.spec_model.lang.expr import FALSE, TRUE, Apply, Const, Expr, const, ite
from rovercheck.spec_model.lang.lower.ranges import possible
from rovercheck.spec_model.lang.operators import Op

INTEGERS: Mapping[str, tuple[int, int]] = {
    "int8": (-(2**7), 2**7 - 1), "int16": (-(2**15), 2**15 - 1), "int32": (-(2**31), 2**31 - 1),
    "int64": (-(2**63), 2**63 - 1), "uint8": (0, 2**8 - 1), "uint16": (0, 2**16 - 1),
    "uint32": (0, 2**32 - 1), "uint64": (0, 2**64 - 1),
}  # fmt: skip
"""The least and the greatest value of each type of integers."""
REALS = ("double", "single")
LOGICAL, UNTYPED = "logical", "untyped"
"""Truth values; and whole numbers in a text of C, which take the type of what they are computed with."""
TWO_TYPES = "two types"
"""What a variable is of that has values of two types or sizes, depending on what was executed."""


class NotLowered(Exception):
    """What is drawn has a meaning that no finite formula has, or none here; it says what to draw instead."""


@dataclass(frozen=True)
class SymbolicScalar:
    """A number, a truth value or a member: ``kind`` is its type, ``Enum: NAME`` that of a member."""

    kind: str
    expr: Expr

    @property
    def constant(self) -> Fraction | None:
        """Its value, if that is the same in every step."""
        return constant_of(self.expr)


@dataclass(frozen=True)
class SymbolicArray:
    """A matrix of scalars of one kind, row by row."""

    kind: str
    rows: int
    columns: int
    values: tuple[SymbolicScalar, ...]


@dataclass(frozen=True)
class SymbolicStructure:
    """The elements of a bus, or of a structure that a script makes, ``struct``, by name."""

    kind: str
    elements: Mapping[str, "Symbolic"]


MADE = "struct"
"""The kind of structures that scripts make."""

Symbolic: TypeAlias = Union[SymbolicScalar, SymbolicArray, SymbolicStructure]


def constant_of(expr: Expr) -> Fraction | None:
    """The value of a formula that is a constant; a truth value is 1 or 0."""
    if not isinstance(expr, Const):
        return None
    return expr.value * expr.sort.resolution if isinstance(expr.sort, Num) else Fraction(expr.value)


def number(kind: str, value: Fraction | int) -> SymbolicScalar:
    """A constant of a type of numbers."""
    return SymbolicScalar(kind, const(Fraction(value)))


def truth(expr: Expr) -> SymbolicScalar:
    """A condition as a value."""
    return SymbolicScalar(LOGICAL, expr)


def flat(value: Symbolic) -> Sequence[SymbolicScalar]:
    """The scalars of a value.  Raises ``NotLowered`` for a structure."""
    match value:
        case SymbolicScalar():
            return (value,)
        case SymbolicArray():
            return value.values
    raise NotLowered("a structure stands where a number must: name one of its elements")


def single_of(value: Symbolic) -> SymbolicScalar:
    """A value that is one scalar.  Raises ``NotLowered``."""
    found = flat(value)
    if len(found) != 1:
        raise NotLowered(f"{len(found)} values stand where one must")
    return found[0]


def size_of(value: Symbolic) -> tuple[int, int]:
    """Rows and columns."""
    return (value.rows, value.columns) if isinstance(value, SymbolicArray) else (1, 1)


def matrix(values: Iterable[SymbolicScalar], rows: int, columns: int, kind: str = "double") -> Symbolic:
    """A matrix; one of a single value is that value."""
    made = tuple(values)
    if rows == columns == 1:
        return made[0]
    return SymbolicArray(made[0].kind if made else kind, rows, columns, made)


def leaves(value: Symbolic, name: str) -> Iterator[tuple[str, SymbolicScalar]]:
    """Every scalar in a value with its name: ``probe.level``, ``force(2)``, ``grid(1,2)``."""
    match value:
        case SymbolicScalar():
            yield name, value
        case SymbolicArray(_, rows, columns, values):
            for at, one in enumerate(values):
                place = f"{at // columns + 1},{at % columns + 1}" if min(rows, columns) > 1 else str(at + 1)
                yield f"{name}({place})", one
        case SymbolicStructure(_, elements):
            for element, inner in elements.items():
                yield from leaves(inner, f"{name}.{element}")


def filled(value: Symbolic, scalars: Iterator[SymbolicScalar]) -> Symbolic:
    """A value of the same shape with other scalars, in the order of ``leaves``."""
    match value:
        case SymbolicScalar():
            return next(scalars)
        case SymbolicArray(kind, rows, columns, values):
            return SymbolicArray(kind, rows, columns, tuple(next(scalars) for _ in values))
        case SymbolicStructure(kind, elements):
            return SymbolicStructure(kind, {name: filled(one, scalars) for name, one in elements.items()})


# --- formulas that say no more than they need to -----------------------------------------------------------


def folded(expr: Expr) -> Expr:
    """The formula, or the constant that it is; only its outermost operator is looked at."""
    if not isinstance(expr, Apply):
        return expr
    op, args = expr.op, expr.args
    if op is Op.ITE and isinstance(args[0], Const):
        return args[1] if args[0].value else args[2]
    if op in (Op.AND, Op.OR):
        stops = int(op is Op.OR)
        if any(isinstance(arg, Const) and arg.value == stops for arg in args):
            return TRUE if stops else FALSE
        left = [arg for arg in args if not isinstance(arg, Const)]
        if len(left) < len(args):
            if not left:
                return FALSE if stops else TRUE
            return left[0] if len(left) == 1 else Apply(op, tuple(left), Bool())
    if all(isinstance(arg, Const) for arg in args):
        return Const(operate(op, *(arg.value for arg in args if isinstance(arg, Const))), expr.sort)
    if op is Op.NOT and isinstance(args[0], Apply) and args[0].op is Op.NOT:
        return args[0].args[0]
    return expr


def chosen(condition: Expr, then: Expr, otherwise: Expr) -> Expr:
    """``then`` where the condition holds, else ``otherwise``."""
    if isinstance(condition, Const):
        return then if condition.value else otherwise
    if isinstance(then, Const) and isinstance(otherwise, Const) and then.sort == otherwise.sort:
        if then.value == otherwise.value:
            return then
        if isinstance(then.sort, Bool):
            return condition if then.value else folded(~condition)
    return ite(condition, then, otherwise)


def least_and_greatest(expr: Expr) -> tuple[Fraction, Fraction]:
    """Two numbers between which the value of a formula of numbers always lies."""
    assert isinstance(expr.sort, Num)
    values = possible(expr)
    low, high = (values[0], values[-1]) if isinstance(values, range) else (min(values), max(values))
    return low * expr.sort.resolution, high * expr.sort.resolution


__all__ = [
    "INTEGERS", "LOGICAL", "MADE", "REALS", "TWO_TYPES", "UNTYPED", "NotLowered", "Symbolic", "SymbolicArray",
    "SymbolicScalar", "SymbolicStructure", "chosen", "constant_of", "filled", "flat", "folded",
    "least_and_greatest", "leaves", "matrix", "number", "single_of", "size_of", "truth",
]  # fmt: skip
