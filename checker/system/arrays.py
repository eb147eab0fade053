"""Formulas on arrays: their values for many valuations at once, one place in an array for each."""

from collections.abc import Callable, Mapping, Sequence
from functools import reduce
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rovercheck.checker.system.intervals import Interval, intervals, postorder
from rovercheck.spec_model.lang.domain import Bool
from rovercheck.spec_model.lang.expr import Apply, Const, Expr, Named, Var
from rovercheck.spec_model.lang.operators import Op

Column = NDArray[Any]
"""A value for each of many valuations: truth values of numpy's bool, numbers of int64, or Python's own
where 64 bits may not suffice."""
Columns = Mapping[str, Column]

_MACHINE = Interval(-(1 << 63), (1 << 63) - 1)


class ArrayProgram:
    """Formulas compiled to a list of array operations; equal nodes are computed once.

    Where a value may leave the 64-bit numbers all are computed with Python's numbers, slowly.
    """

    def __init__(self, exprs: Sequence[Expr]) -> None:
        self._roots = list(exprs)
        self._nodes = list(postorder(*exprs))
        known = intervals(*exprs)
        wide = not all(i.within(_MACHINE) for i in known.values())
        places = {id(node): place for place, node in enumerate(self._nodes)}
        self._steps = [_operation(node, places, wide) for node in self._nodes]
        self._results = [(places[id(e)], wide and known[id(e)].within(_MACHINE)) for e in exprs]

    def __call__(self, at: Columns) -> list[Column]:
        """The values of the formulas; each is an array, or a single value when it is the same everywhere."""
        done: list[Any] = []
        for step in self._steps:
            done.append(step(done, at))
        return [_narrow(done[place]) if narrow else done[place] for place, narrow in self._results]


def _narrow(values: Any) -> Column:
    """Numbers of the machine, again."""
    found = np.asarray(values)
    return found.astype(np.int64) if found.dtype == object else found


_Step = Callable[[list[Any], Columns], Any]


def _operation(node: Expr, places: Mapping[int, int], wide: bool) -> _Step:
    match node:
        case Const(value, sort):
            constant: Column = np.asarray(value, dtype=np.bool_ if isinstance(sort, Bool) else _number(wide))
            return lambda done, at: constant
        case Var(name, domain):
            if wide and not isinstance(domain.sort, Bool):
                return lambda done, at: at[name].astype(object)
            return lambda done, at: at[name]
        case Named(_, body):
            place = places[id(body)]
            return lambda done, at: done[place]
        case Apply(op, args, sort):
            operate, chosen = OPERATIONS[op], [places[id(a)] for a in args]
            if wide and not isinstance(sort, Bool):  # of single values numpy makes numbers of the machine
                return lambda done, at: np.asarray(operate(*[done[place] for place in chosen]), dtype=object)
            return lambda done, at: operate(*[done[place] for place in chosen])
    raise AssertionError(f"{node} speaks of the past")


OPERATIONS: Mapping[Op, Callable[..., Any]] = {
    Op.NOT: np.logical_not,
    Op.AND: lambda *a: reduce(np.logical_and, a),
    Op.OR: lambda *a: reduce(np.logical_or, a),
    Op.ITE: np.where,
    Op.EQ: np.equal,
    Op.NE: np.not_equal,
    Op.LT: np.less,
    Op.LE: np.less_equal,
    Op.GT: np.greater,
    Op.GE: np.greater_equal,
    Op.ADD: np.add,
    Op.SUB: np.subtract,
    Op.NEG: np.negative,
    Op.MUL: np.multiply,
    Op.SCALE: np.multiply,
    Op.DIV: np.floor_divide,
    Op.MOD: np.mod,
    Op.ABS: np.abs,
    Op.MIN: np.minimum,
    Op.MAX: np.maximum,
    Op.BIT: lambda a, b: np.not_equal(a >> b & 1, 0),
}
"""Every operator on arrays; rounding is that of the reference: down."""


def _number(wide: bool) -> type:
    return object if wide else np.int64


def element(var: Var) -> type:
    """The type of a variable's values in a column."""
    hull = Interval(var.domain.low, var.domain.high)
    return np.bool_ if isinstance(var.sort, Bool) else _number(not hull.within(_MACHINE))


def column(var: Var, values: Sequence[int] | Column) -> Column:
    """The raw values of a variable as a column."""
    return np.asarray(values, dtype=element(var))
