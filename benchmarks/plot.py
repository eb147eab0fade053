"""A small line plot in SVG: cases from left to right, seconds upwards on a logarithmic scale."""

from collections.abc import Iterator, Mapping, Sequence
from itertools import pairwise
from math import ceil, floor, log10
from xml.sax.saxutils import escape

from benchmarks.labels import SIZE, Box, Label, Point, labels, room

ACROSS, LEFT, TOP, BOTTOM = 408, 56, 34, 40
"""Pixels between the first case and the last, and around the plot."""
LEAST_HEIGHT = 226
COLOURS = ("#1b6ca8", "#c1440e", "#2e7d32", "#6a3d9a", "#8d6e00", "#444444")

Series = Mapping[str, Sequence[float | None]]
"""Seconds for each case by name of the tool; None, a gap in its line, where it decided nothing."""


def plot(title: str, axis: str, cases: Sequence[str], series: Series) -> str:
    """The plot as a document.  A tool without any value is left out; another keeps its colour."""
    shown = {name: values for name, values in series.items() if any(v for v in values)}
    colours = {name: COLOURS[number % len(COLOURS)] for number, name in enumerate(series)}
    logs = [log10(v) for values in shown.values() for v in values if v] or [0.0]
    low, high = floor(min(logs)), max(ceil(max(logs)), floor(min(logs)) + 1)
    beside, least = room(tuple(shown))
    height = max(LEAST_HEIGHT, least)
    right, bottom = LEFT + ACROSS, TOP + height

    def at(case: int, seconds: float) -> Point:
        x = LEFT + ACROSS * case / max(1, len(cases) - 1)
        return round(x, 1), round(bottom - height * (log10(seconds) - low) / (high - low), 1)

    parts = [_text(LEFT, 18, title, "start", "bold")]
    for power in range(low, high + 1):
        _, y = at(0, 10.0**power)
        parts.append(f'<path d="M{LEFT} {y}H{right}" stroke="#ddd"/>')
        parts.append(_text(LEFT - 6, y + 4, f"{10.0**power:g} s", "end"))
    for number, case in enumerate(cases):
        parts.append(_text(at(number, 10.0**low)[0], bottom + 18, case, "middle"))
    parts.append(_text(LEFT + ACROSS / 2, bottom + BOTTOM - 6, axis, "middle"))
    lines = {name: [at(n, v) if v else None for n, v in enumerate(values)] for name, values in shown.items()}
    for name, points in lines.items():
        parts += _line(points, colours[name])
    drawn = {name: [point for point in points if point] for name, points in lines.items()}
    for label in labels(drawn, Box(LEFT, TOP, right + beside, bottom)):
        parts += _label(label, colours[label.name])
    return _document(right + beside, bottom + BOTTOM, parts)


def _document(wide: int, high: int, parts: Sequence[str]) -> str:
    head = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {wide} {high}" font-family="sans-serif"'
    ground = '<rect width="100%" height="100%" fill="#fff"/>'
    return "\n".join([f'{head} font-size="{SIZE}">', ground, *parts, "</svg>\n"])


def _line(points: Sequence[Point | None], colour: str) -> Iterator[str]:
    """Dots, joined where neighbours are known."""
    pairs = [(before, point) for before, point in pairwise([None, *points]) if point]
    path = "".join(f"{'L' if before else 'M'}{x} {y}" for before, (x, y) in pairs)
    yield f'<path d="{path}" fill="none" stroke="{colour}" stroke-width="2"/>'
    yield from (f'<circle cx="{x}" cy="{y}" r="3" fill="{colour}"/>' for _, (x, y) in pairs)


def _label(label: Label, colour: str) -> Iterator[str]:
    """The name over a rim of the ground's colour, so that a line of the grid does not strike it out."""
    if label.leader is not None:
        (x, y), (to_x, to_y) = label.leader
        yield f'<path d="M{x:g} {y:g}L{to_x:g} {to_y:g}" stroke="{colour}" stroke-width="0.7"/>'
    yield _text(label.box.left, label.box.bottom - 3, label.name, "start", colour=colour)


def _text(x: float, y: float, text: str, anchor: str, weight: str = "normal", colour: str = "#222") -> str:
    style = f'text-anchor="{anchor}" font-weight="{weight}" fill="{colour}"'
    rim = 'stroke="#fff" stroke-width="3" paint-order="stroke"'
    return f'<text x="{x:g}" y="{y:g}" {style} {rim}>{escape(text)}</text>'
