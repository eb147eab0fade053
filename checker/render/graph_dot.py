"""A projected state graph in Graphviz DOT."""

from rovercheck.checker.render.statechart_dot import quoted
from rovercheck.checker.render.stategraph.words import behind, example, ticks, values
from rovercheck.checker.results.format import Format
from rovercheck.checker.results.graph import GraphEdge, GraphNode, StateGraph

FORMAT = Format("dot", "graph", ".dot", "Graphviz source with counts and example inputs")


def render(graph: StateGraph) -> str:
    """The DOT source."""
    lines = [f"digraph {quoted(graph.title)} {{", "  rankdir=LR; fontname=Helvetica; labelloc=t;"]
    lines += [f"  label={quoted(chr(10).join([graph.title, graph.summary, *graph.notes]))};"]
    lines += ["  node [shape=box, style=rounded, fontname=Helvetica, fontsize=10];"]
    lines += ["  edge [fontname=Helvetica, fontsize=8];"]
    lines += [f"  {_node(graph, node)}" for node in graph.nodes]
    lines += [f"  {_edge(graph, edge)}" for edge in graph.edges]
    return "\n".join([*lines, "}", ""])


def _node(graph: StateGraph, node: GraphNode) -> str:
    shown = [*values(graph, node), behind(graph, node)]
    attributes = [f"label={quoted(chr(10).join(shown))}"]
    attributes += ["penwidth=2"] if node.initial else []
    attributes += ["peripheries=2"] if node.dead else []
    if node.number in graph.bad:
        attributes += ['color="#c3241c"', 'style="rounded,filled"', 'fillcolor="#ffd9d4"']
    elif node.number in graph.path:
        attributes.append('color="#b86a00"')
    return f"s{node.number} [{', '.join(attributes)}];"


def _edge(graph: StateGraph, edge: GraphEdge) -> str:
    when = ticks(graph, edge.source, edge.target)
    shown = [*example(edge), f"×{edge.steps:,}", *([when] if when else [])]
    attributes = [f"label={quoted(chr(10).join(shown))}"]
    attributes += [] if (edge.source, edge.target) in graph.sure else ["style=dashed"]
    attributes += ['color="#c3241c"', "penwidth=2"] if when else []
    return f"s{edge.source} -> s{edge.target} [{', '.join(attributes)}];"
