"""A state graph in words: its nodes, its edges, and the ticks of a run along them."""

from collections.abc import Iterable
from itertools import groupby

from rovercheck.checker.results.graph import GraphEdge, GraphNode, StateGraph
from rovercheck.spec_model.lang.chart import NOWHERE

LEGEND = (
    "×n: n states behind a node, or n pairs of states behind an edge; "
    "on an edge: inputs that lead there from one of the states, whatever the other inputs are; "
    "dashed: only some of the states have such a tick"
)


def values(graph: StateGraph, node: GraphNode) -> tuple[str, ...]:
    """``name = value`` of each variable; charts without an active state are left out where others are not."""
    pairs = list(zip(graph.variables, node.shown, strict=True))
    some = [f"{name} = {value}" for name, value in pairs if value != NOWHERE]
    return tuple(some or [f"{name} = {value}" for name, value in pairs])


def short(graph: StateGraph, node: GraphNode) -> tuple[str, ...]:
    """The values in few words: no name for an only variable, and of other names what follows the last dot.

    Charts without an active state are left out where others are not, and so is a state inside which another
    is told.
    """
    last = [name.rpartition(".")[2] for name in graph.variables]
    names = [
        tail if last.count(tail) == 1 else name for name, tail in zip(graph.variables, last, strict=True)
    ]
    if len(names) == 1:
        return node.shown
    told = {name for name, value in zip(graph.variables, node.shown, strict=True) if value != NOWHERE}
    some = [
        f"{name} = {value}"
        for whole, name, value in zip(graph.variables, names, node.shown, strict=True)
        if whole in told and f"{whole}.{value}" not in told
    ]
    return tuple(some or [NOWHERE])


def named(graph: StateGraph, number: int) -> str:
    """A node in one line."""
    return ", ".join(short(graph, graph.nodes[number]))


def several(graph: StateGraph, numbers: Iterable[int], most: int = 8) -> str:
    """Nodes in one line; only so many of them by name, and how many more."""
    chosen = sorted(numbers)
    most = most if len(graph.variables) == 1 else min(most, 3)
    shown = "; ".join(named(graph, n) for n in chosen[:most])
    return f"{shown}; and {len(chosen) - most:,} more" if len(chosen) > most else shown


def behind(graph: StateGraph, node: GraphNode) -> str:
    """``×12``, and how many of them are marked."""
    marked = f", {node.wanted:,} marked" if node.wanted else ""
    return f"×{node.valuations:,}{marked}"


def example(edge: GraphEdge) -> tuple[str, ...]:
    """The inputs of an edge, one by one."""
    return tuple(edge.example.split(", ")) if edge.example else ()


def brief(told: str) -> str:
    """``name = value`` with only the last parts of a long name."""
    name, equals, value = told.partition(" = ")
    return f"…{'.'.join(name.split('.')[-2:])}{equals}{value}" if name.count(".") > 1 else told


def spans(numbers: Iterable[int]) -> str:
    """``1, 3–5``."""
    runs = [list(run) for _, run in groupby(enumerate(numbers), key=lambda item: item[1] - item[0])]
    ends = [(run[0][1], run[-1][1]) for run in runs]
    return ", ".join(str(a) if a == b else f"{a}–{b}" for a, b in ends)


def ticks(graph: StateGraph, source: int, target: int) -> str:
    """``tick 3`` or ``ticks 1, 3–5``: when the run that is shown takes the edge; empty if it does not."""
    taken = graph.taken.get((source, target), ())
    return f"tick{'s' * (len(taken) > 1)} {spans(taken)}" if taken else ""
