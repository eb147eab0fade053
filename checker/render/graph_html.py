"""A projected state graph as a page: to move about in, to search, and to ask for the way to a node."""

from rovercheck.checker.render.page import page
from rovercheck.checker.render.stategraph.fragment import part
from rovercheck.checker.results.format import Format, Need, Option
from rovercheck.checker.results.graph import MOST_NODES, StateGraph, drawable

FORMAT = Format(
    "html",
    "graph",
    ".html",
    "page to pan, zoom and search; a click shows a state and a run to it",
    needs=frozenset({Need.STATE_RUNS}),
    takes=frozenset({Option.MOST}),
)


def render(graph: StateGraph, most: int = MOST_NODES) -> str:
    """The page.  Raises ``ModelError`` when the graph has more than ``most`` nodes."""
    return page(graph.title, [part(drawable(graph, most))])
