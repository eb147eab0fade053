"""Exact cells of inputs: values of an input that no expression can tell apart are tried once.

Two values share a cell when every maximal sub-expression about that input alone has the same value
at both: an input only compared with 100 and 300 has three cells.  An input that is copied or mixed
with other variables keeps a cell for each of its values.
"""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

from rovercheck.checker.system.wide_cells import CellNumbers
from rovercheck.spec_model.lang.action import Assign, If
from rovercheck.spec_model.lang.expr import Apply, Const, Expr, Named, Var
from rovercheck.spec_model.lang.operators import Op
from rovercheck.spec_model.lang.system import Program, TransitionSystem
from rovercheck.spec_model.lang.walk import plain


@dataclass(frozen=True)
class Cell:
    """Values that behave alike: one of them, the lowest, and how many there are."""

    value: int
    size: int


@dataclass(frozen=True)
class Partition:
    """The cells of one variable, ascending by representative; ``number[i]`` is the cell of the i-th
    admissible value ``values[i]``.  A value outside every cell is never admissible."""

    var: Var
    cells: tuple[Cell, ...]
    values: Sequence[int]
    numbers: Sequence[int]

    @cached_property
    def cell_of(self) -> Mapping[int, int]:
        """The number of the cell of each admissible value."""
        if isinstance(self.values, range):
            return CellNumbers(self.values, self.numbers)
        return dict(zip(self.values, self.numbers, strict=True))

    def members(self, number: int) -> Iterator[int]:
        """The values of a cell, ascending."""
        return (v for v, n in zip(self.values, self.numbers, strict=True) if n == number)


def partitions(system: TransitionSystem) -> dict[str, Partition]:
    """The cells of each input of the system, by name.

    Values that break a conjunct of the assumption about that input alone belong to no cell.  Raises
    ``TooManyValues``, which is a ``MemoryError``, for an input of which each of very many values matters.
    """
    roots = [*expressions(system.step), system.assume]
    scope = {v.name: v for v in system.inputs}
    alone = _alone(roots, scope)
    required = _required(system.assume, scope)
    return {n: _split(v, alone.get(n, ()), required.get(n, ())) for n, v in scope.items()}


def partition(var: Var, roots: Sequence[Expr], scope: Mapping[str, Var]) -> Partition:
    """The cells of one variable of the scope with respect to the expressions."""
    return _split(var, _alone(roots, scope).get(var.name, ()), ())


def expressions(program: Program) -> Iterator[Expr]:
    """Every condition and every assigned value of a program."""
    for statement in program:
        if isinstance(statement, Assign):
            yield statement.value
        else:
            yield statement.condition
            for branch in (statement.then, statement.otherwise):
                yield from expressions(tuple(s for s in branch if isinstance(s, Assign | If)))


def conjuncts(expr: Expr) -> tuple[Expr, ...]:
    """The parts of a conjunction; none for ``TRUE``."""
    body = plain(expr)
    if isinstance(body, Const) and body.value:
        return ()
    if isinstance(body, Apply) and body.op is Op.AND:
        return tuple(part for arg in body.args for part in conjuncts(arg))
    return (expr,)


# --- finding the sub-expressions about one variable ----------------------------------------------


def _alone(roots: Iterable[Expr], scope: Mapping[str, Var]) -> dict[str, list[Expr]]:
    """The maximal sub-expressions about a single variable of the scope, by its name."""
    found: dict[str, list[Expr]] = {}
    owners: dict[int, str | None] = {}
    seen: set[int] = set()
    stack = list(roots)
    while stack:
        expr = stack.pop()
        if id(expr) in seen:
            continue
        seen.add(id(expr))
        name = _owner(expr, owners)
        if name is not None and name in scope:
            found.setdefault(name, []).append(expr)
        elif isinstance(expr, Named):
            stack.append(expr.body)
        elif isinstance(expr, Apply) and expr.op in (Op.AND, Op.OR):
            _take_grouped(expr, scope, owners, found, stack)
        elif isinstance(expr, Apply):
            stack.extend(expr.args)
    return found


def _take_grouped(
    expr: Apply,
    scope: Mapping[str, Var],
    owners: dict[int, str | None],
    found: dict[str, list[Expr]],
    rest: list[Expr],
) -> None:
    """Arguments of one conjunction or disjunction about the same variable count as one formula."""
    grouped: dict[str, list[Expr]] = {}
    for arg in expr.args:
        name = _owner(arg, owners)
        if name is not None and name in scope:
            grouped.setdefault(name, []).append(arg)
        else:
            rest.append(arg)
    for name, args in grouped.items():
        found.setdefault(name, []).append(Apply(expr.op, tuple(args), expr.sort))


CONSTANT, MIXED = "", None


def _owner(expr: Expr, known: dict[int, str | None]) -> str | None:
    """The name of the only variable that occurs; CONSTANT for none, MIXED for several."""
    if id(expr) not in known:
        match expr:
            case Var(name):
                known[id(expr)] = name
            case Named(_, body):
                known[id(expr)] = _owner(body, known)
            case Apply(_, args, _):
                owners = {_owner(a, known) for a in args} - {CONSTANT}
                known[id(expr)] = CONSTANT if not owners else owners.pop() if len(owners) == 1 else MIXED
            case _:
                known[id(expr)] = CONSTANT
    return known[id(expr)]


def _required(assume: Expr, scope: Mapping[str, Var]) -> dict[str, list[Expr]]:
    """The conjuncts of the assumption about one input alone, by its name."""
    found: dict[str, list[Expr]] = {}
    for part in conjuncts(assume):
        name = _owner(part, {})
        if name is not None and name in scope:
            found.setdefault(name, []).append(part)
    return found


def _split(var: Var, alone: Sequence[Expr], required: Sequence[Expr]) -> Partition:
    """Cells numbered in the order of their lowest values."""
    from rovercheck.checker.system.cells import split  # by numpy, which takes a while to load

    cells, values, numbers = split(var, alone, required)
    return Partition(var, tuple(Cell(low, size) for low, size in cells), values, numbers)
