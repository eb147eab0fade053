"""Formulas as JSON, for invariants that are kept: raw numbers, names of variables, and operators first.

``["or", ["not", "relay"], ["<=", ["-", "age", "limit"], 3]]``; truth values are ``true`` and ``false``.
"""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import Any

from rovercheck.spec_model.lang.domain import Bool, Num, Sort
from rovercheck.spec_model.lang.expr import Apply, Const, Expr, Named, Var
from rovercheck.spec_model.lang.operators import Op
from rovercheck.spec_model.lang.walk import children

Tree = Any
"""What JSON makes of a formula: nested lists of texts, whole numbers and truth values."""

_MOST = 1 << 63
"""Numbers are smaller than this: no domain holds larger ones."""


class Unreadable(Exception):
    """It is no formula over the variables; the message says what it is instead."""


def written(expr: Expr) -> Tree:
    """The formula as JSON, names of formulas left out."""
    match expr:
        case Var(name):
            return name
        case Const(value, sort):
            return bool(value) if isinstance(sort, Bool) else value
        case Named(_, body):
            return written(body)
        case Apply(op, args):
            return [op.value, *map(written, args)]
    raise AssertionError(f"{expr.__class__.__name__} is lowered before engines see it")


def size(expr: Expr) -> int:
    """Operators, variables and numbers of the formula as it is written: shared parts count each time."""
    from rovercheck.checker.system.intervals import (
        postorder,  # not loaded by those that only pass formulas on
    )

    sizes: dict[int, int] = {}
    for node in postorder(expr):
        sizes[id(node)] = 1 + sum(sizes[id(child)] for child in children(node))
    return sizes[id(expr)]


def formula(tree: Tree, variables: Mapping[str, Var]) -> Expr:
    """The formula that was written, over variables as they are now.

    Of a number, and of what is computed of numbers, the sort is that of a variable beside it: engines read
    raw numbers.  Raises ``Unreadable``, also where a variable does not exist or has got another sort.
    """
    try:
        return _formula(tree, variables, Num())
    except RecursionError:
        raise Unreadable("it is nested too deeply") from None


def readable(trees: Iterable[Tree], variables: Mapping[str, Var]) -> Iterator[Expr]:
    """The truth values among what was written that are still formulas over the variables."""
    for tree in trees:
        try:
            found = formula(tree, variables)
        except Unreadable:
            continue
        if isinstance(found.sort, Bool):
            yield found


def _formula(tree: Tree, variables: Mapping[str, Var], beside: Sort) -> Expr:
    match tree:
        case bool():
            return Const(int(tree), Bool())
        case int() if -_MOST <= tree < _MOST:
            return Const(tree, beside)
        case str() if tree in variables:
            return variables[tree]
        case [str(op), *args] if op in list(Op) and args:
            return _applied(Op(op), args, variables, beside)
    raise Unreadable(f"{str(tree)[:60]} is no formula over these variables")


def _applied(op: Op, trees: Sequence[Tree], variables: Mapping[str, Var], beside: Sort) -> Expr:
    known = [None if _number(t) else _formula(t, variables, beside) for t in trees]
    sorts = [e.sort for e in known if e is not None and not isinstance(e.sort, Bool)]
    near = sorts[0] if sorts else beside
    args = [_formula(t, variables, near) if e is None else e for e, t in zip(known, trees, strict=True)]
    sort = OPERATIONS[op](args)
    if sort is None:
        raise Unreadable(f"{str([op.value, *trees])[:60]}: {op.value} does not take these arguments")
    return Apply(op, tuple(args), sort)


def _number(tree: Tree) -> bool:
    return isinstance(tree, int) and not isinstance(tree, bool)


def _truth(expr: Expr) -> bool:
    return isinstance(expr.sort, Bool)


Sorted = Callable[[Sequence[Expr]], Sort | None]
"""The sort of an operator's result; None where it does not take such arguments."""


def _negation(args: Sequence[Expr]) -> Sort | None:
    return Bool() if len(args) == 1 and _truth(args[0]) else None


def _junction(args: Sequence[Expr]) -> Sort | None:
    return Bool() if len(args) > 1 and all(map(_truth, args)) else None


def _choice(args: Sequence[Expr]) -> Sort | None:
    match args:
        case [test, then, otherwise] if _truth(test) and _truth(then) == _truth(otherwise):
            return then.sort
    return None


def _order(args: Sequence[Expr]) -> Sort | None:
    return Bool() if len(args) == 2 and not any(map(_truth, args)) else None


def _equality(args: Sequence[Expr]) -> Sort | None:
    return Bool() if len(args) == 2 and len({*map(_truth, args)}) == 1 else None


def _numbers(count: int) -> Sorted:
    return lambda args: args[0].sort if len(args) == count and not any(map(_truth, args)) else None


def _by_constant(args: Sequence[Expr]) -> Sort | None:
    match args:
        case [one, Const(value) as by] if not _truth(one) and not _truth(by) and value > 0:
            return one.sort
    return None


def _bit(args: Sequence[Expr]) -> Sort | None:
    match args:
        case [one, Const(value) as index] if not _truth(one) and not _truth(index) and value >= 0:
            return Bool()
    return None


OPERATIONS: Mapping[Op, Sorted] = {
    Op.NOT: _negation,
    **dict.fromkeys((Op.AND, Op.OR), _junction),
    Op.ITE: _choice,
    **dict.fromkeys((Op.EQ, Op.NE), _equality),
    **dict.fromkeys((Op.LT, Op.LE, Op.GT, Op.GE), _order),
    **dict.fromkeys((Op.NEG, Op.ABS), _numbers(1)),
    **dict.fromkeys((Op.ADD, Op.SUB, Op.MUL, Op.MIN, Op.MAX), _numbers(2)),
    **dict.fromkeys((Op.SCALE, Op.DIV, Op.MOD), _by_constant),
    Op.BIT: _bit,
}
"""What every operator takes and makes."""
