"""Statements of actions and scripts as trees; as in ``syntax``, ``at`` does not count in comparisons."""

from dataclasses import dataclass, field
from typing import Literal, TypeAlias, Union

from rovercheck.checker.drawn.grammar.syntax import BinaryOperator, Expression

__all__ = [
    "ActionStatement",
    "Assignment",
    "BreakStatement",
    "ContinueStatement",
    "Evaluated",
    "ForLoop",
    "IfBranch",
    "IfStatement",
    "Increment",
    "NameDeclaration",
    "ReturnStatement",
    "SwitchCase",
    "SwitchStatement",
    "WhileLoop",
]


@dataclass(frozen=True, slots=True)
class Assignment:
    """``targets = value``: several for ``[a, ~] = f(x)``, where ``~`` is None.

    ``operator`` is ``+`` for ``+=``, and None for ``=``.  ``fixed_point`` says that ``:=`` was written.
    """

    targets: tuple[Expression | None, ...]
    value: Expression
    operator: BinaryOperator | None = None
    fixed_point: bool = False
    at: int = field(default=0, compare=False)


@dataclass(frozen=True, slots=True)
class Increment:
    """``target++`` by 1 or ``target--`` by -1."""

    target: Expression
    by: Literal[1, -1]
    at: int = field(default=0, compare=False)


@dataclass(frozen=True, slots=True)
class Evaluated:
    """An expression as a statement: an event that is broadcast, or a call."""

    expression: Expression
    at: int = field(default=0, compare=False)


@dataclass(frozen=True, slots=True)
class IfBranch:
    """What follows ``if`` or ``elseif``."""

    condition: Expression
    body: tuple["ActionStatement", ...]
    at: int = field(default=0, compare=False)


@dataclass(frozen=True, slots=True)
class IfStatement:
    """``if``, each ``elseif``, and what follows ``else`` (nothing without it)."""

    branches: tuple[IfBranch, ...]
    otherwise: tuple["ActionStatement", ...]
    at: int = field(default=0, compare=False)


@dataclass(frozen=True, slots=True)
class ForLoop:
    """``for variable = values``: over the columns of the values."""

    variable: str
    values: Expression
    body: tuple["ActionStatement", ...]
    at: int = field(default=0, compare=False)


@dataclass(frozen=True, slots=True)
class WhileLoop:
    """``while condition``."""

    condition: Expression
    body: tuple["ActionStatement", ...]
    at: int = field(default=0, compare=False)


@dataclass(frozen=True, slots=True)
class SwitchCase:
    """``case value`` or ``case {one, other}``."""

    values: tuple[Expression, ...]
    body: tuple["ActionStatement", ...]
    at: int = field(default=0, compare=False)


@dataclass(frozen=True, slots=True)
class SwitchStatement:
    """``switch subject``, its cases, and what follows ``otherwise`` (nothing without it)."""

    subject: Expression
    cases: tuple[SwitchCase, ...]
    otherwise: tuple["ActionStatement", ...]
    at: int = field(default=0, compare=False)


@dataclass(frozen=True, slots=True)
class ReturnStatement:
    """``return``."""

    at: int = field(default=0, compare=False)


@dataclass(frozen=True, slots=True)
class BreakStatement:
    """``break``."""

    at: int = field(default=0, compare=False)


@dataclass(frozen=True, slots=True)
class ContinueStatement:
    """``continue``."""

    at: int = field(default=0, compare=False)


@dataclass(frozen=True, slots=True)
class NameDeclaration:
    """``persistent a b`` or ``global a b``."""

    keyword: Literal["persistent", "global"]
    names: tuple[str, ...]
    at: int = field(default=0, compare=False)


ActionStatement: TypeAlias = Union[
    Assignment, Increment, Evaluated, IfStatement, ForLoop, WhileLoop, SwitchStatement, ReturnStatement,
    BreakStatement, ContinueStatement, NameDeclaration,
]  # fmt: skip
