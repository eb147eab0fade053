"""Expressions of charts as trees, of both action languages alike.

Every node knows its offset ``at`` in the text it was read from, which does not count when trees are compared.
Operators have one name, however they are written: ``!`` is MATLAB's ``~`` and C's ``!``.
"""

from collections.abc import Iterator
from dataclasses import dataclass, field
from enum import Enum
from fractions import Fraction
from typing import Literal, TypeAlias, Union

__all__ = [
    "ActionLanguage",
    "Applied",
    "BinaryOperation",
    "BinaryOperator",
    "CellArray",
    "ColonRange",
    "Expression",
    "Indexed",
    "LastIndex",
    "Matrix",
    "Member",
    "Name",
    "Number",
    "NumberKind",
    "TextLiteral",
    "UnaryOperation",
    "UnaryOperator",
    "WholeRange",
    "operands",
    "parts",
]


class ActionLanguage(Enum):
    """The language of a chart's texts.

    In C without bit operations ``^`` is power, ``&`` and ``|`` are logical.
    """

    MATLAB = "MATLAB"
    C = "C without bit operations"
    C_BITS = "C with bit operations"


class NumberKind(Enum):
    """How a number is written, which decides its type."""

    DOUBLE = "double"
    """Any decimal number of MATLAB."""
    INTEGER = "integer"
    """A number of C without point and exponent."""
    FLOATING = "floating"
    """A number of C with a point or an exponent."""
    SINGLE = "single"
    """A number of C that ends with F."""
    BITS = "bits"
    """A hexadecimal (0x) or binary (0b) number."""


BinaryOperator: TypeAlias = Literal[
    "||", "&&", "|", "&", "bit|", "bit^", "bit&", "==", "!=", "<", "<=", ">", ">=", "<<", ">>",
    "+", "-", "*", "/", "\\", "%%", ".*", "./", ".\\", "^", ".^",
]  # fmt: skip
"""``|`` and ``&`` are logical, element by element; ``^`` is power; ``%%`` the remainder of C."""
UnaryOperator: TypeAlias = Literal["-", "+", "!", "bit~", "address", "pointee", "'", ".'"]
"""``'`` and ``.'`` transpose; ``address`` is ``&x`` and ``pointee`` ``*x`` of C."""


@dataclass(frozen=True, slots=True)
class Number:
    """A number of exactly this value, never negative; ``text`` is what was written, without suffix."""

    value: Fraction
    kind: NumberKind
    text: str = field(compare=False)
    at: int = field(default=0, compare=False)


@dataclass(frozen=True, slots=True)
class TextLiteral:
    """A text between quotes, ``'`` or ``"``."""

    value: str
    quote: str
    at: int = field(default=0, compare=False)


@dataclass(frozen=True, slots=True)
class Name:
    """A name alone: of data, an event, a state, a function, a unit of time, a member of an enumeration."""

    name: str
    at: int = field(default=0, compare=False)


@dataclass(frozen=True, slots=True)
class Member:
    """``owner.name``: a field, a member ``Type.NAME``, a state ``S.T``, an event ``S.E``.

    ``arrow`` says that ``owner->name`` of C was written.
    """

    owner: "Expression"
    name: str
    arrow: bool = False
    at: int = field(default=0, compare=False)


@dataclass(frozen=True, slots=True)
class Applied:
    """``function(arguments)``: a call, a conversion, or in MATLAB an index, which only the names decide."""

    function: "Expression"
    arguments: tuple["Expression", ...]
    at: int = field(default=0, compare=False)


@dataclass(frozen=True, slots=True)
class Indexed:
    """``array[index]`` of C."""

    array: "Expression"
    index: "Expression"
    at: int = field(default=0, compare=False)


@dataclass(frozen=True, slots=True)
class UnaryOperation:
    """An operator before its operand, or a transpose after it."""

    operator: UnaryOperator
    operand: "Expression"
    at: int = field(default=0, compare=False)


@dataclass(frozen=True, slots=True)
class BinaryOperation:
    """An operator between two operands; ``at`` is the place of the operator."""

    operator: BinaryOperator
    left: "Expression"
    right: "Expression"
    at: int = field(default=0, compare=False)


@dataclass(frozen=True, slots=True)
class ColonRange:
    """``start:stop`` or ``start:step:stop``."""

    start: "Expression"
    step: Union["Expression", None]
    stop: "Expression"
    at: int = field(default=0, compare=False)


@dataclass(frozen=True, slots=True)
class WholeRange:
    """``:`` alone, as an index."""

    at: int = field(default=0, compare=False)


@dataclass(frozen=True, slots=True)
class LastIndex:
    """``end``, as an index or in one."""

    at: int = field(default=0, compare=False)


@dataclass(frozen=True, slots=True)
class Matrix:
    """``[a b; c d]``, row by row."""

    rows: tuple[tuple["Expression", ...], ...]
    at: int = field(default=0, compare=False)


@dataclass(frozen=True, slots=True)
class CellArray:
    """``{a, b}``, row by row."""

    rows: tuple[tuple["Expression", ...], ...]
    at: int = field(default=0, compare=False)


Expression: TypeAlias = Union[
    Number, TextLiteral, Name, Member, Applied, Indexed, UnaryOperation, BinaryOperation, ColonRange,
    WholeRange, LastIndex, Matrix, CellArray,
]  # fmt: skip


def operands(expression: Expression) -> tuple[Expression, ...]:
    """The expressions directly in another, from left to right."""
    match expression:
        case Member(owner):
            return (owner,)
        case Applied(function, arguments):
            return (function, *arguments)
        case Indexed(array, index):
            return (array, index)
        case UnaryOperation(_, operand):
            return (operand,)
        case BinaryOperation(_, left, right) | ColonRange(left, None, right):
            return (left, right)
        case ColonRange(start, step, stop) if step is not None:
            return (start, step, stop)
        case Matrix(rows) | CellArray(rows):
            return tuple(entry for row in rows for entry in row)
        case _:
            return ()


def parts(expression: Expression) -> Iterator[Expression]:
    """An expression and all in it, from left to right, outer ones first."""
    waiting = [expression]
    while waiting:
        part = waiting.pop()
        yield part
        waiting.extend(reversed(operands(part)))
