"""What a state graph shows, in sentences: how far it can be trusted, cycles, dead ends and more."""

from collections.abc import Iterator
from textwrap import fill

from rovercheck.checker.render.stategraph.words import behind, named, several
from rovercheck.checker.results.graph import StateGraph

Finding = tuple[str, str]
"""A heading and a sentence."""

MOST = 4
"""Components, and ways to make a projection exact, that are told one by one."""


def findings(graph: StateGraph) -> tuple[Finding, ...]:
    """All that is told beside the picture, the most important first."""
    return tuple(
        [
            *(("CUT", sentence) for sentence in _cut(graph)),
            ("size", f"{graph.size}."),
            ("kind", graph.means),
            *(("because", f"{why}.") for why in graph.because if why.find("is cut") < 0),
            *_exact_with(graph),
            *_marked(graph),
            *_run(graph),
            *_depth(graph),
            *_cycles(graph),
            *_ends(graph),
            *_never(graph),
            *(("note", note) for note in graph.notes),
        ]
    )


def findings_text(graph: StateGraph, width: int = 80) -> str:
    """The findings as lines of text."""
    found = findings(graph)
    wide = max(len(heading) for heading, _ in found) + 2
    lines = [graph.title]
    last = ""
    for heading, sentence in found:
        start = f"  {heading if heading != last else '':<{wide}}"
        lines.append(fill(start + sentence, width, subsequent_indent=" " * len(start)))
        last = heading
    return "\n".join(lines) + "\n"


def _cut(graph: StateGraph) -> Iterator[str]:
    if graph.cut:
        left = sum(n.unexpanded for n in graph.nodes)
        yield (
            f"Not all that is reachable is here: {graph.cut}. "
            f"Of {left:,} of the {graph.valuations:,} states found the ticks are not known."
        )


def _exact_with(graph: StateGraph) -> Iterator[Finding]:
    for names, nodes in graph.exact_with[:MOST]:
        command = f"--project {','.join((*graph.variables, *names))}"
        what = f"with {' and '.join(names)} too, each path is a run of the system"
        yield "finer", f"{what}: {nodes:,} nodes ({command})."


def _marked(graph: StateGraph) -> Iterator[Finding]:
    if not graph.looked_for:
        return
    nodes = [n for n in graph.nodes if n.wanted]
    if not nodes:
        yield "marked", f"{graph.looked_for} in none of the states found."
        return
    count = sum(n.wanted for n in nodes)
    where = several(graph, (n.number for n in nodes))
    yield (
        "marked",
        f"{graph.looked_for} in {count:,} state{'s' * (count != 1)} behind "
        f"{len(nodes):,} node{'s' * (len(nodes) != 1)}: {where}.",
    )


def _run(graph: StateGraph) -> Iterator[Finding]:
    if graph.path:
        route = [graph.path[0]]
        route += [b for a, b in zip(graph.path, graph.path[1:], strict=False) if a != b]
        shown = " → ".join(named(graph, n) for n in route[:12])
        more = f" → … ({len(route) - 12} more)" if len(route) > 12 else ""
        yield "run", f"{graph.path_of or 'the trace'}, {len(graph.path) - 1} ticks: {shown}{more}."


def _depth(graph: StateGraph) -> Iterator[Finding]:
    nodes = max((n.depth for n in graph.nodes), default=0)
    last = [n.number for n in graph.nodes if n.depth == nodes]
    which = f" (last: {several(graph, last, 3)})" if len(graph.nodes) > 1 else ""
    yield (
        "depth",
        f"every node is reached within {nodes:,} ticks{which}, every state within {graph.depth:,}.",
    )


def _cycles(graph: StateGraph) -> Iterator[Finding]:
    several_nodes = sorted(graph.components.items(), key=lambda c: (-len(c[1]), c[0]))
    if not several_nodes:
        yield "cycles", "no two nodes can be reached from each other."
    for number, members in several_nodes[:MOST]:
        if len(members) == len(graph.nodes):
            yield "cycles", "every node can be reached from every other: one strongly connected component."
            return
        end = ", never left" if number in graph.final else ""
        yield (
            "cycles",
            f"a strongly connected component of {len(members)} nodes{end}: {several(graph, members)}.",
        )
    if len(several_nodes) > MOST:
        yield "cycles", f"and {len(several_nodes) - MOST} more components of several nodes."


def _ends(graph: StateGraph) -> Iterator[Finding]:
    alone = sorted(graph.absorbing)
    if alone and len(graph.nodes) > 1:
        yield "never left", f"{several(graph, alone)}."
    if not graph.dead_ends:
        unknown = " of those whose ticks are known" if graph.cut else ""
        yield "dead ends", f"none: every state{unknown} admits some input."
    for node in (graph.nodes[n] for n in sorted(graph.dead_ends)[:MOST]):
        yield (
            "dead ends",
            f"{named(graph, node.number)}: {node.dead:,} of {behind(graph, node)} admit no input.",
        )
    if len(graph.dead_ends) > MOST:
        yield "dead ends", f"and {len(graph.dead_ends) - MOST} more nodes."


def _never(graph: StateGraph) -> Iterator[Finding]:
    seen = " so far" if graph.cut or graph.under else ""
    for name, shown in graph.never.items():
        yield "never", f"{name} is never{seen} {', '.join(shown)}."
