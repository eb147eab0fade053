"""The statements of a path program: what a step says, plus choices of inputs and where to start again."""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Union

from checker.slice import names
from spec_model.lang.action import Assign
from spec_model.lang.expr import Expr, Var

Names = frozenset[str]

Span = tuple[Expr, Expr]
"""Places in a row of values: of the first to take, and behind the last."""


@dataclass(frozen=True, eq=False)
class Choose:
    """Take one of the values; the next one when the program is run again.  ``span``: only one of these."""

    var: Var
    values: tuple[int, ...]
    span: Span | None = None


@dataclass(frozen=True, eq=False)
class Fork:
    """From here the program is run again for other choices; ``number`` tells forks apart."""

    number: int


@dataclass(frozen=True, eq=False)
class Each:
    """Run the rest for each of the values in turn: a fork with a choice that every path makes.

    ``span``: only for these.  ``alone``: no other choice is made before the next fork.
    """

    number: int
    var: Var
    values: tuple[int, ...]
    span: Span | None = None
    alone: bool = False


@dataclass(frozen=True, eq=False)
class Require:
    """Go on only where the condition holds."""

    condition: Expr


@dataclass(frozen=True, eq=False)
class Branch:
    """A conditional whose branches may choose."""

    condition: Expr
    then: "PathProgram"
    otherwise: "PathProgram"


@dataclass(frozen=True, eq=False)
class Complete:
    """The valuation after the tick is complete; what follows only decides goals.

    The valuation is stored once, after what follows has been run for all of its own choices.
    """


PathStatement = Union[Assign, Branch, Choose, Complete, Each, Fork, Require]
PathProgram = tuple[PathStatement, ...]


def chooses(program: Iterable[PathStatement]) -> bool:
    """Whether some path chooses other than in an ``Each``."""
    return any(
        isinstance(s, Choose) or (isinstance(s, Branch) and (chooses(s.then) or chooses(s.otherwise)))
        for s in program
    )


def weight(program: PathProgram) -> int:
    """Statements on the longest path."""
    return sum(1 + max(weight(s.then), weight(s.otherwise)) if isinstance(s, Branch) else 1 for s in program)


def saved(program: PathProgram, live_at_end: Names) -> dict[int, tuple[Var, ...]]:
    """For each fork, by number, the variables to restore before the program is run again from there:
    those that what follows may both read and overwrite."""
    found: dict[int, tuple[Var, ...]] = {}
    _backward(program, live_at_end, {}, found)
    return found


def _backward(
    program: PathProgram, live: Names, writes: dict[str, Var], found: dict[int, tuple[Var, ...]]
) -> tuple[Names, dict[str, Var]]:
    for statement in reversed(program):
        match statement:
            case Assign(var, value):
                live = (live - {var.name}) | names([value])
                writes = {**writes, var.name: var}
            case Choose(var, _, span):
                live = (live - {var.name}) | names(span or ())
                writes = {**writes, var.name: var}
            case Require(condition):
                live |= names([condition])
            case Complete():
                pass  # what is stored is live to the end
            case Fork(number):
                found[number] = tuple(v for n, v in writes.items() if n in live)
            case Each(number, var, _, span):
                live -= {var.name}
                writes = {**writes, var.name: var}
                found[number] = tuple(v for n, v in writes.items() if n in live)
                live |= names(span or ())
            case Branch(condition, then, otherwise):
                then_live, then_writes = _backward(then, live, writes, found)
                else_live, else_writes = _backward(otherwise, live, writes, found)
                live = then_live | else_live | names([condition])
                writes = {**then_writes, **else_writes}
    return live, writes


def assigned(program: PathProgram) -> dict[str, tuple[Var, int]]:
    """Every variable that the program writes, with the position of its last assignment."""
    found: dict[str, tuple[Var, int]] = {}
    _positions(program, 0, found)
    return found


def _positions(program: PathProgram, at: int, found: dict[str, tuple[Var, int]]) -> int:
    for statement in program:
        at += 1
        match statement:
            case Assign(var, _) | Choose(var, _) | Each(_, var):
                found[var.name] = (var, at)
            case Branch(_, then, otherwise):
                at = _positions(otherwise, _positions(then, at, found), found)
            case Require() | Fork() | Complete():
                pass
    return at
