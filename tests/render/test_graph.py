"""Projected state graphs: the data, what is said of them, and every format."""

import json
from dataclasses import replace
from io import BytesIO
from xml.etree import ElementTree

import networkx as nx
import pytest
from jsonschema import validate

from rovercheck.checker.engines import Limits
from rovercheck.checker.explore.graphs.construction import made
from rovercheck.checker.explore.graphs.projection import project
from rovercheck.checker.render.stategraph.findings import findings, findings_text
from rovercheck.checker.render.stategraph.fragment import document, rows
from rovercheck.checker.render.stategraph.picture import LABELLED, drawn, in_rows, too_long
from rovercheck.checker.render.stategraph.words import brief, several, short, spans
from rovercheck.checker.results.graph import StateGraph, drawable, with_trace
from rovercheck.spec_model.lang.action import Assign, assign
from rovercheck.spec_model.lang.domain import integer
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.expr import Var, flag, ite, var
from rovercheck.spec_model.lang.system import TransitionSystem
from tests import toys
from tests.render.conformance import Suite
from tests.render.tabulated import tabulated
from tests.render.zoo import GRAPHS, long_trace, ring, short_trace
from tests.schemas import published

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
CUT = made(counter, ["count"], Limits(depth=3)).graph
WAYS = made(toys.relay(), ["on"]).with_ways()
ALL = {**GRAPHS, "cut": CUT, "ways": WAYS}
BIG = {**ALL, "big": ring(151)}


def sentences(graph: StateGraph) -> dict[str, str]:
    found: dict[str, str] = {}
    for heading, sentence in findings(graph):
        found[heading] = f"{found.get(heading, '')} {sentence}".strip()
    return found


class TestData:
    def test_counts_and_kinds(self) -> None:
        graph = GRAPHS["toy"]
        assert [n.shown for n in graph.nodes] == [("SAFE",), ("CRITICAL",)]
        assert [n.valuations for n in graph.nodes] == [2, 1]
        assert [n.initial for n in graph.nodes] == [True, False]
        assert graph.absorbing == {1} and not graph.components

    def test_a_lossy_projection_is_no_exact_graph(self) -> None:
        assert not GRAPHS["toy"].exact and GRAPHS["toy"].mixed == {0}
        assert "over-approximate" in GRAPHS["toy"].summary
        assert ring(5).exact and not ring(5).mixed

    def test_an_edge_is_sure_if_every_valuation_has_it(self) -> None:
        assert GRAPHS["toy"].sure == {(0, 0), (1, 1)}

    def test_cycles_are_components(self) -> None:
        assert list(ring(5).components.values()) == [(0, 1, 2, 3, 4)]
        assert ring(5).final == {0}

    def test_a_trace_becomes_a_path_with_its_ticks(self) -> None:
        graph = GRAPHS["marked"]
        assert graph.path[0] == 0 and graph.path[-1] == 1 and graph.bad == {1}
        assert len(graph.path) == len(long_trace()) + 1
        assert graph.taken == {(0, 0): tuple(range(1, 153)), (0, 1): (153,)}

    def test_a_trace_of_something_else_is_refused(self) -> None:
        with pytest.raises(ModelError, match=r"passes mode = SAFE, which is no node"):
            with_trace(replace(GRAPHS["toy"], nodes=GRAPHS["toy"].nodes[1:]), short_trace())
        with pytest.raises(ModelError, match=r"one of toy, which has no place"):
            with_trace(ring(3), long_trace())
        with pytest.raises(ModelError, match=r"Tick 153 .* is no edge"):
            with_trace(replace(GRAPHS["toy"], edges=GRAPHS["toy"].edges[:1]), long_trace())

    def test_too_many_nodes_are_refused_with_advice(self) -> None:
        with pytest.raises(ModelError, match=r"has 151 nodes.*Project on fewer variables"):
            drawable(ring(151))
        assert drawable(ring(151), 151)


class TestExploration:
    def test_all_valuations_and_all_input_cells(self) -> None:
        graph = made(counter, ["on"]).graph
        assert graph.valuations == 21 and not graph.exact
        edges = {(e.source, e.target): e.steps for e in graph.edges}
        assert edges == {(0, 0): 39, (0, 1): 1, (1, 0): 1, (1, 1): 1}

    def test_example_inputs_are_those_that_decide(self) -> None:
        graph = made(counter, ["on"]).graph
        examples = {(e.source, e.target): e.example for e in graph.edges}
        assert examples == {(0, 0): "", (0, 1): "level = 101", (1, 0): "level = 0", (1, 1): "level = 101"}

    def test_the_whole_valuation_is_exact(self) -> None:
        assert made(counter, ["count", "on"]).graph.exact

    def test_inputs_and_unknown_names_are_refused(self) -> None:
        with pytest.raises(ModelError, match="level is an input"):
            made(counter, ["level"])
        with pytest.raises(ModelError, match="Did you mean 'count'"):
            made(counter, ["coun"])


class TestWords:
    def test_spans(self) -> None:
        assert spans([1, 3, 4, 5, 7]) == "1, 3–5, 7" and spans([]) == ""

    def test_names_are_as_short_as_they_can_be(self) -> None:
        assert brief("A.B.C.over1 = true") == "…C.over1 = true" and brief("a.b = 1") == "a.b = 1"
        [node, *_] = GRAPHS["toy"].nodes
        assert short(GRAPHS["toy"], node) == ("SAFE",)
        chart = replace(GRAPHS["toy"], variables=("Run", "Run.Fast", "a.level", "b.level"))
        findings_text = short(chart, replace(node, shown=("Fast", "Deep", "3", "4")))
        assert findings_text == ("Fast = Deep", "a.level = 3", "b.level = 4")
        assert short(chart, replace(node, shown=("-",) * 4)) == ("-",)

    def test_many_nodes_are_counted(self) -> None:
        assert several(ring(12), range(12)) == "0; 1; 2; 3; 4; 5; 6; 7; and 4 more"

    def test_what_a_graph_shows(self) -> None:
        said = sentences(GRAPHS["marked"])
        assert said["size"] == "2 nodes and 3 edges for 3 states."
        assert said["because"] == "the states behind 1 of 2 nodes can go to different nodes."
        assert "with alarm too" in said["finer"] and "--project mode,alarm" in said["finer"]
        assert said["run"] == "the trace, 153 ticks: SAFE → CRITICAL."
        assert said["never left"] == "CRITICAL." and said["dead ends"].startswith("none")
        assert "every node can be reached from every other" in sentences(ring(5))["cycles"]

    def test_what_is_never_reached(self) -> None:
        assert sentences(made(toys.waiting(), ["place"]).graph)["never"] == "place is never 2, 3."

    def test_a_dead_end(self) -> None:
        stuck = replace(toys.filling(3), assume=count_of(toys.filling(3)) < 2)
        said = sentences(made(stuck, ["count"]).graph)
        assert said["dead ends"] == "2: 1 of ×1 admit no input."

    def test_a_cut_graph_says_so_first_and_loudly(self) -> None:
        assert findings(CUT)[0][0] == "CUT" and "Not all that is reachable is here" in findings_text(CUT)
        assert "is never" not in findings_text(CUT)
        assert max(map(len, findings_text(CUT).splitlines())) <= 80

    def test_marks(self) -> None:
        graph = made(toys.filling(3), ["count"], wanted=("full",), looked_for="P is broken").graph
        assert sentences(graph)["marked"] == "P is broken in 1 state behind 1 node: 3."
        none = made(toys.filling(3), ["count"], wanted=("over",), looked_for="P is broken").graph
        assert sentences(none)["marked"] == "P is broken in none of the states found."


def count_of(system: TransitionSystem):
    return system.var("count")


class TestPicture:
    def test_many_edges_have_no_inputs(self) -> None:
        assert drawn(GRAPHS["toy"]).labelled and not drawn(ring(LABELLED + 1)).labelled

    @pytest.mark.parametrize("size", [9, 60], ids=["layered", "in rows"])
    def test_boxes_lie_apart_inside_the_picture(self, size: int) -> None:
        picture = drawn(ring(size))
        root = ElementTree.fromstring("<g>" + "".join(picture.body) + "</g>")
        boxes = [[float(r.get(k, "0")) for k in ("x", "y", "width", "height")] for r in root.iter("rect")]
        assert len(boxes) == size
        for i, (x, y, w, h) in enumerate(boxes):
            assert x >= 0 and y >= 0 and x + w <= picture.width and y + h <= picture.height
            for ox, oy, ow, oh in boxes[:i]:
                assert x >= ox + ow or ox >= x + w or y >= oy + oh or oy >= y + h

    def test_a_long_graph_is_no_strip(self) -> None:
        assert not too_long(ring(9)) and too_long(ring(150))
        picture = drawn(ring(150))
        assert picture.width < 3 * picture.height

    def test_a_rank_of_many_boxes_has_several_columns(self) -> None:
        place = Var("place", integer(0, 900), 0)
        spread = [((0,), [(i,) for i in range(1, 901)]), *(((i,), [(i,)]) for i in range(1, 901))]
        graph = project("fan", tabulated([place], [(0,)], spread), ["place"], lambda *_: "")
        rows = in_rows(graph, {n.number: (60, 40) for n in graph.nodes})
        assert len(set(rows.at.values())) == 901 and rows.height < 4000


class TestPage:
    def test_a_very_long_run_says_what_it_leaves_out(self) -> None:
        way = WAYS.ways[1]
        ticks = [replace(way.trace.ticks[0], number=n) for n in range(1, 31)]
        flip = [replace(t, after={**t.after, "on": t.number % 2}) for t in ticks]
        found = rows(replace(way, trace=replace(way.trace, ticks=tuple(flip))), most=10)
        assert len(found) == 11 and found[5] == ("…", "", ["20 rows are left out here"])

    def test_the_data_of_a_node(self) -> None:
        node = document(WAYS)["nodes"][1]
        assert node["values"] == [("on", "true")] and node["depth"] == 1
        assert node["example"] == [("on", "true"), ("hold", "0")]
        assert node["way"] == [("1", "20", ["in critical = true", "on: false → true"])]


class GraphSuite(Suite):
    KIND = "graph"


class TestSvg(GraphSuite):
    NAME = "svg"
    ZOO = BIG
    REFUSED = frozenset({"big"})

    def parse(self, document: str) -> None:
        ElementTree.fromstring(document)

    def test_text_is_escaped(self) -> None:
        assert "ring &lt;&amp;&gt;" in self.shown("ring")

    def test_ticks_of_the_run_and_unsure_edges(self) -> None:
        assert "tick 153" in self.shown("marked") and 'class="edge some' in self.shown("marked")

    def test_a_cut_is_written_into_the_picture(self) -> None:
        assert "Not all that is reachable is here" in self.shown("cut")


class TestHtml(GraphSuite):
    NAME = "html"
    ZOO = BIG
    REFUSED = frozenset({"big"})

    def parse(self, document: str) -> None:
        assert document.startswith("<!doctype html>") and "<script>alert" not in document

    def test_text_is_escaped(self) -> None:
        assert "ring &lt;&amp;&gt;" in self.shown("ring") and "ring <&>" not in self.shown("ring")


class TestDot(GraphSuite):
    NAME = "dot"
    ZOO = BIG

    def parse(self, document: str) -> None:
        assert document.startswith("digraph ") and document.endswith("}\n")


class TestMermaid(GraphSuite):
    NAME = "mermaid"
    ZOO = BIG
    REFUSED = frozenset({"big"})

    def parse(self, document: str) -> None:
        assert document.startswith("flowchart LR\n")


class TestGraphml(GraphSuite):
    NAME = "graphml"
    ZOO = BIG

    def parse(self, document: str) -> "nx.MultiDiGraph[str]":
        graph: nx.MultiDiGraph[str] = nx.read_graphml(BytesIO(document.encode()), force_multigraph=True)
        return graph

    def test_counts_come_back(self) -> None:
        graph = self.parse(self.shown("toy"))
        assert graph.nodes["s0"]["valuations"] == 2 and graph.nodes["s0"]["value mode"] == "SAFE"
        assert graph.graph["kind"] == "over-approximate"
        assert not graph["s0"]["s1"][0]["sure"] and graph["s0"]["s1"][0]["sources"] == 1


class TestJson(GraphSuite):
    NAME = "json"
    ZOO = BIG

    def parse(self, document: str) -> None:
        validate(json.loads(document), published("graph-2"))

    def test_kind_and_marks_come_back(self) -> None:
        found = json.loads(self.shown("marked"))
        assert found["kind"] == "over-approximate" and found["bad"] == [1] and found["path"][-1] == 1
        assert json.loads(self.shown("cut"))["cut"] == "the limit of 3 ticks is reached"
