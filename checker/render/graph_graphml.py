"""A projected state graph as GraphML for graph tools; of any size."""

import networkx as nx

from rovercheck.checker.render.statechart_graphml import graphml
from rovercheck.checker.render.stategraph.words import ticks
from rovercheck.checker.results.format import Format
from rovercheck.checker.results.graph import StateGraph

FORMAT = Format("graphml", "graph", ".graphml", "GraphML with values, counts and components as attributes")


def render(graph: StateGraph) -> str:
    """The GraphML document."""
    found: nx.MultiDiGraph[str] = nx.MultiDiGraph(
        title=graph.title, kind=str(graph.kind), exact=graph.exact, valuations=graph.valuations,
        summary=graph.summary, cut=graph.cut,
    )  # fmt: skip
    for node in graph.nodes:
        values = {f"value {n}": v for n, v in zip(graph.variables, node.shown, strict=True)}
        found.add_node(
            f"s{node.number}", initial=node.initial, valuations=node.valuations, component=node.component,
            dead_end=node.number in graph.dead_ends, absorbing=node.number in graph.absorbing,
            on_path=node.number in graph.path, bad=node.number in graph.bad, marked=node.wanted,
            depth=node.depth, mixed=node.number in graph.mixed, **values,
        )  # fmt: skip
    for edge in graph.edges:
        found.add_edge(
            f"s{edge.source}", f"s{edge.target}", steps=edge.steps, sources=edge.sources,
            sure=(edge.source, edge.target) in graph.sure, example=edge.example,
            ticks=ticks(graph, edge.source, edge.target),
        )  # fmt: skip
    return graphml(found)
