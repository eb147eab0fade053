"""From a closed set of valuations to its decision diagram, bottom-up, level by level."""

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from checker.certify.diagram import TRUE, Diagram, Node, size
from checker.closed import ClosedSet, Place

Codes = NDArray[np.signedinteger[Any]]
Words = NDArray[np.uint64]

LARGE = 1 << 20
"""Valuations from which on fewer orders are tried."""


def diagram(closed: ClosedSet) -> Diagram:
    """The diagram of the set in that one of a few orders of its variables in which it is smallest."""
    if not closed.places:  # the goals depend on inputs alone
        return Diagram((), (), TRUE)
    codes = [_codes(place, closed.words) for place in closed.places]
    found = (
        reduced([closed.places[i] for i in order], [codes[i] for i in order]) for order in _orders(codes)
    )
    return min(found, key=size)


def _orders(codes: Sequence[Codes]) -> Iterator[list[int]]:
    """As declared, those with many values first, those with few values first, and backwards.

    For a large set two of them must do.
    """
    everyone = list(range(len(codes)))
    values = [int(column.max(initial=0)) for column in codes]
    few_first = sorted(everyone, key=lambda i: values[i])
    many_first = sorted(everyone, key=lambda i: -values[i])
    yield everyone
    yield many_first
    if len(codes[0]) <= LARGE:
        yield few_first
        yield everyone[::-1]


def _codes(place: Place, words: Words) -> Codes:
    column = words[:, place.word] >> np.uint64(place.shift) & np.uint64((1 << place.bits) - 1)
    return column.astype(np.int16 if place.bits < 16 else np.int32 if place.bits < 32 else np.int64)


def reduced(places: Sequence[Place], codes: Sequence[Codes]) -> Diagram:
    """The diagram of distinct rows, one column of codes for each variable, in this order."""
    order = np.lexsort(codes[::-1])
    columns = [column[order] for column in codes]
    changed = _first_difference(columns)
    child = np.zeros(len(order), dtype=np.int64)
    nodes: list[Node] = []
    for level in reversed(range(len(places))):
        starts = np.flatnonzero(changed < level)
        child = _level(places[level], level, columns[level], child, starts, nodes)
        columns = [column[starts] for column in columns[:level]]
        changed = changed[starts]
    return Diagram(tuple(p.var.name for p in places), tuple(nodes), int(child[0]))


def _first_difference(columns: Sequence[Codes]) -> NDArray[np.int32]:
    """The first column in which each row differs from the one before; -1 for the first row."""
    rows = len(columns[0])
    changed = np.full(rows, len(columns), dtype=np.int32)
    for level in reversed(range(len(columns))):
        changed[1:][columns[level][1:] != columns[level][:-1]] = level
    changed[:1] = -1
    return changed


def _level(place: Place, level: int, values: Codes, child: Codes, starts: Codes, nodes: list[Node]) -> Codes:
    """The node of each group of rows that begins at ``starts``; new ones are appended.

    Groups with the same values and children share a node.
    """
    sizes = np.diff(starts, append=len(values))
    group = _alike(values, child, starts, sizes)
    _, firsts, numbers = np.unique(group, return_index=True, return_inverse=True)
    made = [
        _node(place, level, values[s : s + n], child[s : s + n], nodes)
        for s, n in zip(starts[firsts].tolist(), sizes[firsts].tolist(), strict=True)
    ]
    return np.array(made, dtype=np.int64)[numbers]


def _node(place: Place, level: int, values: Codes, child: Codes, nodes: list[Node]) -> int:
    """The number of the node with these edges; none is needed where every value leads to the same one."""
    domain = place.var.domain
    low = values.astype(np.int64) * place.stride + place.low
    ends = np.flatnonzero((np.diff(low) != 1) | (np.diff(child) != 0))
    first, last = np.r_[0, ends + 1], np.r_[ends, len(low) - 1]
    if len(low) == len(domain) and (child == child[0]).all():
        return int(child[0])
    edges = zip(low[first].tolist(), low[last].tolist(), child[first].tolist(), strict=True)
    nodes.append(Node(level, tuple(edges)))
    return len(nodes)


def _alike(values: Codes, child: Codes, starts: Codes, sizes: Codes) -> Codes:
    """A number for each group of rows: the same for two groups if and only if they hold the same.

    Groups are compared with the first one of their hash, row by row; where one differs, others are drawn.
    """
    for seed in range(64):
        hashes = np.add.reduceat(_mixed(values, child, seed), starts)
        _, firsts, numbers = np.unique(hashes, return_index=True, return_inverse=True)
        if _confirmed(values, child, starts, sizes, firsts[numbers]):
            return numbers
    raise AssertionError("64 hashes in a row collide")


def _confirmed(values: Codes, child: Codes, starts: Codes, sizes: Codes, model: Codes) -> bool:
    """Whether each group holds the same as its model, which is the position of another group."""
    if not np.array_equal(sizes, sizes[model]):
        return False
    rows = np.arange(len(values)) + np.repeat(starts[model] - starts, sizes)
    return bool(np.array_equal(values, values[rows]) and np.array_equal(child, child[rows]))


def _mixed(values: Codes, child: Codes, seed: int) -> Words:
    """A hash of each row (the finalizer of SplitMix64: Steele, Lea, Flood, OOPSLA 2014)."""
    odd = np.random.default_rng(seed).integers(1, 1 << 63, 3, dtype=np.uint64) | np.uint64(1)
    mixed = values.astype(np.uint64) * odd[0] ^ child.astype(np.uint64) * odd[1] ^ odd[2]
    for shift, factor in ((30, 0xBF58476D1CE4E5B9), (27, 0x94D049BB133111EB)):
        mixed = (mixed ^ mixed >> np.uint64(shift)) * np.uint64(factor)
    return np.asarray(mixed ^ mixed >> np.uint64(31), dtype=np.uint64)
