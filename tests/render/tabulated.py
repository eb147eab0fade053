"""Reachable ticks from a table, for graphs of which every edge is known."""

from collections.abc import Sequence

import numpy as np

from rovercheck.checker.explore.graphs.reachable_ticks import ReachableTicks
from rovercheck.spec_model.lang.expr import Var


def tabulated(
    variables: Sequence[Var],
    initial: Sequence[Sequence[int]],
    steps: Sequence[tuple[Sequence[int], Sequence[Sequence[int]]]],
    stopped: str = "",
) -> ReachableTicks:
    """Each expanded state with those it leads to, in breadth-first order."""
    numbers: dict[tuple[int, ...], int] = {}
    parents: list[int] = []
    for valuation in initial:
        numbers.setdefault(tuple(valuation), len(numbers))
    parents += [-1] * len(numbers)
    pairs: dict[tuple[int, int], None] = {}
    for valuation, afters in steps:
        source = numbers[tuple(valuation)]
        for after in afters:
            target = numbers.setdefault(tuple(after), len(numbers))
            parents += [source] * (len(numbers) - len(parents))
            pairs[source, target] = None
    ordered = sorted(pairs)
    columns = np.array(list(numbers), dtype=np.int64).reshape(len(numbers), len(variables)).T
    sources, targets = (np.array([p[i] for p in ordered], dtype=np.int64) for i in (0, 1))
    depths = np.zeros(len(numbers), dtype=np.int64)
    for number, parent in enumerate(parents):
        depths[number] = depths[parent] + 1 if parent >= 0 else 0
    levels = tuple(int(np.searchsorted(depths, d)) for d in range(int(depths.max(initial=0)) + 1))
    born = np.array(parents, dtype=np.int64)
    return ReachableTicks(
        tuple(variables), columns, len(initial), levels, born, sources, targets, len(steps), stopped
    )
