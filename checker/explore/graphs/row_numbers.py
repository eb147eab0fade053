"""Rows of numbers distinguished: which are equal, and a number for each in order of first appearance."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

Numbers = NDArray[np.int64]


def numbered(columns: Sequence[NDArray[Any]], rows: int) -> tuple[Numbers, Numbers]:
    """The first row of each kind, ascending, and for each row the number of its kind in that order.

    Without columns all rows are of one kind.
    """
    if not rows:
        empty = np.zeros(0, dtype=np.int64)
        return empty, empty
    order = np.lexsort(columns[::-1]) if columns else np.arange(rows)
    new = np.zeros(rows, dtype=np.bool_)
    new[0] = True
    for column in columns:
        new[1:] |= column[order[1:]] != column[order[:-1]]
    kind: Numbers = np.empty(rows, dtype=np.int64)
    kind[order] = np.cumsum(new) - 1
    first = order[new]  # the sort keeps the order of equal rows
    rank = np.empty(len(first), dtype=np.int64)
    rank[np.argsort(first)] = np.arange(len(first))
    return np.sort(first), rank[kind]
