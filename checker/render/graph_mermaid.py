"""A projected state graph as a Mermaid flowchart, which GitHub shows in Markdown."""

from checker.graph import StateGraph, drawable
from checker.render.statechart_mermaid import escaped

NAME = "mermaid"
KIND = "graph"
SUFFIX = ".mmd"
SUMMARY = "Mermaid flowchart of a small projected graph"


def render(graph: StateGraph) -> str:
    """The diagram's source.  Raises ``ModelError`` when it has more nodes than can be read."""
    drawable(graph)
    lines = ["flowchart LR", f"  %% {graph.title}: {graph.summary}"]
    for node in graph.nodes:
        values = [f"{n} = {v}" for n, v in zip(graph.variables, node.shown, strict=True)]
        shown = "<br>".join(map(escaped, [*values, f"×{node.valuations}"]))
        shape = ('(["', '"])') if node.initial else ('("', '")')
        lines.append(f"  s{node.number}{shape[0]}{shown}{shape[1]}")
    for edge in graph.edges:
        label = "<br>".join(map(escaped, [*edge.example.split(", "), f"×{edge.steps}"]))
        lines.append(f'  s{edge.source} -->|"{label}"| s{edge.target}')
    lines += [f"  style s{n} fill:#ffd9d4,stroke:#c3241c" for n in sorted(graph.bad)]
    lines += [f"  style s{n} stroke:#b86a00,stroke-width:3px" for n in sorted(set(graph.path) - graph.bad)]
    return "\n".join([*lines, ""])
