"""Statements written one after the other, with what is left out once something has ended early."""

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from functools import reduce

from rovercheck.checker.drawn.lower.first_step import written_once
from rovercheck.checker.drawn.lower.symbols import (
    TWO_TYPES,
    Symbolic,
    SymbolicScalar,
    SymbolicStructure,
    filled,
    folded,
    least_and_greatest,
    leaves,
)
from rovercheck.spec_model.lang.action import Assign, If, reads
from rovercheck.spec_model.lang.domain import Bool, Domain, Num, boolean, common_resolution, fixed
from rovercheck.spec_model.lang.expr import FALSE, TRUE, Const, Expr, Var, any_of, rescale
from rovercheck.spec_model.lang.programmed import FAULT, without
from rovercheck.spec_model.lang.system import Statement
from rovercheck.spec_model.lang.walk import variables

MOST_STATEMENTS = 100_000


ProgramPart = tuple[list[Statement], int]
"""Statements that are used in several places, and how many assignments they have."""


class TooManyStatements(Exception):
    """The step of a chart is longer than it may be."""


class ProgramWriter:
    """Writes the statements of a step.

    An *end* is a flag of which everything that follows is skipped once it is raised: a state that was left, a
    loop, a function.  What holds it is ``until``.  ``known`` are the values of data that are the same in
    every run at this point; ``locals`` are those of the variables of functions, each version of which is a
    temporary of its own, so that it has no more values than were assigned to it.  More assignments than
    ``most`` are refused; those of a part that is used in several places count in each.
    """

    def __init__(self, name: str, most: int = MOST_STATEMENTS) -> None:
        self.name, self._most, self.size = name, most, 0
        self.temporaries: dict[str, Var] = {}
        self.assigned_anew: set[str] = set()
        """The temporaries that are data of functions, which each call assigns; others are assigned once."""
        self.faults: dict[str, Var] = {}
        self._rows: list[Statement] = []
        self._ends: dict[str, Var] = {}
        self.known: dict[str, Const] = {}
        self.locals: dict[str, Symbolic] = {}
        self._numbers: dict[str, int] = {}
        self._open: list[_Opened] = []

    # --- statements ----------------------------------------------------------------------------------------

    def assign(self, var: Var, value: Expr) -> None:
        """``var := value``."""
        self._rows.append(Assign(var, value))
        self._grow(1)
        if isinstance(value, Const):
            self.known[var.name] = value
        else:
            self.known.pop(var.name, None)

    def _grow(self, by: int) -> None:
        self.size += by
        if self.size > self._most:
            raise TooManyStatements(
                f"a step of {self.name} does more than {self._most:,} things: let fewer events be sent while "
                "others are answered, and loops make fewer turns"
            )

    def read(self, var: Var) -> Expr:
        """The value of a variable at this point."""
        return self.known.get(var.name, var)

    def temporary(self, name: str, domain: Domain) -> Var:
        """A variable that is written before it is read in every step."""
        number = self._numbers[name] = self._numbers.get(name, 0) + 1
        first = 0 if 0 in domain else domain.low
        made = Var(f"{self.name}.{name}{number}", domain, first, hidden=True)
        self.temporaries[made.name] = made
        return made

    def mark(self, marker: Var, condition: Expr) -> None:
        """Assign a marker, which nothing reads, where a condition holds; it does not count as a statement."""
        self._rows.append(If(condition, (Assign(marker, TRUE),)))

    def fault(self, what: str) -> None:
        """Note that a step has no meaning: ``what`` says why, as a sentence about this system."""
        if what not in self.faults:
            number = len(self.faults) + 1
            self.faults[what] = Var(f"{self.name}.fault{number}", FAULT, 0, what, hidden=True)
        self._rows.append(Assign(self.faults[what], Const(1, Num())))
        self._grow(1)

    # --- choices -------------------------------------------------------------------------------------------

    def choose(
        self, condition: Expr, then: Callable[[], None], otherwise: Callable[[], None] = lambda: None
    ) -> None:
        """One of two parts, of which each may end something."""
        condition = folded(condition)
        if self.dead:
            return
        if isinstance(condition, Const):
            (then if condition.value else otherwise)()
            return
        before, locals_ = dict(self.known), dict(self.locals)
        one, one_ended, first_raised = self._side(then)
        known, first = self.known, self.locals
        self.known, self.locals = before, locals_
        other, other_ended, then_raised = self._side(otherwise)
        self._ends |= first_raised | then_raised
        if one_ended and not other_ended:
            self._open.append(_Opened(self._rows, condition, known, first, one))
            self._rows = other
            self._skip(then_raised)
            return
        if other_ended and not one_ended:
            self._open.append(_Opened(self._rows, folded(~condition), self.known, self.locals, other))
            self._rows, self.known, self.locals = one, known, first
            self._skip(first_raised)
            return
        self.known = _alike(known, self.known)
        self.locals = self._merged(first, self.locals, one, other)
        if one or other:
            self._rows.append(If(condition, tuple(one), tuple(other)))
            self._grow(1)
        self._skip(first_raised | then_raised, sure=one_ended and other_ended)

    def end_alike(self, flag: str) -> None:
        """Write once what both sides of the last choice do, which is one by a flag."""
        last = self._rows[-1] if self._rows else None
        if isinstance(last, If) and last.read == {flag}:
            self._rows[-1:] = written_once(last, flag)

    def _side(self, write: Callable[[], None]) -> tuple[list[Statement], bool, dict[str, Var]]:
        """The statements of one of two sides, whether it ends something in any case, and what it may end."""
        ended, ends = False, self._ends
        self._ends = {}

        def both() -> None:
            nonlocal ended
            write()
            ended = self.dead

        made, raised = self.part(both), self._ends
        self._ends = ends
        return made, ended, raised

    def part(self, write: Callable[[], None]) -> list[Statement]:
        """The statements of a part, apart from those written so far."""
        rows, opened = self._rows, self._open
        first = self._rows = []
        self._open = []
        write()
        self._close()
        self._rows, self._open = rows, opened
        return first

    def alone(self, write: Callable[[], None]) -> ProgramPart:
        """The same of a part that is used in several places: nothing is known before it, nor ended by it.

        The answer says, too, how many assignments it has, which do not count until it is included.
        """
        size = self.size
        ends, known, locals_ = self._ends, self.known, self.locals
        self._ends, self.known, self.locals = {}, {}, {}
        made = self.part(write)
        assert not self._ends
        self._ends, self.known, self.locals = ends, known, locals_
        size, self.size = self.size - size, size
        return made, size

    def include(self, statements: list[Statement], size: int) -> None:
        """Write a part that was written alone; nothing is known after it."""
        self._rows += statements
        self._grow(size)
        self.known = {}

    # --- ends ----------------------------------------------------------------------------------------------

    @contextmanager
    def until(self, name: str) -> Iterator[Var]:
        """A part that a flag may end."""
        end = self.temporary(name, boolean)
        rows, opened, ends = self._rows, self._open, self._ends
        inner: list[Statement] = []
        self._rows, self._open, self._ends = inner, [], {}
        yield end
        dead = self.dead
        self._close()
        raised = self._ends
        self._rows, self._open = rows, opened
        if raised.pop(end.name, None) is not None:
            self._rows.append(Assign(end, FALSE))
            dead = False
        else:
            del self.temporaries[end.name]
        self._rows += inner
        self._ends = ends | raised
        self._skip(raised, sure=dead)

    def end(self, flag: Var, condition: Expr = TRUE) -> None:
        """Raise a flag where a condition holds: what follows, up to the end of its part, is skipped then."""
        condition = folded(condition)
        if self.dead or (isinstance(condition, Const) and not condition.value):
            return
        if isinstance(condition, Const):
            self._rows.append(Assign(flag, TRUE))
        else:
            self._rows.append(If(condition, (Assign(flag, TRUE),)))
        self._ends[flag.name] = flag
        self._skip({flag.name: flag}, sure=isinstance(condition, Const))

    @property
    def dead(self) -> bool:
        """Whether nothing that is written here can be reached."""
        return any(isinstance(one.condition, Const) for one in self._open)

    def _skip(self, flags: Mapping[str, Var], sure: bool = False) -> None:
        """All that follows in this part is executed where none of the flags is raised."""
        if not flags:
            return
        condition: Expr = TRUE if sure else folded(any_of(*flags.values()))
        self._open.append(_Opened(self._rows, condition, dict(self.known), dict(self.locals), []))
        self._rows = []

    def _close(self) -> None:
        while self._open:
            opened = self._open.pop()
            inside, first = self._rows, opened.first
            self._rows = opened.rows
            if isinstance(opened.condition, Const):  # nothing gets here
                self.known, self.locals = opened.known, opened.locals
                continue
            self.known = _alike(opened.known, self.known)
            self.locals = self._merged(opened.locals, self.locals, first, inside)
            if inside or first:
                self._rows.append(If(opened.condition, tuple(first), tuple(inside)))
                self._grow(1)

    def _merged(
        self,
        one: dict[str, Symbolic],
        other: dict[str, Symbolic],
        first: list[Statement],
        second: list[Statement],
    ) -> dict[str, Symbolic]:
        """The variables of functions after either of two parts, whose ends bring them together."""
        found = {**other, **one}
        only = [name for name in other if name not in one], [name for name in one if name not in other]
        for part, absent in zip((first, second), only, strict=True):
            for name in absent:  # it means nothing on this way, and has some value
                for _, leaf in leaves(found[name], name):
                    if isinstance(leaf.expr, Var):
                        part.append(Assign(leaf.expr, Const(leaf.expr.init, leaf.expr.sort)))
        for name, value in one.items():
            if name in other and value is not other[name]:
                found[name] = self._joined(name, value, other[name], first, second)
        return found

    def _joined(
        self, name: str, one: Symbolic, other: Symbolic, first: list[Statement], second: list[Statement]
    ) -> Symbolic:
        lefts, rights = list(leaves(one, name)), list(leaves(other, name))
        if [(leaf, value.kind) for leaf, value in lefts] != [(leaf, value.kind) for leaf, value in rights]:
            return SymbolicStructure(TWO_TYPES, {})  # whoever reads it is told so
        made = []
        for (leaf, left), (_, right) in zip(lefts, rights, strict=True):
            if left.expr is right.expr or _same_constant(left.expr, right.expr):
                made.append(left)
                continue
            var = self.temporary(leaf.rpartition(":")[2], domain_of(left.expr, right.expr))
            first.append(Assign(var, in_steps(left.expr, var)))
            second.append(Assign(var, in_steps(right.expr, var)))
            made.append(SymbolicScalar(left.kind, var))
        return filled(one, iter(made))

    def kept(self, name: str, value: SymbolicScalar) -> SymbolicScalar:
        """A value as it is now, whatever is assigned later."""
        if isinstance(value.expr, Const):
            return value
        at = value.expr.name if isinstance(value.expr, Var) else ""
        if at in self.temporaries and at not in self.assigned_anew:
            return value
        var = self.temporary(name, domain_of(value.expr))
        self._rows.append(Assign(var, in_steps(value.expr, var)))
        self._grow(1)
        return SymbolicScalar(value.kind, var)

    def fresh(self, temporaries: Mapping[str, Var]) -> "ProgramWriter":
        """One for another text of the same chart: its further temporaries have other names."""
        made = ProgramWriter(self.name, self._most)
        made._numbers, made.temporaries = self._numbers, dict(temporaries)
        return made

    def written(self, *after: Expr) -> tuple[Statement, ...]:
        """All statements, without assignments to temporaries that nothing reads, nor a formula after them."""
        self._close()
        made, before = tuple(self._rows), -1
        while before != len(self.temporaries):
            before = len(self.temporaries)
            needed = reads(made) | variables(*after)
            unread = {name for name in self.temporaries if name not in needed}
            made = without(made, unread)
            for name in unread:
                del self.temporaries[name]
        return made


@dataclass(frozen=True)
class _Opened:
    """Where statements stood before a part began that is skipped where a condition holds.

    ``first`` is what is done in its place, after which these values are ``known``.
    """

    rows: list[Statement]
    condition: Expr
    known: dict[str, Const]
    locals: dict[str, Symbolic]
    first: list[Statement]


def domain_of(*formulas: Expr) -> Domain:
    """The values that some formulas of one sort may have."""
    sort = formulas[0].sort
    if not isinstance(sort, Num):
        return boolean if isinstance(sort, Bool) else Domain(sort, tuple(raw for _, raw in sort.members))
    resolutions = (one.sort.resolution for one in formulas if isinstance(one.sort, Num))
    step = reduce(common_resolution, resolutions)
    ends = [least_and_greatest(one) for one in formulas]
    return fixed(min(low for low, _ in ends), max(high for _, high in ends), step)


def in_steps(expr: Expr, var: Var) -> Expr:
    """A formula in the resolution of a variable that has one as fine."""
    return rescale(expr, var.sort) if isinstance(var.sort, Num) else expr


def _same_constant(one: Expr, other: Expr) -> bool:
    if not isinstance(one, Const) or not isinstance(other, Const):
        return False
    return one.sort == other.sort and one.value == other.value


def _alike(one: dict[str, Const], other: dict[str, Const]) -> dict[str, Const]:
    """What is known either way."""
    return {
        name: value
        for name, value in one.items()
        if name in other and other[name].value == value.value and other[name].sort == value.sort
    }


def joined(*parts: ProgramPart) -> ProgramPart:
    """Parts one after the other."""
    return [one for statements, _ in parts for one in statements], sum(size for _, size in parts)


__all__ = ["MOST_STATEMENTS", "ProgramPart", "ProgramWriter", "TooManyStatements", "joined"]
