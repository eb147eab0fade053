"""A state graph as the review page has it: texts and HTML, without the runs that it was made of."""

from collections.abc import Mapping, Sequence
from typing import Any

from rovercheck.checker.render.review.model import StateGraphView
from rovercheck.checker.render.stategraph import fragment
from rovercheck.checker.results.graph import StateGraph


def graph_view(
    system: str,
    graph: StateGraph,
    runs: Mapping[str, Sequence[int]] = {},
    asked: tuple[str, ...] = (),
    again: str = "",
    unmarked: tuple[str, ...] = (),
) -> StateGraphView:
    """The graph of a system; ``runs`` are the nodes that counterexamples pass, by property."""
    return StateGraphView(
        system,
        graph.variables,
        graph.size,
        str(graph.kind),
        str(fragment.part(graph, runs, alone=False).body),
        str(fragment.trust(graph).body),
        str(fragment.shows(graph).body),
        asked,
        again,
        unmarked,
    )


def kept_view(row: Mapping[str, Any]) -> StateGraphView:
    """The same from its fields as JSON.  Raises one of ``cache.entries.MEANINGLESS``."""
    lists = {name: tuple(row[name]) for name in ("variables", "asked", "unmarked")}
    return StateGraphView(**{**row, **lists})
