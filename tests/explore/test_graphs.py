"""State graphs compared with the definition, on random systems: nodes, edges, counts, exactness, runs."""

from collections import defaultdict
from collections.abc import Mapping
from dataclasses import replace
from typing import NamedTuple

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rovercheck.checker.engines import Limits
from rovercheck.checker.explore.graphs.construction import LIMITS, BuiltGraph, made
from rovercheck.checker.explore.graphs.projection import exact_with
from rovercheck.checker.results.graph import ProjectionKind, StateGraph
from rovercheck.checker.system.slice import sliced
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.expr import Const, all_of
from rovercheck.spec_model.lang.system import System, TransitionSystem
from tests import toys
from tests.naive import replay, successors, vectors
from tests.profiles import examples
from tests.strategies_ts import goals, transition_systems

Raw = tuple[int, ...]


class Naive(NamedTuple):
    """All reachable states of some variables with their followers and depths, by the plainest loop."""

    names: tuple[str, ...]
    initial: set[Raw]
    following: dict[Raw, set[Raw]]
    depth: dict[Raw, int]


def naive(system: TransitionSystem, names: tuple[str, ...]) -> Naive:
    """The whole system is run, and its states restricted to variables that determine themselves."""

    def cut(at: Mapping[str, int]) -> Raw:
        return tuple(at[n] for n in names)

    level = {cut(at): at for at in ({**system.init, **f} for f in vectors(system.frozen))}
    initial = set(level)
    following: dict[Raw, set[Raw]] = {}
    depth = dict.fromkeys(level, 0)
    ticks = 0
    while level:
        ticks += 1
        after: dict[Raw, dict[str, int]] = {}
        for raw, at in level.items():
            found = {cut(next_): next_ for next_ in successors(system, dict(at))}
            following[raw] = set(found)
            after |= {r: next_ for r, next_ in found.items() if r not in depth}
        depth |= dict.fromkeys(after, ticks)
        level = after
    return Naive(names, initial, following, depth)


def relevant(system: TransitionSystem, onto: tuple[str, ...]) -> tuple[str, ...]:
    """The names of the state that the graph counts."""
    part = sliced(system, [system.var(n) for n in onto])
    kept = {v.name for v in (*part.variables, *part.frozen)} | set(onto)
    return tuple(v.name for v in (*system.frozen, *system.variables) if v.name in kept)


def check_against(found: Naive, graph: StateGraph) -> None:
    """The definition, word by word."""
    node = {raw: tuple(raw[found.names.index(n)] for n in graph.variables) for raw in found.following}
    behind: dict[Raw, list[Raw]] = defaultdict(list)
    for raw, at in node.items():
        behind[at].append(raw)
    pairs: dict[tuple[Raw, Raw], set[tuple[Raw, Raw]]] = defaultdict(set)
    for raw, afters in found.following.items():
        for after in afters:
            pairs[node[raw], node[after]].add((raw, after))
    by_number = {n.number: n for n in graph.nodes}
    assert {n.raw: n.valuations for n in graph.nodes} == {at: len(some) for at, some in behind.items()}
    assert {n.raw for n in graph.nodes if n.initial} == {node[raw] for raw in found.initial}
    assert {n.raw: n.depth for n in graph.nodes} == {
        at: min(found.depth[raw] for raw in some) for at, some in behind.items()
    }
    assert {n.raw: n.dead for n in graph.nodes} == {
        at: sum(not found.following[raw] for raw in some) for at, some in behind.items()
    }
    edges = {(by_number[e.source].raw, by_number[e.target].raw): e for e in graph.edges}
    assert {ends: e.steps for ends, e in edges.items()} == {ends: len(some) for ends, some in pairs.items()}
    assert {ends: e.sources for ends, e in edges.items()} == {
        ends: len({raw for raw, _ in some}) for ends, some in pairs.items()
    }
    bisimulation = all(
        {node[after] for after in found.following[raw]} == {node[after] for after in found.following[other]}
        for some in behind.values()
        for raw in some
        for other in some[:1]
    )
    assert graph.kind is (ProjectionKind.EXACT if bisimulation else ProjectionKind.OVER)
    assert bool(graph.mixed) is not bisimulation
    assert graph.valuations == len(found.following)


def check_ways(system: TransitionSystem, one: BuiltGraph) -> None:
    """Each way replays by the reference semantics, in as few ticks as can be, and ends behind its node."""
    graph = one.with_ways()
    assert set(graph.ways) == {n.number for n in graph.nodes}
    for node in graph.nodes:
        run = one.exploration.run(one.first[node.number])
        ends = [{**system.init, **run.frozen}, *replay(system, run)]
        assert len(run) == node.depth
        assert tuple(ends[-1][n] for n in graph.variables) == node.raw
        assert len(graph.ways[node.number].trace) == node.depth


def check_examples(system: TransitionSystem, one: BuiltGraph) -> None:
    """From some state behind its source, every tick with the example inputs of an edge takes it."""
    explored, graph = one.exploration.explored, one.graph
    shown = {v.name: {v.domain.show(raw): raw for raw in v.domain.values} for v in system.inputs}
    part = one.exploration.task.system
    for edge in graph.edges:
        pairs = [part_.split(" = ") for part_ in edge.example.split(", ") if part_]
        told = {name: shown[name][value] for name, value in pairs}
        before = [explored.at(i) for i in range(len(explored))]
        source, target = graph.nodes[edge.source].raw, graph.nodes[edge.target].raw
        ends = [
            {tuple(after[n] for n in graph.variables) for after in successors(_fixed(part, told), at)}
            for at in before
            if tuple(at[n] for n in graph.variables) == source
        ]
        assert {target} in ends


def _fixed(system: TransitionSystem, told: Mapping[str, int]) -> TransitionSystem:
    held = (v == Const(told[v.name], v.sort) for v in system.inputs if v.name in told)
    return replace(system, assume=all_of(system.assume, *held))


@examples(40)
@given(transition_systems(), st.data())
def test_a_random_graph_is_as_defined(system: TransitionSystem, data: st.DataObject) -> None:
    names = [v.name for v in (*system.variables, *system.frozen)]
    onto = tuple(data.draw(st.lists(st.sampled_from(names), min_size=1, max_size=2, unique=True)))
    one = made(system, onto)
    check_against(naive(system, relevant(system, onto)), one.graph)
    check_ways(system, one)
    check_examples(system, one)


@examples(15)
@given(transition_systems(most=2), st.data())
def test_marks_are_where_the_goal_is_true(system: TransitionSystem, data: st.DataObject) -> None:
    goal = goals(system)[0].name
    onto = (data.draw(st.sampled_from([v.name for v in system.variables])),)
    graph = made(system, onto, wanted=(goal,), looked_for="it is so").graph
    found = naive(system, relevant(system, (*onto, goal)))
    place, at = found.names.index(goal), found.names.index(onto[0])
    marked: dict[Raw, int] = defaultdict(int)
    for raw in found.following:
        marked[(raw[at],)] += raw[place]
    assert {n.raw: n.wanted for n in graph.nodes} == marked
    assert graph.bad == {n.number for n in graph.nodes if n.wanted}


def test_the_way_to_a_marked_node_ends_in_a_marked_valuation() -> None:
    one = made(toys.filling(6), ("count",), wanted=("full",), looked_for="full")
    assert [n.number for n in one.graph.nodes if n.wanted] == [6]
    assert dict(one.with_ways().ways[6].valuation)["full"] == "true"
    coarse = made(toys.counter(4, top=6, beside=True), ("mark",), wanted=("goal",), looked_for="it is so")
    [held] = [n for n in coarse.graph.nodes if n.wanted]
    way = coarse.with_ways().ways[held.number]
    assert held.depth == 1 and len(way.trace) == 4 and dict(way.valuation)["goal"] == "true"


TOYS = {
    "relay": (toys.relay(), ("on",)),
    "waiting": (toys.waiting(), ("place",)),
    "filling": (toys.filling(6), ("full",)),
    "once": (toys.once(), ("goal",)),
}


@pytest.mark.parametrize("name", TOYS)
def test_a_toy_is_as_defined(name: str) -> None:
    system, onto = TOYS[name]
    one = made(system, onto)
    check_against(naive(system, relevant(system, onto)), one.graph)
    check_ways(system, one)
    check_examples(system, one)


def test_what_makes_a_projection_exact() -> None:
    graph = made(toys.relay(), ("on",)).graph
    assert graph.kind is ProjectionKind.OVER
    for names, nodes in graph.exact_with:
        finer = made(toys.relay(), ("on", *names)).graph
        assert finer.kind is ProjectionKind.EXACT and len(finer.nodes) == nodes
    assert [names for names, _ in graph.exact_with] == [("hold",)]


def test_looking_for_what_makes_it_exact_costs_little() -> None:
    explored = made(toys.relay(), ("on", "since")).exploration.explored
    assert exact_with(explored, ("on",), tried=1) == ()


class TestCut:
    """An exploration that ends early is no whole graph, and says so."""

    def test_by_depth_every_path_is_a_run_where_nothing_is_mixed(self) -> None:
        graph = made(toys.filling(6), ("count",), Limits(depth=3)).graph
        assert graph.kind is ProjectionKind.UNDER and "3 ticks" in graph.cut
        assert [n.raw for n in graph.nodes] == [(0,), (1,), (2,), (3,)]
        assert [n.unexpanded for n in graph.nodes] == [0, 0, 0, 1]
        assert graph.absorbing == frozenset()

    def test_by_depth_mixed_nodes_leave_neither(self) -> None:
        graph = made(toys.filling(6), ("full",), Limits(depth=3)).graph
        assert graph.kind is ProjectionKind.NEITHER and not graph.exact_with
        assert "is cut" in graph.because[0]

    def test_by_memory(self) -> None:
        graph = made(toys.counter(50, top=60), ("count",), Limits(memory=2000)).graph
        assert "memory limit" in graph.cut and graph.kind is not ProjectionKind.EXACT
        assert len(graph.nodes) < 61

    def test_by_time(self) -> None:
        graph = made(toys.counter(50, top=60), ("count",), Limits(seconds=0.0)).graph
        assert "time limit" in graph.cut and [n.unexpanded for n in graph.nodes] == [1]

    def test_a_limit_that_is_not_met_cuts_nothing(self) -> None:
        assert made(toys.filling(6), ("count",), Limits(depth=7)).graph.cut == ""


def test_an_abstract_system_says_so() -> None:
    more = replace(toys.filling(6), source=System("filling", (), over=True))
    fewer = replace(toys.filling(6), source=System("filling", (), under=True))
    both = replace(toys.filling(6), source=System("filling", (), over=True, under=True))
    kinds = [made(s, ("count",)).graph.kind for s in (more, fewer, both)]
    assert kinds == [ProjectionKind.OVER, ProjectionKind.UNDER, ProjectionKind.NEITHER]
    assert made(more, ("count",)).graph.because == ("filling has more runs than the real system",)


def test_a_tick_out_of_a_domain_is_no_graph() -> None:
    with pytest.raises(ModelError, match=r"count becomes 3 .*Widen the domain"):
        made(toys.overflowing(2), ("count",))


def test_it_is_the_same_every_time() -> None:
    assert made(toys.relay(), ("on", "hold")).graph == made(toys.relay(), ("on", "hold")).graph


def test_limits_by_default_are_finite() -> None:
    assert LIMITS.seconds is not None and LIMITS.memory < 8 << 30
