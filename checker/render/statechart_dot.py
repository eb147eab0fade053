"""A chart in Graphviz DOT, composites as clusters, for people who have Graphviz."""

from collections.abc import Iterator

from rovercheck.checker.render.drawing.labels import (
    ChartArrow,
    action_lines,
    arrows,
    execution_order,
    identifiers,
    label_parts,
)
from rovercheck.checker.render.drawing.text import wrap
from rovercheck.checker.results.format import Format
from rovercheck.spec_model.lang.chart import Chart, Path

FORMAT = Format("dot", "statechart", ".dot", "Graphviz source with a cluster per composite")


def render(chart: Chart) -> str:
    """The DOT source."""
    ids = identifiers(chart)
    every = arrows(chart)
    lines = [
        f"digraph {quoted(chart.name)} {{",
        "  compound=true; rankdir=LR; fontname=Helvetica; fontsize=11;",
    ]
    lines += [f"  label={quoted(chart.name)}; labelloc=t; fontsize=12;" if not chart.root.parallel else ""]
    lines += ["  node [shape=box, style=rounded, fontname=Helvetica, fontsize=10];"]
    lines += ["  edge [fontname=Helvetica, fontsize=9];"]
    lines += [f"  {line}" for line in _inside(chart, (), ids)]
    lines += [f"  {_edge(chart, arrow, ids)}" for arrow in every]
    return "\n".join([*filter(None, lines), "}", ""])


def _inside(chart: Chart, level: Path, ids: dict[Path, str]) -> Iterator[str]:
    state = chart.states[level]
    if state.default:
        yield f'{ids[level]}_dot [shape=point, width=0.12, label=""];'
    for junction in state.junctions:
        name = quoted(junction.name)
        yield f'{ids[(*level, junction.name)]} [shape=circle, width=0.15, label="", tooltip={name}];'
    for child in state.states:
        path = (*level, child.name)
        if not child.states:
            yield f"{ids[path]} [label={quoted(chr(10).join(_title(chart, path)), left=True)}];"
            continue
        yield f"subgraph cluster_{ids[path]} {{"
        style = "dashed" if state.parallel else "rounded"
        yield f"  style={style}; labeljust=l; label={quoted(chr(10).join(_title(chart, path)), left=True)};"
        yield f'  {ids[path]} [shape=point, style=invis, label=""];'
        yield from (f"  {line}" for line in _inside(chart, path, ids))
        yield "}"


def _title(chart: Chart, path: Path) -> list[str]:
    order = execution_order(chart, path)
    return [f"{path[-1]} ({order})" if order else path[-1], *action_lines(chart.states[path])]


def _edge(chart: Chart, arrow: ChartArrow, ids: dict[Path, str]) -> str:
    shown = [part for whole in label_parts(arrow.transition) for part in wrap(whole, 36, "  ")]
    number = [f"{arrow.number}:"] if arrow.number else []
    attributes = [f"label={quoted(chr(10).join([*number, *shown]))}"] if shown or number else []
    start = f"{ids[arrow.source]}_dot" if arrow.default else ids[arrow.source]
    inner = arrow.target[: len(arrow.source)] == arrow.source
    if not arrow.default and _composite(chart, arrow.source) and not inner:
        attributes.append(f"ltail=cluster_{ids[arrow.source]}")
    if _composite(chart, arrow.target) and arrow.source[: len(arrow.target)] != arrow.target:
        attributes.append(f"lhead=cluster_{ids[arrow.target]}")
    tail = f" [{', '.join(attributes)}]" if attributes else ""
    return f"{start} -> {ids[arrow.target]}{tail};"


def _composite(chart: Chart, path: Path) -> bool:
    return path in chart.states and bool(chart.states[path].states)


def quoted(shown: str, left: bool = False) -> str:
    """A DOT string; line breaks become centred or left-justified ones."""
    end = "\\l" if left else "\\n"
    body = shown.replace("\\", "\\\\").replace('"', '\\"').replace("\n", end)
    return f'"{body}{end if left and chr(10) in shown else ""}"'
