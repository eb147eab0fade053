"""The statements of a path program: what a step says, plus choices of inputs and where to start again."""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Union

from rovercheck.checker.system.slice import names
from rovercheck.spec_model.lang.action import Assign
from rovercheck.spec_model.lang.expr import Expr, Var

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
    """The state after the tick is complete; what follows only decides goals.

    The state is stored once, after what follows has been run for all of its own choices.
    """


PathStatement = Union[Assign, Branch, Choose, Complete, Each, Fork, Require]
PathProgram = tuple[PathStatement, ...]


def chooses(program: Iterable[PathStatement]) -> bool:
    """Whether some path chooses other than in an ``Each``."""
    return any(
        isinstance(s, Choose) or (isinstance(s, Branch) and (chooses(s.then) or chooses(s.otherwise)))
        for s in program
    )


def choices(program: PathProgram) -> int:
    """How many choices are written in the program."""
    return sum(
        choices(s.then) + choices(s.otherwise) if isinstance(s, Branch) else isinstance(s, Choose)
        for s in program
    )


def weight(program: PathProgram) -> int:
    """Statements on the longest path."""
    return sum(1 + max(weight(s.then), weight(s.otherwise)) if isinstance(s, Branch) else 1 for s in program)


def saved(program: PathProgram, live_at_end: Names) -> dict[int, tuple[Var, ...]]:
    """For each fork, by number, the variables to restore before the program is run again from there:
    those that what follows may both read and overwrite."""
    found = _Backward()
    found.through(program, found.bits(live_at_end), 0)
    return found.forks


class _Backward:
    """What is live and written later, as a bit for each name: sets of thousands are slow."""

    def __init__(self) -> None:
        self.forks: dict[int, tuple[Var, ...]] = {}
        self._bit: dict[str, int] = {}
        self._vars: dict[int, Var] = {}
        self._read: dict[int, tuple[Expr, int]] = {}

    def bits(self, some: Iterable[str]) -> int:
        return sum(self._bit.setdefault(name, 1 << len(self._bit)) for name in some)

    def _written(self, var: Var) -> int:
        bit = self.bits([var.name])
        self._vars[bit] = var
        return bit

    def _names(self, *some: Expr) -> int:
        """The names in formulas, of which many stand in several places."""
        found = 0
        for expr in some:
            if id(expr) not in self._read:
                self._read[id(expr)] = expr, self.bits(names([expr]))
            found |= self._read[id(expr)][1]
        return found

    def _vars_of(self, bits: int) -> tuple[Var, ...]:
        found = []
        while bits:
            found.append(self._vars[bits & -bits])
            bits &= bits - 1
        return tuple(found)

    def through(self, program: PathProgram, live: int, writes: int) -> tuple[int, int]:
        """What is live before the program, and written in it or later."""
        for statement in reversed(program):
            match statement:
                case Assign(var, value):
                    bit = self._written(var)
                    live, writes = (live & ~bit) | self._names(value), writes | bit
                case Choose(var, _, span):
                    bit = self._written(var)
                    live, writes = (live & ~bit) | self._names(*(span or ())), writes | bit
                case Require(condition):
                    live |= self._names(condition)
                case Complete():
                    pass  # what is stored is live to the end
                case Fork(number):
                    self.forks[number] = self._vars_of(writes & live)
                case Each(number, var, _, span):
                    bit = self._written(var)
                    live, writes = live & ~bit, writes | bit
                    self.forks[number] = self._vars_of(writes & live)
                    live |= self._names(*(span or ()))
                case Branch(condition, then, otherwise):
                    one_live, one_writes = self.through(then, live, writes)
                    other_live, other_writes = self.through(otherwise, live, writes)
                    live = one_live | other_live | self._names(condition)
                    writes = one_writes | other_writes
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
