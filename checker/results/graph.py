"""The reachable graph of a system projected on a few variables, as data for the renderers.

A node is one combination of values of the chosen variables; behind it stand all reachable states
that agree on them.  An edge is *sure* if each of the states behind its source has a tick to some
state behind its target.  If every edge is sure, all states behind a node can go to the same nodes
(the nodes are the classes of a bisimulation), and then every path of the graph is a run.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from enum import StrEnum
from functools import cached_property
from itertools import pairwise

from rovercheck.checker.results.trace import Trace
from rovercheck.spec_model.lang.errors import ModelError

Values = tuple[int, ...]
"""Raw values of variables, in a fixed order."""


class ProjectionKind(StrEnum):
    """What a graph shows of the runs of the real system."""

    EXACT = "exact"
    """Every path is a run, every run a path."""
    OVER = "over-approximate"
    """Every run is a path, but not every path need be a run."""
    UNDER = "under-approximate"
    """Every path is a run, but runs may be missing."""
    NEITHER = "neither over- nor under-approximate"
    """Runs may be missing, and not every path need be a run."""


@dataclass(frozen=True)
class GraphNode:
    """A combination of values (raw, and as a person writes them) and the states behind it.

    ``depth`` is the number of ticks after which it is first reached, ``wanted`` the number of states
    behind it in which the property looked for is broken (or reached), ``dead`` of those from which no
    input is admissible, ``unexpanded`` of those whose ticks are not known.
    """

    number: int
    raw: Values
    shown: tuple[str, ...]
    valuations: int
    initial: bool = False
    component: int = 0
    depth: int = 0
    wanted: int = 0
    dead: int = 0
    unexpanded: int = 0


@dataclass(frozen=True)
class GraphEdge:
    """Ticks that lead from one node to another: how many pairs of states, and example inputs.

    ``sources`` counts the states behind the source that have such a tick.
    """

    source: int
    target: int
    steps: int
    example: str
    sources: int = 0


@dataclass(frozen=True)
class GraphWay:
    """How to get to a node: a whole state behind it (a marked one, if any), and a shortest run to it."""

    valuation: tuple[tuple[str, str], ...]
    trace: Trace


@dataclass(frozen=True)
class StateGraph:
    """A projected reachable graph.

    ``over`` and ``under`` say why a path may be no run, and why a run may be no path, apart from what the
    projection mixes; ``cut`` is the limit that ended the exploration early, ``depth`` the ticks after which
    it found nothing new.  ``path`` is a run to be shown as a sequence of nodes.  ``bad`` are nodes in which
    ``looked_for`` is broken (or reached, as it says).  ``never`` has the values of a variable that no
    reachable state has; ``exact_with`` the variables with which the projection would mix nothing, and
    how many nodes it would have.
    """

    title: str
    variables: tuple[str, ...]
    nodes: tuple[GraphNode, ...]
    edges: tuple[GraphEdge, ...]
    valuations: int
    over: tuple[str, ...] = ()
    under: tuple[str, ...] = ()
    cut: str = ""
    depth: int = 0
    path: tuple[int, ...] = ()
    path_of: str = ""
    bad: frozenset[int] = frozenset()
    looked_for: str = ""
    never: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    exact_with: tuple[tuple[tuple[str, ...], int], ...] = ()
    notes: tuple[str, ...] = ()
    ways: Mapping[int, GraphWay] = field(default_factory=dict, compare=False, repr=False)

    @cached_property
    def sure(self) -> frozenset[tuple[int, int]]:
        """The edges that every state behind their source has."""
        behind = {n.number: n.valuations for n in self.nodes}
        return frozenset((e.source, e.target) for e in self.edges if e.sources == behind[e.source])

    @cached_property
    def mixed(self) -> frozenset[int]:
        """Nodes whose states cannot all go to the same nodes."""
        return frozenset(e.source for e in self.edges if (e.source, e.target) not in self.sure)

    @property
    def kind(self) -> ProjectionKind:
        """What the graph shows of the runs."""
        paths_are_runs, runs_are_paths = not (self.over or self.mixed), not (self.under or self.cut)
        if runs_are_paths:
            return ProjectionKind.EXACT if paths_are_runs else ProjectionKind.OVER
        return ProjectionKind.UNDER if paths_are_runs else ProjectionKind.NEITHER

    @property
    def exact(self) -> bool:
        """Whether its paths are the runs, no more and no fewer."""
        return self.kind is ProjectionKind.EXACT

    @property
    def dead_ends(self) -> frozenset[int]:
        """Nodes with a state from which no input is admissible."""
        return frozenset(n.number for n in self.nodes if n.dead)

    @cached_property
    def absorbing(self) -> frozenset[int]:
        """Nodes whose only edge leads to themselves, all ticks from them being known."""
        left = {e.source for e in self.edges if e.source != e.target}
        stays = {e.source for e in self.edges if e.source == e.target}
        return frozenset(stays - left - {n.number for n in self.nodes if n.unexpanded})

    @cached_property
    def components(self) -> dict[int, tuple[int, ...]]:
        """Nodes of each strongly connected component that has several."""
        return {number: members for number, members in self._grouped.items() if len(members) > 1}

    @cached_property
    def final(self) -> frozenset[int]:
        """The components that are never left, all ticks from them being known; single nodes included."""
        of = {n.number: n.component for n in self.nodes}
        left = {of[e.source] for e in self.edges if of[e.source] != of[e.target]}
        unknown = {n.component for n in self.nodes if n.unexpanded}
        return frozenset(of.values()) - left - unknown

    @cached_property
    def _grouped(self) -> dict[int, tuple[int, ...]]:
        found: dict[int, list[int]] = {}
        for node in self.nodes:
            found.setdefault(node.component, []).append(node.number)
        return {number: tuple(members) for number, members in found.items()}

    def members(self, component: int) -> tuple[int, ...]:
        """The nodes of a component."""
        return self._grouped[component]

    @property
    def size(self) -> str:
        """``9 nodes and 24 edges for 1,234 states``."""
        counts = ((len(self.nodes), "node"), (len(self.edges), "edge"), (self.valuations, "state"))
        nodes, edges, behind = (f"{n:,} {word}{'s' * (n != 1)}" for n, word in counts)
        return f"{nodes} and {edges} for {behind}"

    @property
    def means(self) -> str:
        """What the kind allows to conclude, in one sentence."""
        return f"{self.kind}: {_MEANS[self.kind]}."

    @property
    def because(self) -> tuple[str, ...]:
        """Why the graph is not exact; nothing if it is."""
        may = "may" if self.cut else "can"
        mixed = f"the states behind {_some(len(self.mixed), len(self.nodes))} {may} go to different nodes"
        cut = f"the exploration is cut: {self.cut}" if self.cut else ""
        return tuple(why for why in (cut, *self.under, mixed if self.mixed else "", *self.over) if why)

    @property
    def summary(self) -> str:
        """What the graph is and how far it can be trusted."""
        why = f" Because {'; '.join(self.because)}." if self.because else ""
        return f"{self.size}; {self.means}{why}"

    @cached_property
    def taken(self) -> dict[tuple[int, int], tuple[int, ...]]:
        """The ticks of the path along each edge, from 1."""
        found: dict[tuple[int, int], list[int]] = {}
        for tick, ends in enumerate(pairwise(self.path), start=1):
            found.setdefault(ends, []).append(tick)
        return {ends: tuple(ticks) for ends, ticks in found.items()}


_MEANS = {
    ProjectionKind.EXACT: "every path is a run, and every run a path",
    ProjectionKind.OVER: "every run is a path, but not every path need be a run",
    ProjectionKind.UNDER: "every path is a run, but runs may be missing",
    ProjectionKind.NEITHER: "runs may be missing, and not every path need be a run",
}


def _some(some: int, all_: int) -> str:
    if some == all_:
        return "each node" if all_ > 1 else "the node"
    return f"{some:,} of {all_:,} nodes"


def with_trace(graph: StateGraph, trace: Trace) -> StateGraph:
    """The graph with the run of a trace as its path; the last node is marked bad if the trace says so.

    Raises ``ModelError`` when the trace lacks a variable, or passes what is no node or edge of the graph.
    """
    missing = [name for name in graph.variables if name not in trace.system.variables]
    if missing:
        raise ModelError(
            f"The trace is one of {trace.system.name}, which has no {', '.join(missing)}. "
            "Project on variables that it has, too."
        )
    numbers = {node.raw: node.number for node in graph.nodes}
    path: list[int] = []
    for at in (trace.before, *(t.after for t in trace.ticks)):
        raw = tuple(at[name] for name in graph.variables)
        shown = ", ".join(f"{n} = {trace.show(n, at[n])}" for n in graph.variables)
        if raw not in numbers:
            why = f"the exploration is cut: {graph.cut}" if graph.cut else f"{graph.title} never reaches that"
            raise ModelError(f"The trace of {trace.system.name} passes {shown}, which is no node: {why}.")
        path.append(numbers[raw])
    edges = {(e.source, e.target) for e in graph.edges}
    for tick, ends in enumerate(pairwise(path), start=1):
        if ends not in edges:
            raise ModelError(
                f"Tick {tick} of the trace of {trace.system.name} is no edge of {graph.title}. "
                "Use a trace of the same system."
            )
    bad = frozenset(path[-1:]) if trace.property.false_parts else frozenset[int]()
    return replace(graph, path=tuple(path), path_of=trace.property.id, bad=graph.bad | bad)


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
        f"{graph.title} has {len(graph.nodes):,} nodes; more than {most:,} cannot be read. "
        f"Project on fewer variables, without {advice} for instance; or write json, graphml or dot."
    )
