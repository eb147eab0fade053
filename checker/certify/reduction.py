"""From a closed set of states to its decision diagram, bottom-up, level by level."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rovercheck.checker.certify.diagram import TRUE, CertifiedDiagram, Nodes
from rovercheck.checker.results.closed_set import BitPlace, ClosedSet

Codes = NDArray[np.signedinteger[Any]]
Words = NDArray[np.uint64]

LARGE = 1 << 20
"""States from which on one order is tried."""


def diagram(closed: ClosedSet) -> CertifiedDiagram:
    """The diagram of the set in that one of a few orders of its variables in which it is smallest."""
    if not closed.places:  # the goals depend on inputs alone
        return CertifiedDiagram((), Nodes.of(()), TRUE)
    codes = [_codes(place, closed.words) for place in closed.places]
    found = (
        reduced([closed.places[i] for i in order], [codes[i] for i in order]) for order in _orders(codes)
    )
    return min(found, key=lambda one: one.size).diagram


def _orders(codes: Sequence[Codes]) -> Iterator[list[int]]:
    """As declared, those with many values first, those with few values first, and backwards.

    For a large set the first must do.
    """
    everyone = list(range(len(codes)))
    values = [int(column.max(initial=0)) for column in codes]
    few_first = sorted(everyone, key=lambda i: values[i])
    many_first = sorted(everyone, key=lambda i: -values[i])
    yield everyone
    if len(codes[0]) <= LARGE:
        yield many_first
        yield few_first
        yield everyone[::-1]


def _codes(place: BitPlace, words: Words) -> Codes:
    column = words[:, place.word] >> np.uint64(place.shift) & np.uint64((1 << place.bits) - 1)
    return column.astype(np.int16 if place.bits < 16 else np.int32 if place.bits < 32 else np.int64)


@dataclass(frozen=True)
class ReductionLevel:
    """The nodes of one variable: the ends of their edges and where these lead, node after node.

    ``sizes`` are the numbers of edges of each node.
    """

    position: int
    sizes: Codes
    low: Codes
    high: Codes
    to: Codes


@dataclass(frozen=True)
class ReducedLevels:
    """The levels of a diagram, the last variable first."""

    places: tuple[BitPlace, ...]
    levels: tuple[ReductionLevel, ...]
    root: int

    @property
    def size(self) -> int:
        """The number of nodes and edges."""
        return sum(len(level.sizes) + len(level.to) for level in self.levels)

    @property
    def diagram(self) -> CertifiedDiagram:
        """The diagram."""
        sizes = np.concatenate([level.sizes for level in self.levels])
        variable = np.repeat([n.position for n in self.levels], [len(n.sizes) for n in self.levels])
        owner = np.repeat(np.arange(len(sizes)), sizes)
        edges = (np.concatenate(c) for c in zip(*((n.low, n.high, n.to) for n in self.levels), strict=True))
        nodes = Nodes(variable, owner, *edges)
        return CertifiedDiagram(tuple(p.var.name for p in self.places), nodes, self.root)


def reduced(places: Sequence[BitPlace], codes: Sequence[Codes]) -> ReducedLevels:
    """The diagram of distinct rows, one column of codes for each variable, in this order."""
    order = np.lexsort(codes[::-1])
    changed = _first_difference([column[order] for column in codes])
    child = np.zeros(len(order), dtype=np.int64)
    made: list[ReductionLevel] = []
    known = 0
    for level in reversed(range(len(places))):
        starts = np.flatnonzero(changed < level)
        child, nodes = _level(places[level], level, codes[level][order], child, starts, known)
        made.append(nodes)
        known += len(nodes.sizes)
        order, changed = order[starts], changed[starts]
    return ReducedLevels(tuple(places), tuple(made), int(child[0]))


def _first_difference(columns: Sequence[Codes]) -> NDArray[np.int32]:
    """The first column in which each row differs from the one before; -1 for the first row."""
    rows = len(columns[0])
    changed = np.full(rows, len(columns), dtype=np.int32)
    for level in reversed(range(len(columns))):
        changed[1:][columns[level][1:] != columns[level][:-1]] = level
    changed[:1] = -1
    return changed


def _level(
    place: BitPlace, level: int, values: Codes, child: Codes, starts: Codes, known: int
) -> tuple[Codes, ReductionLevel]:
    """The node of each group of rows that begins at ``starts``, and the nodes that are new.

    Groups with the same values and children share a node; none is needed where every value leads to the same
    one.
    """
    sizes = np.diff(starts, append=len(values))
    group = _alike(values, child, starts, sizes)
    _, firsts, numbers = np.unique(group, return_index=True, return_inverse=True)
    rows, begins = _rows(starts[firsts], sizes[firsts])
    sizes = sizes[firsts]
    low = values[rows].astype(np.int64) * place.stride + place.low
    to = child[rows]
    one_child = np.minimum.reduceat(to, begins) == np.maximum.reduceat(to, begins)
    needed = ~(one_child & (sizes == len(place.var.domain)))
    first = np.ones(len(low), dtype=np.bool_)
    first[1:] = (np.diff(low) != 1) | (np.diff(to) != 0)
    first[begins] = True
    edges = np.flatnonzero(first)
    ends = np.append(edges[1:], len(low)) - 1
    owner = np.repeat(np.arange(len(sizes)), sizes)[edges]
    kept = needed[owner]
    made = np.where(needed, known + np.cumsum(needed), to[begins])
    count = np.bincount(owner, minlength=len(sizes))[needed]
    return made[numbers], ReductionLevel(level, count, low[edges][kept], low[ends][kept], to[edges][kept])


def _rows(starts: Codes, sizes: Codes) -> tuple[Codes, Codes]:
    """The rows of groups, one after the other, and where each group begins among them."""
    begins = np.cumsum(sizes) - sizes
    return np.arange(int(sizes.sum())) + np.repeat(starts - begins, sizes), begins


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
    rows, _ = _rows(starts[model], sizes)
    return bool(np.array_equal(values, values[rows]) and np.array_equal(child, child[rows]))


def _mixed(values: Codes, child: Codes, seed: int) -> Words:
    """A hash of each row (the finalizer of SplitMix64: Steele, Lea, Flood, OOPSLA 2014)."""
    odd = np.random.default_rng(seed).integers(1, 1 << 63, 3, dtype=np.uint64) | np.uint64(1)
    mixed = values.astype(np.uint64) * odd[0] ^ child.astype(np.uint64) * odd[1] ^ odd[2]
    for shift, factor in ((30, 0xBF58476D1CE4E5B9), (27, 0x94D049BB133111EB)):
        mixed = (mixed ^ mixed >> np.uint64(shift)) * np.uint64(factor)
    return np.asarray(mixed ^ mixed >> np.uint64(31), dtype=np.uint64)
