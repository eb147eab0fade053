"""Formulas as JSON, for invariants that are kept: raw numbers, names of variables, and operators first.

``["or", ["not", "relay"], ["<=", ["-", "age", "limit"], 3]]``; truth values are ``true`` and ``false``.
"""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

from rovercheck.spec_model.lang.domain import Bool, Num, Sort
from rovercheck.spec_model.lang.expr import Apply, Const, Expr, Named, Var
from rovercheck.spec_model.lang.operators import COMPARISONS, Op
from rovercheck.spec_model.lang.walk import children

Tree = Any
"""What JSON makes of a formula: nested lists of texts, whole numbers and truth values."""

_LOGIC = frozenset({Op.AND, Op.OR})
_CONSTANT_RIGHT = frozenset({Op.SCALE, Op.DIV, Op.MOD, Op.BIT})
_ONE = frozenset({Op.NEG, Op.ABS})
_TWO = frozenset({Op.ADD, Op.SUB, Op.MUL, Op.MIN, Op.MAX})
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
    sort = _sort(op, args)
    if sort is None:
        raise Unreadable(f"{str([op.value, *trees])[:60]}: {op.value} does not take these arguments")
    return Apply(op, tuple(args), sort)


def _number(tree: Tree) -> bool:
    return isinstance(tree, int) and not isinstance(tree, bool)


def _sort(op: Op, args: Sequence[Expr]) -> Sort | None:
    """The sort of the result; None where the operator does not take such arguments."""
    truths = [isinstance(a.sort, Bool) for a in args]
    match args:
        case [_] if op is Op.NOT and all(truths):
            return Bool()
        case [_, *_] if op in _LOGIC and all(truths):
            return Bool()
        case [_, then, _] if op is Op.ITE and truths[0] and truths[1] == truths[2]:
            return then.sort
        case [_, _] if op in COMPARISONS and (not any(truths) or (all(truths) and op in (Op.EQ, Op.NE))):
            return Bool()
        case [one] if op in _ONE and not any(truths):
            return one.sort
        case [one, Const(value)] if op in _CONSTANT_RIGHT and not any(truths):
            allowed = value >= 0 if op is Op.BIT else value > 0
            return (Bool() if op is Op.BIT else one.sort) if allowed else None
        case [one, _] if op in _TWO and not any(truths):
            return one.sort
    return None
