"""A chart as GraphML for graph tools: hierarchy, labels and actions are attributes."""

from io import BytesIO

import networkx as nx

from rovercheck.checker.render.drawing.labels import arrows, execution_order, label
from rovercheck.checker.results.format import Format
from rovercheck.spec_model.lang.chart import Chart, Path

FORMAT = Format("graphml", "statechart", ".graphml", "GraphML with the hierarchy as attributes")


def render(chart: Chart) -> str:
    """The GraphML document."""
    return graphml(graph(chart))


def graph(chart: Chart) -> "nx.MultiDiGraph[str]":
    """The chart as a graph: nodes are states, junctions and the dots of default transitions."""
    found: nx.MultiDiGraph[str] = nx.MultiDiGraph(name=chart.name, text=chart.text)
    for path, state in chart.states.items():
        kind = "chart" if not path else "parallel" if state.parallel else "state"
        order = execution_order(chart, path) if path else 0
        actions = {word: "; ".join(map(str, getattr(state, word))) for word in ("entry", "during", "exit")}
        found.add_node(_name(chart, path), kind=kind, label=path[-1] if path else chart.name,
                       parent=_parent(chart, path), order=order, **actions)  # fmt: skip
        if state.default:
            dot = f"{_name(chart, path)}/default"
            found.add_node(dot, kind="default", label="", parent=_name(chart, path), order=0)
    for path in chart.junctions:
        found.add_node(
            _name(chart, path), kind="junction", label=path[-1], parent=_parent(chart, path), order=0
        )
    for arrow in arrows(chart):
        start = _name(chart, arrow.source) + ("/default" if arrow.default else "")
        event = arrow.transition.event or ""
        found.add_edge(start, _name(chart, arrow.target), key=arrow.name, label=label(arrow.transition),
                       order=arrow.order, default=arrow.default, event=event)  # fmt: skip
    return found


def _name(chart: Chart, path: Path) -> str:
    return ".".join((chart.name, *path))


def _parent(chart: Chart, path: Path) -> str:
    return _name(chart, path[:-1]) if path else ""


def graphml(found: "nx.MultiDiGraph[str]") -> str:
    """A graph with text, number and boolean attributes as a GraphML document."""
    out = BytesIO()
    nx.write_graphml_xml(found, out, named_key_ids=True, edge_id_from_attribute=None)
    return out.getvalue().decode() + "\n"
