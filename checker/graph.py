"""The reachable graph of a system projected on a few variables, as data for the renderers.

A node is one combination of values of the chosen variables; behind it stand all reachable valuations
that agree on them.  Every run of the system is a path of the graph.  The converse holds only if the
graph is ``exact``: then all valuations behind a node can go to the same nodes.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace

from checker.trace import Trace
from spec_model.lang.errors import ModelError, did_you_mean
from spec_model.lang.expr import Var

Values = tuple[int, ...]
"""Raw values of variables, in a fixed order."""

Step = tuple[Values, Mapping[str, int]]
"""The valuation after a tick, and the inputs it looked at in the order in which it did, raw."""


@dataclass(frozen=True)
class GraphNode:
    """A combination of values (raw, and as a person writes them) and the valuations behind it."""

    number: int
    raw: Values
    shown: tuple[str, ...]
    valuations: int
    initial: bool = False
    component: int = 0


@dataclass(frozen=True)
class GraphEdge:
    """Ticks that lead from one node to another: how many pairs of valuations, and example inputs."""

    source: int
    target: int
    steps: int
    example: str


@dataclass(frozen=True)
class StateGraph:
    """A projected reachable graph.

    ``components`` are the strongly connected components with more than one node, by number;
    ``dead_ends`` nodes with a valuation from which no input is admissible; ``absorbing`` nodes that
    are never left.  ``path`` is a run to be shown as a sequence of nodes, ``bad`` nodes to mark.
    """

    title: str
    variables: tuple[str, ...]
    nodes: tuple[GraphNode, ...]
    edges: tuple[GraphEdge, ...]
    valuations: int
    exact: bool
    dead_ends: frozenset[int] = frozenset()
    path: tuple[int, ...] = ()
    bad: frozenset[int] = frozenset()
    notes: tuple[str, ...] = field(default=())

    @property
    def absorbing(self) -> frozenset[int]:
        """Nodes whose only edge leads to themselves."""
        left = {e.source for e in self.edges if e.source != e.target}
        stays = {e.source for e in self.edges if e.source == e.target}
        return frozenset(stays - left)

    @property
    def components(self) -> dict[int, tuple[int, ...]]:
        """Nodes of each strongly connected component that has several."""
        found: dict[int, list[int]] = {}
        for node in self.nodes:
            found.setdefault(node.component, []).append(node.number)
        return {number: tuple(members) for number, members in found.items() if len(members) > 1}

    @property
    def summary(self) -> str:
        """What the graph is and how far it can be trusted, in one sentence."""
        what = f"{len(self.nodes)} nodes and {len(self.edges)} edges for {self.valuations} valuations"
        if self.exact:
            return f"{what}; exact: every path is a run."
        return f"{what}; over-approximate: every run is a path, but not every path a run."


def project(
    title: str,
    variables: Sequence[Var],
    onto: Sequence[str],
    initial: Iterable[Values],
    steps: Iterable[tuple[Values, Sequence[Step]]],
    inputs: Mapping[str, Var],
) -> StateGraph:
    """The graph on the variables named ``onto``.

    ``steps`` gives each reachable valuation of ``variables`` once, with every tick that leaves it;
    ``inputs`` are the variables in which the inputs of ticks are shown.  Raises ``ModelError`` for an
    unknown name.
    """
    place = _places(variables, onto)
    numbers: dict[Values, int] = {}
    behind: dict[int, int] = {}
    edges: dict[tuple[int, int], tuple[int, Mapping[str, int]]] = {}
    outcomes: dict[int, frozenset[int]] = {}
    dead: set[int] = set()
    exact, total = True, 0
    starts = {_number(numbers, place, v) for v in initial}
    for valuation, leaving in steps:
        total += 1
        source = _number(numbers, place, valuation)
        behind[source] = behind.get(source, 0) + 1
        targets = dict(reversed(leaving))
        for after in dict.fromkeys(after for after, _ in leaving):
            key = source, _number(numbers, place, after)
            count, example = edges.get(key, (0, targets[after]))
            edges[key] = count + 1, example
        reached = frozenset(_number(numbers, place, after) for after in targets)
        exact &= outcomes.setdefault(source, reached) == reached
        dead |= set() if leaving else {source}
    chosen = [variables[i] for i in place]
    nodes = _nodes(chosen, numbers, behind, starts, edges)
    found = tuple(
        GraphEdge(*key, n, _shown(inputs, drawn)) for key, (n, drawn) in sorted(edges.items(), key=_key)
    )
    return StateGraph(title, tuple(onto), nodes, found, total, exact, frozenset(dead))


def _key(item: tuple[tuple[int, int], object]) -> tuple[int, int]:
    return item[0]


def _shown(inputs: Mapping[str, Var], drawn: Mapping[str, int]) -> str:
    return ", ".join(f"{name} = {inputs[name].domain.show(raw)}" for name, raw in drawn.items())


def _places(variables: Sequence[Var], onto: Sequence[str]) -> list[int]:
    names = [v.name for v in variables]
    for name in onto:
        if name not in names:
            raise ModelError(f"There is no variable {name!r} to project on. {did_you_mean(name, names)}")
    return [names.index(name) for name in onto]


def _number(numbers: dict[Values, int], place: Sequence[int], valuation: Values) -> int:
    return numbers.setdefault(tuple(valuation[i] for i in place), len(numbers))


def _nodes(
    variables: Sequence[Var],
    numbers: Mapping[Values, int],
    behind: Mapping[int, int],
    starts: set[int],
    edges: Iterable[tuple[int, int]],
) -> tuple[GraphNode, ...]:
    import networkx as nx  # 0.1 s that other commands need not wait for

    plain: nx.DiGraph[int] = nx.DiGraph()
    plain.add_nodes_from(numbers.values())
    plain.add_edges_from(edges)
    component: dict[int, int] = {}
    for number, members in enumerate(sorted(map(sorted, nx.strongly_connected_components(plain)))):
        component |= dict.fromkeys(members, number)
    return tuple(
        GraphNode(
            number,
            raw,
            tuple(v.domain.show(x) for v, x in zip(variables, raw, strict=True)),
            behind.get(number, 0),
            number in starts,
            component[number],
        )
        for raw, number in numbers.items()
    )


def with_trace(graph: StateGraph, trace: Trace) -> StateGraph:
    """The graph with the run of a trace as its path; the last node is marked bad if the trace says so.

    Raises ``ModelError`` when the trace passes a node the graph does not have.
    """
    numbers = {node.raw: node.number for node in graph.nodes}
    path: list[int] = []
    for at in (trace.before, *(t.after for t in trace.ticks)):
        raw = tuple(at[name] for name in graph.variables)
        if raw not in numbers:
            shown = ", ".join(f"{n} = {trace.show(n, at[n])}" for n in graph.variables)
            raise ModelError(
                f"The trace of {trace.system} passes {shown}, which {graph.title} never reaches."
            )
        path.append(numbers[raw])
    bad = frozenset(path[-1:]) if trace.false_parts else frozenset[int]()
    return replace(graph, path=tuple(path), bad=graph.bad | bad)


MOST_NODES = 150
"""A drawing with more nodes helps nobody."""


def drawable(graph: StateGraph, most: int = MOST_NODES) -> StateGraph:
    """The graph itself.  Raises ``ModelError`` when it has too many nodes to be drawn."""
    if len(graph.nodes) <= most:
        return graph
    sizes = {n: len({node.raw[i] for node in graph.nodes}) for i, n in enumerate(graph.variables)}
    widest = sorted(sizes, key=lambda n: (-sizes[n], n))[:3]
    advice = ", ".join(f"{n} ({sizes[n]} values)" for n in widest)
    raise ModelError(
        f"{graph.title} projected on {', '.join(graph.variables)} has {len(graph.nodes)} nodes; more than "
        f"{most} cannot be read. Project on fewer variables, without {advice} for instance, or export json."
    )
