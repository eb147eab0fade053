"""A projected state graph as a Mermaid flowchart, which GitHub shows in Markdown."""

from rovercheck.checker.render.statechart_mermaid import escaped
from rovercheck.checker.render.stategraph.words import behind, example, ticks, values
from rovercheck.checker.results.format import Format, Option
from rovercheck.checker.results.graph import MOST_NODES, StateGraph, drawable

FORMAT = Format(
    "mermaid", "graph", ".mmd", "Mermaid flowchart of a small projected graph", takes=frozenset({Option.MOST})
)


def render(graph: StateGraph, most: int = MOST_NODES) -> str:
    """The diagram's source.  Raises ``ModelError`` when it has more than ``most`` nodes."""
    drawable(graph, most)
    lines = ["flowchart LR", f"  %% {graph.title}: {graph.summary}"]
    for node in graph.nodes:
        shown = "<br>".join(map(escaped, [*values(graph, node), behind(graph, node)]))
        shape = ('(["', '"])') if node.initial else ('("', '")')
        lines.append(f"  s{node.number}{shape[0]}{shown}{shape[1]}")
    for edge in graph.edges:
        when = ticks(graph, edge.source, edge.target)
        label = "<br>".join(map(escaped, [*example(edge), f"×{edge.steps:,}", *([when] if when else [])]))
        arrow = "-->" if (edge.source, edge.target) in graph.sure else "-.->"
        lines.append(f'  s{edge.source} {arrow}|"{label}"| s{edge.target}')
    lines += [f"  style s{n} fill:#ffd9d4,stroke:#c3241c" for n in sorted(graph.bad)]
    lines += [f"  style s{n} stroke:#b86a00,stroke-width:3px" for n in sorted(set(graph.path) - graph.bad)]
    return "\n".join([*lines, ""])
