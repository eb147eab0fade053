"""Values of a variable that no formula about it alone can tell apart: each formula is evaluated at all."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from rovercheck.checker.system.intervals import intervals
from rovercheck.spec_model.lang.expr import Apply, Const, Expr, Named, Var
from rovercheck.spec_model.lang.operators import Op

Array = NDArray[np.int64]
Split = tuple[list[tuple[int, int]], tuple[int, ...], tuple[int, ...]]
"""The lowest value and the size of each cell; the admissible values; the number of the cell of each."""


def split(var: Var, alone: Sequence[Expr], required: Sequence[Expr]) -> Split:
    """The cells of the values that meet what is ``required``, ascending by their lowest values."""
    values: Array = np.array(var.domain.values, dtype=np.int64)
    for condition in required:
        values = values[_at(condition, var, values) != 0]
    cell = np.zeros(len(values), dtype=np.int64)
    for expr in alone:
        _, codes = np.unique(_at(expr, var, values), return_inverse=True)
        _, cell = np.unique(cell * (int(codes.max(initial=0)) + 1) + codes, return_inverse=True)
    return _numbered(values, cell)


def _numbered(values: Array, cell: Array) -> Split:
    _, first, back, sizes = np.unique(cell, return_index=True, return_inverse=True, return_counts=True)
    order = np.argsort(first)
    rank = np.empty(len(order), dtype=np.int64)
    rank[order] = np.arange(len(order))
    cells = [(int(values[first[i]]), int(sizes[i])) for i in order]
    return cells, tuple(map(int, values)), tuple(map(int, rank[back]))


def _at(expr: Expr, var: Var, values: Array) -> Array:
    """The formula at every value of its only variable; in Python integers where 64 bits could overflow."""
    wide = any(not -(1 << 62) < end < 1 << 62 for i in intervals(expr).values() for end in (i.low, i.high))
    column = values.astype(object) if wide else values
    result = _array(expr, column, {})
    return np.broadcast_to(result, values.shape)


def _array(expr: Expr, column: Array, known: dict[int, Array]) -> Array:
    if id(expr) not in known:
        match expr:
            case Const(value, _):
                known[id(expr)] = np.array(value, dtype=column.dtype)
            case Var():
                known[id(expr)] = column
            case Named(_, body):
                known[id(expr)] = _array(body, column, known)
            case Apply(op, args, _):
                known[id(expr)] = _operate(op, [_array(a, column, known) for a in args]).astype(column.dtype)
            case _:
                raise AssertionError(f"{expr} speaks of the past")
    return known[id(expr)]


def _operate(op: Op, v: list[Array]) -> Array:
    """An operator on arrays of raw values, as ``spec_model.lang.evaluate.operate`` on one."""
    match op:
        case Op.NOT:
            return np.asarray(1 - v[0])
        case Op.AND | Op.OR:
            fold = np.logical_and if op is Op.AND else np.logical_or
            result = v[0] != 0
            for other in v[1:]:
                result = fold(result, other != 0)
            return np.asarray(result)
        case Op.ITE:
            return np.where(v[0] != 0, v[1], v[2])
        case Op.EQ:
            return np.asarray(v[0] == v[1])
        case Op.NE:
            return np.asarray(v[0] != v[1])
        case Op.LT:
            return np.asarray(v[0] < v[1])
        case Op.LE:
            return np.asarray(v[0] <= v[1])
        case Op.GT:
            return np.asarray(v[0] > v[1])
        case Op.GE:
            return np.asarray(v[0] >= v[1])
        case Op.NEG:
            return np.asarray(-v[0])
        case Op.ABS:
            return np.asarray(abs(v[0]))
        case _:
            return _arithmetic(op, v[0], v[1])


def _arithmetic(op: Op, a: Array, b: Array) -> Array:
    match op:
        case Op.ADD:
            return np.asarray(a + b)
        case Op.SUB:
            return np.asarray(a - b)
        case Op.MUL | Op.SCALE:
            return np.asarray(a * b)
        case Op.DIV:
            return np.asarray(a // b)
        case Op.MOD:
            return np.asarray(a % b)
        case Op.MIN:
            return np.minimum(a, b)
        case Op.MAX:
            return np.maximum(a, b)
        case Op.BIT:
            return np.asarray(a >> b & 1)
    raise AssertionError(op)
