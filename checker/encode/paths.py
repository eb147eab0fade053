"""Paths: the step as a program that chooses an input only where some path first needs it.

``Choose`` takes one cell of an input; every cell is taken in turn by running the program again from
the last ``Fork`` before it.  ``Require`` gives a path up when the assumption fails.  Inputs that a
path never reads are never chosen, so they cost nothing.  What ``&``, ``|`` and ``ite`` may leave
unread is turned into branches for the same reason; all expressions of the result are free of choices.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import takewhile
from typing import Union

from checker.partition import Partition, conjuncts
from checker.slice import names
from spec_model.lang.action import Action, Assign, If
from spec_model.lang.domain import Bool, Domain, Num
from spec_model.lang.expr import FALSE, TRUE, Apply, Expr, Named, Op, Var, flag
from spec_model.lang.system import TransitionSystem
from spec_model.lang.walk import variables

Names = frozenset[str]


@dataclass(frozen=True, eq=False)
class Choose:
    """Take one of the values; the next one when the program is run again."""

    var: Var
    values: tuple[int, ...]


@dataclass(frozen=True, eq=False)
class Fork:
    """From here the program is run again for other choices; ``number`` tells forks apart."""

    number: int


@dataclass(frozen=True, eq=False)
class Each:
    """Run the rest for each of the values in turn: a fork with a choice that every path makes.

    ``alone``: no other choice is made before the next fork.
    """

    number: int
    var: Var
    values: tuple[int, ...]
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


PathStatement = Union[Assign, Branch, Choose, Each, Fork, Require]
PathProgram = tuple[PathStatement, ...]


def read_flag(var: Var) -> Var:
    """The variable that is true once a path has chosen the input."""
    return flag(f"?read {var.name}")


def path_program(system: TransitionSystem, cells: Mapping[str, Partition]) -> PathProgram:
    """The assumption and the step of a system; inputs are chosen cell by cell, when first read.

    An input that every path reads sooner or later is chosen before the first statement that mentions it:
    that makes no more paths, and plain loops.
    """
    _, seen = _Made(cells).whole(system)
    program, _ = _Made(cells, seen.always).whole(system)
    return forked(program)


def _assumed(system: TransitionSystem, cells: Mapping[str, Partition]) -> list[Expr]:
    """The conjuncts that the cells do not already imply."""
    if any(not p.cells for p in cells.values()):
        return [FALSE]
    return [c for c in conjuncts(system.assume) if len(n := names([c])) != 1 or not n <= set(cells)]


@dataclass(frozen=True)
class _Seen:
    """Inputs read on every path to here, and on some path."""

    always: Names = frozenset()
    sometimes: Names = frozenset()

    def join(self, other: "_Seen") -> "_Seen":
        return _Seen(self.always & other.always, self.sometimes | other.sometimes)

    def with_(self, name: str) -> "_Seen":
        return _Seen(self.always | {name}, self.sometimes | {name})


@dataclass
class _Made:
    """Fresh names and numbers while a path program is made."""

    cells: Mapping[str, Partition]
    sure: Names = frozenset()
    """Inputs to choose as early as possible."""
    fresh: int = 0
    read: dict[int, tuple[Expr, Names]] = field(default_factory=dict)

    def whole(self, system: TransitionSystem) -> tuple[PathProgram, _Seen]:
        """The program, and what its paths have read at their end."""
        out: list[PathStatement] = []
        seen = _Seen()
        for condition in _assumed(system, self.cells):
            value, seen = self.pure(condition, seen, out)
            out.append(Require(value))
        for statement in system.step:
            for var in self.mentioned(statement):
                if var.name in self.sure - seen.always:
                    seen = self.choose(var, seen, out)
            seen = self.statements((statement,), seen, out)
        return tuple(out), seen

    def mentioned(self, statement: Action) -> Iterator[Var]:
        """The inputs that occur in a statement."""
        if isinstance(statement, Assign):
            yield from (v for v in variables(statement.value).values() if v.name in self.cells)
        if isinstance(statement, If):
            yield from (v for v in variables(statement.condition).values() if v.name in self.cells)
            for inner in (*statement.then, *statement.otherwise):
                yield from self.mentioned(inner)

    def statements(self, program: Sequence[object], seen: _Seen, out: list[PathStatement]) -> _Seen:
        for statement in program:
            if isinstance(statement, Assign):
                value, seen = self.pure(statement.value, seen, out)
                out.append(Assign(statement.var, value))
            elif isinstance(statement, If):
                condition, seen = self.pure(statement.condition, seen, out)
                then: list[PathStatement] = []
                otherwise: list[PathStatement] = []
                after_then = self.statements(statement.then, seen, then)
                after_else = self.statements(statement.otherwise, seen, otherwise)
                out.append(Branch(condition, tuple(then), tuple(otherwise)))
                seen = after_then.join(after_else)
        return seen

    def pure(self, expr: Expr, seen: _Seen, out: list[PathStatement]) -> tuple[Expr, _Seen]:
        """An equal expression over inputs already chosen; ``out`` gets what must run before it."""
        if self.ready(expr, seen):
            return expr, seen
        match expr:
            case Var():
                return expr, self.choose(expr, seen, out)
            case Named(_, body):
                return self.pure(body, seen, out)
            case Apply(Op.AND | Op.OR as op, args, _):
                return self.junction(op, list(args), seen, out)
            case Apply(Op.ITE, (condition, then, otherwise), _):
                test, seen = self.pure(condition, seen, out)
                return self.selection(expr, test, then, otherwise, seen, out)
            case Apply(op, args, sort):
                values = []
                for arg in args:
                    value, seen = self.pure(arg, seen, out)
                    values.append(value)
                return Apply(op, tuple(values), sort), seen
        raise AssertionError(expr.__class__)

    def ready(self, expr: Expr, seen: _Seen) -> bool:
        """Whether every input that the expression mentions has been chosen on every path to here."""
        if id(expr) not in self.read:
            self.read[id(expr)] = expr, names([expr]) & self.cells.keys()  # held: ids stay unique
        return self.read[id(expr)][1] <= seen.always

    def choose(self, var: Var, seen: _Seen, out: list[PathStatement]) -> _Seen:
        known = read_flag(var)
        made = Choose(var, tuple(c.value for c in self.cells[var.name].cells))
        steps: PathProgram = (made, Assign(known, TRUE))
        if var.name in seen.sometimes:
            steps = (Branch(known, (), steps),)
        out.extend(steps)
        return seen.with_(var.name)

    def junction(self, op: Op, args: list[Expr], seen: _Seen, out: list[PathStatement]) -> tuple[Expr, _Seen]:
        """Operands that need no choice first; the others only if these leave the result open."""
        known = [a for a in args if self.ready(a, seen)]
        rest = [a for a in args if not self.ready(a, seen)]
        if not rest:
            return (known[0] if len(known) == 1 else Apply(op, tuple(known), Bool())), seen
        if not known:
            first, seen = self.pure(rest[0], seen, out)
            return self.junction(op, [first, *rest[1:]], seen, out) if len(rest) > 1 else (first, seen)
        result = self.temporary(Bool())
        out.append(Assign(result, known[0] if len(known) == 1 else Apply(op, tuple(known), Bool())))
        inner: list[PathStatement] = []
        value, after = self.junction(op, rest, seen, inner)
        inner.append(Assign(result, value))
        branches = (tuple(inner), ()) if op is Op.AND else ((), tuple(inner))
        out.append(Branch(result, *branches))
        return result, seen.join(after)

    def selection(
        self, expr: Expr, test: Expr, then: Expr, otherwise: Expr, seen: _Seen, out: list[PathStatement]
    ) -> tuple[Expr, _Seen]:
        if self.ready(then, seen) and self.ready(otherwise, seen):
            return Apply(Op.ITE, (test, then, otherwise), expr.sort), seen
        result = self.temporary(expr.sort)
        branches: list[PathProgram] = []
        after: list[_Seen] = []
        for value in (then, otherwise):
            inner: list[PathStatement] = []
            found, reached = self.pure(value, seen, inner)
            branches.append((*inner, Assign(result, found)))
            after.append(reached)
        out.append(Branch(test, branches[0], branches[1]))
        return result, after[0].join(after[1])

    def temporary(self, sort: object) -> Var:
        self.fresh += 1
        name = f"?{self.fresh}"
        if isinstance(sort, Bool):
            return flag(name)
        return Var(name, Domain(Num(), range(-(1 << 62), 1 << 62)))


# --- forks ---------------------------------------------------------------------------------------

_FORKS = 12
"""Forks in a program, at most about: more save running statements again, but cost registers."""


def forked(program: PathProgram) -> PathProgram:
    """The program with a fork at its start, and before choices before which much is run.

    Forks lie outside of branches, so that they nest: the native code is a nest of plain loops.
    """
    apart = max(2, _weight(program) // _FORKS)
    out: list[PathStatement] = []
    forks, weight = 0, apart
    for statement in program:
        if weight >= apart and _chooses((statement,)):
            if isinstance(statement, Choose) and len(statement.values) > 1:
                statement = Each(forks, statement.var, statement.values)
            else:
                out.append(Fork(forks))
            forks, weight = forks + 1, 0
        out.append(statement)
        weight += _weight((statement,))
    return tuple(_alone(out))


def _alone(program: Sequence[PathStatement]) -> Iterator[PathStatement]:
    """The program with ``alone`` set where it is so."""
    for at, statement in enumerate(program):
        if isinstance(statement, Each):
            segment = takewhile(lambda s: not isinstance(s, Fork | Each), program[at + 1 :])
            statement = replace(statement, alone=not _chooses(tuple(segment)))
        yield statement


def _weight(program: PathProgram) -> int:
    """Statements on the longest path."""
    return sum(
        1 + max(_weight(s.then), _weight(s.otherwise)) if isinstance(s, Branch) else 1 for s in program
    )


def _chooses(program: PathProgram) -> bool:
    return any(
        isinstance(s, Choose) or (isinstance(s, Branch) and (_chooses(s.then) or _chooses(s.otherwise)))
        for s in program
    )


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
            case Choose(var, _):
                live -= {var.name}
                writes = {**writes, var.name: var}
            case Require(condition):
                live |= names([condition])
            case Fork(number):
                found[number] = tuple(v for n, v in writes.items() if n in live)
            case Each(number, var):
                live -= {var.name}
                writes = {**writes, var.name: var}
                found[number] = tuple(v for n, v in writes.items() if n in live)
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
            case Require() | Fork():
                pass
    return at
