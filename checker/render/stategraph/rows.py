"""A quick layout for graphs that are long or dense: ranks in rows like lines of text, lines as curves.

The layered layout routes every line around all boxes, which takes long where many lines cross many ranks,
and a chain of a hundred nodes would be a picture nobody can scroll through.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import ceil, hypot

from checker.results.graph import StateGraph

GAP_X, GAP_Y, ROW = 56, 16, 46
"""Pixels between columns, between boxes of a column, and between rows."""
LONG = 26
"""Ranks from which on a graph is laid out in rows."""
DENSE = 900
"""Ranks that all lines cross together from which on it is, too."""
SHAPE = 1.7
"""Width of the picture for its height."""

Sizes = Mapping[int, tuple[int, int]]


@dataclass(frozen=True)
class GraphRows:
    """The top-left corner of each box, and the whole size."""

    at: Mapping[int, tuple[int, int]]
    width: int
    height: int


def ranks(graph: StateGraph) -> list[int]:
    """The edges from an initial node to each node, on the shortest way."""
    following: dict[int, list[int]] = {}
    for edge in graph.edges:
        following.setdefault(edge.source, []).append(edge.target)
    level = [n.number for n in graph.nodes if n.initial]
    found = dict.fromkeys(level, 0)
    rank = 0
    while level:
        rank += 1
        after = [t for n in level for t in following.get(n, ()) if t not in found]
        level = list(dict.fromkeys(after))
        found |= dict.fromkeys(level, rank)
    return [found.get(n.number, 0) for n in graph.nodes]


def too_long(graph: StateGraph) -> bool:
    """Whether the layered layout would take too long, or too much room."""
    rank = ranks(graph)
    crossed = sum(abs(rank[e.source] - rank[e.target]) for e in graph.edges)
    return max(rank, default=0) >= LONG or crossed >= DENSE


def in_rows(graph: StateGraph, sizes: Sizes) -> GraphRows:
    """Columns of boxes, as many beside each other as make the picture neither wide nor high.

    A rank of very many boxes has several columns.
    """
    most = max(8, ceil(len(graph.nodes) ** 0.5))
    columns = [one[i : i + most] for one in _ordered(graph) for i in range(0, len(one), most)]
    wide = [max(sizes[n][0] for n in column) + GAP_X for column in columns]
    high = [sum(sizes[n][1] + GAP_Y for n in column) for column in columns]
    room = max(max(wide, default=0), (sum(w * h for w, h in zip(wide, high, strict=True)) * SHAPE) ** 0.5)
    at: dict[int, tuple[int, int]] = {}
    x = y = below = right = 0
    for column, width, height in zip(columns, wide, high, strict=True):
        if x and x + width > ceil(room * 1.1):
            x, y = 0, y + below + ROW
            below = 0
        top = y
        for number in column:
            at[number] = x, top
            top += sizes[number][1] + GAP_Y
        x, below, right = x + width, max(below, height), max(right, x + width)
    return GraphRows(at, right, y + below)


def _ordered(graph: StateGraph) -> list[list[int]]:
    """The nodes by rank; those of a rank by where their neighbours in the rank before are."""
    rank = ranks(graph)
    columns: list[list[int]] = [[] for _ in range(max(rank, default=0) + 1)]
    for node in graph.nodes:
        columns[rank[node.number]].append(node.number)
    before: dict[int, list[int]] = {}
    for edge in graph.edges:
        if rank[edge.source] == rank[edge.target] - 1:
            before.setdefault(edge.target, []).append(edge.source)
    for previous, column in pairwise(columns):
        place = {number: i for i, number in enumerate(previous)}
        means = {n: sum(place[m] for m in before[n]) / len(before[n]) for n in column if n in before}
        column.sort(key=lambda n: (means.get(n, 0.0), n))
    return columns


def curve(
    source: tuple[int, int, int, int], target: tuple[int, int, int, int]
) -> tuple[str, Sequence[tuple[int, int]]]:
    """The ``d`` of a curve between two boxes (x, y, width, height), and its last stretch, for the head."""
    sx, sy, sw, sh = source
    tx, ty, tw, th = target
    if tx >= sx + sw:  # forward: from the right side to the left side
        a, b = (sx + sw, sy + sh // 2), (tx, ty + th // 2)
        bend = max(24, (b[0] - a[0]) // 2)
        c, d = (a[0] + bend, a[1]), (b[0] - bend, b[1])
    elif abs(ty - sy) < max(sh, th):  # back in the same row: below both
        a, b = (sx + sw // 2, sy + sh), (tx + tw // 2, ty + th)
        depth = 20 + min(60, abs(sx - tx) // 14)
        c, d = (a[0], a[1] + depth), (b[0], b[1] + depth)
    else:
        down = ty > sy
        a = (sx + sw // 2, sy + sh if down else sy)
        b = (tx + tw // 2, ty if down else ty + th)
        bend = (1 if down else -1) * max(20, abs(b[1] - a[1]) // 3)
        c, d = (a[0], a[1] + bend), (b[0], b[1] - bend)
    length = max(1.0, hypot(b[0] - d[0], b[1] - d[1]))
    last = round(b[0] - 20 * (b[0] - d[0]) / length), round(b[1] - 20 * (b[1] - d[1]) / length)
    return f"M{a[0]} {a[1]}C{c[0]} {c[1]} {d[0]} {d[1]} {b[0]} {b[1]}", (last, b)
