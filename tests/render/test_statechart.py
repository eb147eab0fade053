"""Charts in every format."""

import re
from io import BytesIO
from xml.etree import ElementTree

import networkx as nx
import pytest

from rovercheck.checker.render import statechart_svg
from rovercheck.checker.render.drawing.labels import arrows
from rovercheck.checker.results.trace import TakenTransition
from rovercheck.spec_model.lang.errors import ModelError
from tests.render.conformance import Suite
from tests.render.zoo import CHARTS, crossing, monitor, nested, parallel, relay

SVG = "{http://www.w3.org/2000/svg}"


class ChartSuite(Suite):
    KIND = "statechart"


class TestHtml(ChartSuite):
    """``graph CHART --format html`` was offered and refused."""

    NAME = "html"
    ZOO = CHARTS

    def parse(self, document: str) -> None:
        assert document.startswith("<!doctype html>") and document.rstrip().endswith("</html>")
        drawn = document[document.index("<svg") : document.index("</svg>") + len("</svg>")]
        assert ElementTree.fromstring(drawn).tag == f"{SVG}svg"


class TestSvg(ChartSuite):
    NAME = "svg"
    ZOO = CHARTS

    def parse(self, document: str) -> ElementTree.Element:
        root = ElementTree.fromstring(document)
        assert root.tag == f"{SVG}svg"
        assert not re.search(r"(href|src|@import|url\()", document), "no outside resources"
        return root

    def test_every_state_and_label_is_written(self) -> None:
        for chart in CHARTS.values():
            words = " ".join(
                "".join(t.itertext()) for t in self.parse(statechart_svg.render(chart)).iter(f"{SVG}text")
            )
            assert all(path[-1] in words for path in chart.states if path)
            for arrow in arrows(chart):
                assert arrow.transition.event is None or arrow.transition.event in words

    def test_text_is_escaped(self) -> None:
        assert "level &lt; 5" in statechart_svg.render(relay)
        assert "Two states &amp; one duration" in statechart_svg.render(relay)

    def test_one_head_per_transition_and_one_start(self) -> None:
        for chart in CHARTS.values():
            document = statechart_svg.render(chart)
            assert document.count('class="head"') == len(arrows(chart))

    def test_active_states_and_fired_transitions_stand_out(self) -> None:
        fired = TakenTransition("Nested", "Run.Slow", "Run.Fast", "[level > 3]", 1)
        document = statechart_svg.render(nested, active=["Slow"], fired=[fired])
        assert document.count(" active") == 2, "the state and the one around it"
        assert document.count("arrow fired") == 1

    def test_a_fired_path_through_junctions_stands_out_whole(self) -> None:
        fired = TakenTransition("Monitor", "OK", "DEG", "[level > 100]", 1)
        assert statechart_svg.render(monitor, fired=[fired]).count("arrow fired") == 2

    def test_an_unknown_active_state_is_an_error(self) -> None:
        with pytest.raises(ModelError, match="Did you mean 'Ours'"):
            statechart_svg.render(relay, active=["Our"])


class TestGraphml(ChartSuite):
    NAME = "graphml"
    ZOO = CHARTS

    def parse(self, document: str) -> "nx.MultiDiGraph[str]":
        graph: nx.MultiDiGraph[str] = nx.read_graphml(BytesIO(document.encode()), force_multigraph=True)
        return graph

    def test_hierarchy_and_labels_come_back(self) -> None:
        graph = self.parse(self.shown("Nested"))
        assert graph.nodes["Nested.Run.Fast.Deep"]["parent"] == "Nested.Run.Fast"
        assert len(graph.edges) == len(arrows(nested))
        assert any("too_high" in label for _, _, label in graph.edges(data="label"))


class TestDot(ChartSuite):
    NAME = "dot"
    ZOO = CHARTS

    def parse(self, document: str) -> None:
        balanced = re.sub(r'"(\\.|[^"\\])*"', "", document)
        assert balanced.count("{") == balanced.count("}") and '"' not in balanced

    def test_one_edge_per_transition_between_nodes_that_exist(self) -> None:
        for name, chart in CHARTS.items():
            edges = re.findall(r"^  (\w+) -> (\w+)", self.shown(name), re.MULTILINE)
            nodes = set(re.findall(r"^ +(\w+) \[", self.shown(name), re.MULTILINE))
            assert len(edges) == len(arrows(chart)) and nodes.issuperset(
                end for edge in edges for end in edge
            )

    def test_composites_are_clusters(self) -> None:
        composites = [p for p, s in parallel.states.items() if p and s.states]
        assert self.shown("Parallel").count("subgraph cluster_") == len(composites)


class TestMermaid(ChartSuite):
    NAME = "mermaid"
    ZOO = CHARTS
    REFUSED = frozenset({"Parallel", "Nested", "Crossing"})

    def parse(self, document: str) -> None:
        assert document.startswith("stateDiagram-v2\n")
        assert document.count("{\n") == document.count("}\n")

    def test_what_its_grammar_uses_is_written_as_codes(self) -> None:
        for name in CHARTS.keys() - self.REFUSED:
            for line in self.shown(name).splitlines():
                _, colon, label = line.partition(" : ")
                bare = re.sub(r"#(\d+|lt|gt|quot);", "", label)
                assert not colon or not re.search(r"[:;<>\"{}#]", bare), line

    def test_says_which_construct_does_not_fit(self) -> None:
        with pytest.raises(ModelError, match=r"Run is a composite with actions.*Use svg"):
            self.renderer.render(nested)
        with pytest.raises(ModelError, match=r"from A\.X to A\.B\.Y crosses the border"):
            self.renderer.render(crossing)
        with pytest.raises(ModelError, match=r"Parts\.R0 is a composite inside a parallel region.*Use svg"):
            self.renderer.render(parallel)
