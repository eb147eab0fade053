"""Paths: the step as a program that chooses an input only where some path first needs it.

``Choose`` takes one cell of an input; every cell is taken in turn by running the program again from
the last ``Fork`` before it.  ``Require`` gives a path up when the assumption fails.  Inputs that a
path never reads are never chosen, so they cost nothing.  What ``&``, ``|`` and ``ite`` may leave
unread is turned into branches for the same reason; all expressions of the result are free of choices.

What is stored of a tick seldom asks as much of an input as goals do.  So there may be two stages, with a
``Complete`` between them: as far as the state depends on it an input is chosen coarsely, then, for the
statements that only goals need, among the cells inside the one chosen.
"""

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import accumulate, pairwise, takewhile

from rovercheck.checker.encode.code_motion import sunk
from rovercheck.checker.encode.path_statements import (
    Branch,
    Choose,
    Complete,
    Each,
    Fork,
    Names,
    PathProgram,
    PathStatement,
    Require,
    Span,
    chooses,
    weight,
)
from rovercheck.checker.system.partition import Partition, conjuncts, expressions, partitions
from rovercheck.checker.system.slice import names
from rovercheck.spec_model.lang.action import Action, Assign, If
from rovercheck.spec_model.lang.domain import Bool, Domain, Num
from rovercheck.spec_model.lang.expr import FALSE, TRUE, Apply, Const, Expr, Named, Var, flag
from rovercheck.spec_model.lang.operators import Op
from rovercheck.spec_model.lang.system import Program, TransitionSystem
from rovercheck.spec_model.lang.walk import variables

Cells = Mapping[str, Partition]


def read_flag(var: Var) -> Var:
    """The variable that is true once a path has chosen the input."""
    return flag(f"?read {var.name}")


def path_program(system: TransitionSystem, cells: Cells) -> PathProgram:
    """The assumption and the step of a system; inputs are chosen cell by cell, when first read.

    An input that every path reads sooner or later is chosen before the first statement that mentions it:
    that makes no more paths, and plain loops.
    """
    _, seen = _Made(cells).whole(system)
    program, _ = _Made(cells, seen.always).whole(system)
    return forked(program)


_MOST_NESTED = 8
"""Operands with choices that are nested in each other; more are halved first: branches stay shallow."""

_MOST_COARSE = 16
"""Coarse cells of an input beyond which it is chosen finely at once: finding the fine ones takes too long."""


def staged_program(system: TransitionSystem, cells: Cells, stored: Names) -> PathProgram | None:
    """The same paths with as few of them as can be until the state after the tick is complete.

    To there an input is chosen among coarse cells: values that the assumption and what is stored cannot
    tell apart.  Then follow the statements that only goals need, and choices among the cells inside.
    None where no input has coarser cells.
    """
    early, late = sunk(system.step, stored)
    coarse = _coarser(system, early, late, cells)
    if not coarse:
        return None
    first = replace(system, step=early)
    _, whole = _Made(cells).whole(system)
    _, seen = _Made({**cells, **coarse}).whole(first)
    made = _Made({**cells, **coarse}, seen.always)
    program, seen = made.whole(first)
    return forked((*program, Complete(), *made.refined(late, cells, whole.always, seen)))


def _coarser(system: TransitionSystem, early: Program, late: Program, cells: Cells) -> dict[str, Partition]:
    """The cells to choose from at first, of the inputs for which there are fewer than in the end."""
    if any(not p.cells for p in cells.values()):
        return {}
    read = names(expressions(late))
    some = tuple(v for v in system.inputs if v.name in read and len(cells[v.name].cells) > 1)
    found = partitions(replace(system, step=early, inputs=some)) if some else {}
    return {n: p for n, p in found.items() if len(p.cells) <= min(_MOST_COARSE, len(cells[n].cells) - 1)}


def _assumed(system: TransitionSystem, cells: Cells) -> list[Expr]:
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

    def without(self, some: Collection[str]) -> "_Seen":
        return _Seen(self.always.difference(some), self.sometimes.difference(some))


def _finer(coarse: Partition, fine: Partition, seen: _Seen) -> Choose:
    """The fine cells inside the coarse one that was chosen before; any on a path that has not chosen."""
    var, home = coarse.var, [coarse.cell_of[cell.value] for cell in fine.cells]
    values = tuple(v for _, v in sorted(zip(home, (cell.value for cell in fine.cells), strict=True)))
    if var.name not in seen.sometimes or len(coarse.cells) == 1:
        return Choose(var, values)
    ends = accumulate((home.count(n) for n in range(len(coarse.cells))), initial=0)
    spans = [_span(*between) for between in pairwise(ends)]
    span = spans[-1]
    for cell, other in zip(coarse.cells[:-1], spans, strict=False):
        span = _either(Apply(Op.EQ, (var, Const(cell.value, var.sort)), Bool()), other, span)
    if var.name not in seen.always:
        span = _either(read_flag(var), span, _span(0, len(values)))
    return Choose(var, values, span)


def _span(first: int, end: int) -> Span:
    return Const(first, Num()), Const(end, Num())


def _either(condition: Expr, then: Span, otherwise: Span) -> Span:
    first, end = (Apply(Op.ITE, (condition, a, b), Num()) for a, b in zip(then, otherwise, strict=True))
    return first, end


@dataclass
class _Made:
    """Fresh names and numbers while a path program is made."""

    cells: Cells
    sure: Names = frozenset()
    """Inputs to choose as early as possible."""
    finer: dict[str, Choose] = field(default_factory=dict)
    """The second choices of inputs that have been chosen coarsely."""
    fresh: int = 0
    read: dict[int, tuple[Expr, Names]] = field(default_factory=dict)

    def whole(self, system: TransitionSystem) -> tuple[PathProgram, _Seen]:
        """The program, and what its paths have read at their end."""
        out: list[PathStatement] = []
        seen = _Seen()
        for condition in _assumed(system, self.cells):
            value, seen = self.pure(condition, seen, out)
            out.append(Require(value))
        seen = self.top(system.step, seen, out)
        return tuple(out), seen

    def refined(self, late: Program, cells: Cells, sure: Names, seen: _Seen) -> PathProgram:
        """What follows when the others are complete, on paths that have read ``seen`` before."""
        coarse = [n for n, p in cells.items() if len(self.cells[n].cells) < len(p.cells)]
        self.finer = {n: _finer(self.cells[n], cells[n], seen) for n in coarse}
        self.cells, self.sure = cells, sure
        out: list[PathStatement] = []
        self.top(late, seen.without(coarse), out)
        return tuple(out)

    def top(self, program: Program, seen: _Seen, out: list[PathStatement]) -> _Seen:
        """Statements outside of branches, after the choices that are sure to be made."""
        for statement in program:
            for var in self.mentioned(statement):
                if var.name in self.sure - seen.always:
                    seen = self.choose(var, seen, out)
            seen = self.statements((statement,), seen, out)
        return seen

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
        known, made = read_flag(var), Choose(var, tuple(c.value for c in self.cells[var.name].cells))
        if var.name in self.finer:
            known, made = flag(f"?finer {var.name}"), self.finer[var.name]
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
        if len(rest) > _MOST_NESTED:
            half, seen = self.junction(op, [*known, *rest[: len(rest) // 2]], seen, out)
            return self.junction(op, [half, *rest[len(rest) // 2 :]], seen, out)
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

    Forks lie outside of branches, so that they nest: the native code is a nest of plain loops.  What
    follows a ``Complete`` is short and run often, so every choice outside of branches is a fork there.
    """
    apart = max(2, weight(program) // _FORKS)
    out: list[PathStatement] = []
    forks, since, last = 0, apart, False
    for statement in program:
        if isinstance(statement, Complete):
            since, last = apart, True
        plain = isinstance(statement, Choose) and len(statement.values) > 1
        if chooses((statement,)) and (since >= apart or (plain and last)):
            if isinstance(statement, Choose) and plain:
                statement = Each(forks, statement.var, statement.values, statement.span)
            else:
                out.append(Fork(forks))
            forks, since = forks + 1, 0
        out.append(statement)
        since += weight((statement,))
    return tuple(_alone(out))


def _alone(program: Sequence[PathStatement]) -> Iterator[PathStatement]:
    """The program with ``alone`` set where it is so."""
    for at, statement in enumerate(program):
        if isinstance(statement, Each):
            segment = takewhile(lambda s: not isinstance(s, Fork | Each), program[at + 1 :])
            statement = replace(statement, alone=not chooses(segment))
        yield statement
