"""A small chart as a Mermaid state diagram, which GitHub shows in Markdown.

Mermaid cannot draw composites inside parallel regions (it crashes) nor arrows between states of
different composites.  Such a chart is refused rather than drawn without them.
"""

from collections.abc import Iterator

from checker.render.drawing.scheme import ChartArrow, action_lines, arrows, identifiers, label
from spec_model.lang.chart import Chart, Path
from spec_model.lang.errors import ModelError

NAME = "mermaid"
KIND = "statechart"
SUFFIX = ".mmd"
SUMMARY = "Mermaid stateDiagram-v2, for charts without nested parallel states"

_OTHERS = "Use svg, dot or graphml for this chart."


def render(chart: Chart) -> str:
    """The diagram's source.  Raises ``ModelError`` for a chart that Mermaid cannot draw."""
    every = arrows(chart)
    _refuse(chart, every)
    ids = identifiers(chart)
    lines = ["stateDiagram-v2", "  direction LR"]
    lines += [f"  state {_quoted(p[-1])} as {ids[p]}" for p in chart.states if p]
    lines += [f"  state {ids[p]} <<choice>>" for p in chart.junctions]
    body = list(_inside(chart, (), ids, every))
    if chart.root.parallel:
        body = [
            f"state {_quoted(chart.name)} as {ids[()]}",
            f"state {ids[()]} {{",
            *(f"  {x}" for x in body),
            "}",
        ]
    lines += [f"  {line}" for line in body]
    return "\n".join([*lines, ""])


def _refuse(chart: Chart, every: tuple[ChartArrow, ...]) -> None:
    for path, state in chart.states.items():
        above = [chart.states[path[:depth]] for depth in range(len(path))]
        if state.states and any(s.parallel for s in above[:-1]):
            raise ModelError(
                f"{chart.name}: {'.'.join(path)} is a composite inside a parallel region, "
                f"at which Mermaid crashes (mermaid-js/mermaid#4052). {_OTHERS}"
            )
    for arrow in every:
        start, end = arrow.source if arrow.default else arrow.source[:-1], arrow.target[:-1]
        if start[: len(end)] != end and end[: len(start)] != start:
            raise ModelError(
                f"{chart.name}: the arrow from {'.'.join(arrow.source)} to {'.'.join(arrow.target)} joins "
                f"states of different composites, which Mermaid cannot draw. {_OTHERS}"
            )


def _inside(chart: Chart, level: Path, ids: dict[Path, str], every: tuple[ChartArrow, ...]) -> Iterator[str]:
    state = chart.states[level]
    for number, child in enumerate(state.states):
        path = (*level, child.name)
        if state.parallel:
            yield from ["--"] if number else []
            yield from _inside(chart, path, ids, every) if child.states else [ids[path]]
        elif child.states:
            yield f"state {ids[path]} {{"
            yield from (f"  {line}" for line in _inside(chart, path, ids, every))
            yield "}"
        yield from (f"{ids[path]} : {escaped(line)}" for line in _described(chart, path))
    for arrow in every:
        if _common(arrow) == level:
            yield _arrow(arrow, ids)


def _described(chart: Chart, path: Path) -> tuple[str, ...]:
    state = chart.states[path]
    if state.states or not (lines := action_lines(state)):
        return ()
    return (path[-1], *lines)


def _common(arrow: ChartArrow) -> Path:
    """The innermost level around both ends."""
    start, end = arrow.source if arrow.default else arrow.source[:-1], arrow.target[:-1]
    return start if len(start) < len(end) else end


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
