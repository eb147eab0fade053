"""Values of a variable that no formula about it alone can tell apart: each formula is evaluated at all."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from rovercheck.checker.system.arrays import ArrayProgram, Column, column
from rovercheck.checker.system.wide_cells import MOST_LISTED, split_wide
from rovercheck.spec_model.lang.expr import Expr, Var

Array = NDArray[np.int64]
Split = tuple[list[tuple[int, int]], Sequence[int], Sequence[int]]
"""The lowest value and the size of each cell; the admissible values; the number of the cell of each."""


def split(var: Var, alone: Sequence[Expr], required: Sequence[Expr]) -> Split:
    """The cells of the values that meet what is ``required``, ascending by their lowest values.

    Raises ``TooManyValues`` for a variable of which each of very many values matters.
    """
    if len(var.domain) > MOST_LISTED and var.domain.dense:
        return split_wide(var, alone, required)
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


def _at(expr: Expr, var: Var, values: Array) -> Column:
    """The formula at every value of its only variable."""
    (found,) = ArrayProgram([expr])({var.name: column(var, values)})
    return np.broadcast_to(found, values.shape)
