"""A small chart as a Mermaid state diagram, which GitHub shows in Markdown.

Mermaid cannot draw composites inside parallel regions (it crashes), actions of a composite, nor arrows
that cross the border of a composite inside another one (it draws the state elsewhere).  Such a chart
is refused rather than drawn wrong.  Names of regions are not shown.
"""

from collections.abc import Iterator

from rovercheck.checker.render.drawing.labels import ChartArrow, action_lines, arrows, identifiers, label
from rovercheck.checker.results.format import Format
from rovercheck.spec_model.lang.chart import Chart, Path
from rovercheck.spec_model.lang.errors import ModelError

FORMAT = Format(
    "mermaid", "statechart", ".mmd", "Mermaid stateDiagram-v2, for charts without nested parallel states"
)

_OTHERS = "Use svg, dot or graphml for this chart."


def render(chart: Chart) -> str:
    """The diagram's source.  Raises ``ModelError`` for a chart that Mermaid cannot draw."""
    every = arrows(chart)
    _refuse(chart, every)
    ids = identifiers(chart)
    body = list(_inside(chart, (), ids, every))
    if chart.root.parallel:
        name = f"state {_quoted(chart.name)} as {ids[()]}"
        body = [name, f"state {ids[()]} {{", *(f"  {line}" for line in body), "}"]
    return "\n".join(["stateDiagram-v2", "  direction LR", *(f"  {line}" for line in body), ""])


def _refuse(chart: Chart, every: tuple[ChartArrow, ...]) -> None:
    for path, state in chart.states.items():
        above = [chart.states[path[:depth]] for depth in range(len(path))]
        if state.states and any(s.parallel for s in above[:-1]):
            raise ModelError(
                f"{chart.name}: {'.'.join(path)} is a composite inside a parallel region, "
                f"at which Mermaid crashes (mermaid-js/mermaid#4052). {_OTHERS}"
            )
        if state.states and action_lines(state):
            raise ModelError(
                f"{chart.name}: {'.'.join(path)} is a composite with actions, "
                f"for which Mermaid has no place. {_OTHERS}"
            )
    for arrow in every:
        start, end = _levels(arrow)
        if start != end and _common(arrow):
            raise ModelError(
                f"{chart.name}: the transition from {'.'.join(arrow.source)} to {'.'.join(arrow.target)} "
                f"crosses the border of a composite inside {'.'.join(_common(arrow))}, "
                "which Mermaid draws wrong. "
                f"{_OTHERS}"
            )


def _inside(chart: Chart, level: Path, ids: dict[Path, str], every: tuple[ChartArrow, ...]) -> Iterator[str]:
    """The lines of one level: its states, each where it belongs, then its arrows."""
    state = chart.states[level]
    for number, child in enumerate(state.states):
        path = (*level, child.name)
        if state.parallel:
            yield from ["--"] if number else []
            yield from _inside(chart, path, ids, every) if child.states else [_named(path, ids)]
            continue
        yield _named(path, ids)
        yield from (f"{ids[path]} : {escaped(line)}" for line in action_lines(child))
        if child.states:
            yield f"state {ids[path]} {{"
            yield from (f"  {line}" for line in _inside(chart, path, ids, every))
            yield "}"
    yield from (f"state {ids[(*level, j.name)]} <<choice>>" for j in state.junctions)
    yield from (_arrow(arrow, ids) for arrow in every if _common(arrow) == level)


def _named(path: Path, ids: dict[Path, str]) -> str:
    return f"state {_quoted(path[-1])} as {ids[path]}"


def _levels(arrow: ChartArrow) -> tuple[Path, Path]:
    """The levels in which the ends of an arrow lie."""
    return arrow.source if arrow.default else arrow.source[:-1], arrow.target[:-1]


def _common(arrow: ChartArrow) -> Path:
    """The innermost level around both ends."""
    start, end = _levels(arrow)
    depth = 0
    while depth < min(len(start), len(end)) and start[depth] == end[depth]:
        depth += 1
    return start[:depth]


def _arrow(arrow: ChartArrow, ids: dict[Path, str]) -> str:
    start = "[*]" if arrow.default else ids[arrow.source]
    shown = " ".join(filter(None, [f"({arrow.number})" if arrow.number else "", label(arrow.transition)]))
    return f"{start} --> {ids[arrow.target]}" + (f" : {escaped(shown)}" if shown else "")


def escaped(shown: str) -> str:
    """Text with the characters that Mermaid's grammar uses as entity codes."""
    codes = {
        "#": "#35;",
        ";": "#59;",
        ":": "#58;",
        "<": "#lt;",
        ">": "#gt;",
        '"': "#quot;",
        "{": "#123;",
        "}": "#125;",
    }
    return "".join(codes.get(c, c) for c in shown.strip())


def _quoted(name: str) -> str:
    return f'"{escaped(name)}"'
