"""Projected state graphs: the data, and every format."""

import json
from io import BytesIO
from xml.etree import ElementTree

import networkx as nx
import pytest
from jsonschema import validate

from checker.explore import state_graph
from checker.graph import drawable
from checker.render import graph_json
from spec_model.lang.action import Assign, assign
from spec_model.lang.domain import integer
from spec_model.lang.errors import ModelError
from spec_model.lang.expr import flag, ite, var
from spec_model.lang.system import TransitionSystem
from tests.render.conformance import Suite
from tests.render.zoo import GRAPHS, long_trace, ring

count = var("count", integer(0, 20))
level = var("level", integer(0, 300))
on = flag("on")
noise = var("noise", integer(0, 9))
counter = TransitionSystem(
    "counter",
    inputs=(level, noise),
    frozen=(),
    variables=(count, on),
    temps=(),
    step=(
        Assign(count, ite(level > 100, ite(count < 20, count + 1, 20), 0)),
        assign(on, count == 20),
        assign(noise, noise),
    ),
)


ALL = {**GRAPHS, "big": ring(151)}


class TestData:
    def test_counts_and_kinds(self) -> None:
        graph = GRAPHS["toy"]
        assert [n.shown for n in graph.nodes] == [("SAFE",), ("CRITICAL",)]
        assert [n.valuations for n in graph.nodes] == [2, 1]
        assert [n.initial for n in graph.nodes] == [True, False]
        assert graph.absorbing == {1} and not graph.components

    def test_a_lossy_projection_is_no_exact_graph(self) -> None:
        assert not GRAPHS["toy"].exact
        assert "over-approximate" in GRAPHS["toy"].summary
        assert ring(5).exact

    def test_cycles_are_components(self) -> None:
        assert list(ring(5).components.values()) == [(0, 1, 2, 3, 4)]

    def test_a_trace_becomes_a_path(self) -> None:
        graph = GRAPHS["marked"]
        assert graph.path[0] == 0 and graph.path[-1] == 1 and graph.bad == {1}
        assert len(graph.path) == len(long_trace()) + 1

    def test_too_many_nodes_are_refused_with_advice(self) -> None:
        with pytest.raises(ModelError, match=r"has 151 nodes.*Project on fewer variables"):
            drawable(ring(151))


class TestExploration:
    def test_all_valuations_and_all_input_cells(self) -> None:
        graph = state_graph(counter, ["on"])
        assert graph.valuations == 21 + 1 - 1
        assert not graph.exact
        edges = {(e.source, e.target): e.steps for e in graph.edges}
        assert edges == {(0, 0): 39, (0, 1): 1, (1, 0): 1, (1, 1): 1}

    def test_example_inputs_lead_there(self) -> None:
        graph = state_graph(counter, ["on"])
        examples = {(e.source, e.target): e.example for e in graph.edges}
        assert examples[0, 1] == "level = 101"

    def test_the_whole_valuation_is_exact(self) -> None:
        assert state_graph(counter, ["count", "on"]).exact

    def test_no_silent_cap(self) -> None:
        with pytest.raises(ModelError, match=r"more than 10 valuations.*largest variables are count"):
            state_graph(counter, ["on"], most=10)

    def test_inputs_and_unknown_names_are_refused(self) -> None:
        with pytest.raises(ModelError, match="level is an input"):
            state_graph(counter, ["level"])
        with pytest.raises(ModelError, match="Did you mean 'count'"):
            state_graph(counter, ["coun"])


class GraphSuite(Suite):
    KIND = "graph"


class TestSvg(GraphSuite):
    NAME = "svg"
    ZOO = ALL
    REFUSED = frozenset({"big"})

    def parse(self, document: str) -> None:
        ElementTree.fromstring(document)

    def test_text_is_escaped(self) -> None:
        assert "ring &lt;&amp;&gt;" in self.shown("ring")


class TestDot(GraphSuite):
    NAME = "dot"
    ZOO = GRAPHS

    def parse(self, document: str) -> None:
        assert document.startswith("digraph ") and document.endswith("}\n")


class TestMermaid(GraphSuite):
    NAME = "mermaid"
    ZOO = ALL
    REFUSED = frozenset({"big"})

    def parse(self, document: str) -> None:
        assert document.startswith("flowchart LR\n")


class TestGraphml(GraphSuite):
    NAME = "graphml"
    ZOO = ALL

    def parse(self, document: str) -> "nx.MultiDiGraph[str]":
        graph: nx.MultiDiGraph[str] = nx.read_graphml(BytesIO(document.encode()), force_multigraph=True)
        return graph

    def test_counts_come_back(self) -> None:
        graph = self.parse(self.shown("toy"))
        assert graph.nodes["s0"]["valuations"] == 2 and graph.nodes["s0"]["value mode"] == "SAFE"


class TestJson(GraphSuite):
    NAME = "json"
    ZOO = ALL

    def parse(self, document: str) -> None:
        validate(json.loads(document), graph_json.SCHEMA)
