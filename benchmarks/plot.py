"""A small line plot in SVG: cases from left to right, seconds upwards on a logarithmic scale."""

from collections.abc import Iterator, Mapping, Sequence
from math import ceil, floor, log10
from xml.sax.saxutils import escape

WIDTH, HEIGHT, LEFT, TOP, RIGHT, BOTTOM = 560, 300, 56, 34, 96, 40
COLOURS = ("#1b6ca8", "#c1440e", "#2e7d32", "#6a3d9a", "#8d6e00", "#444444")

Series = Mapping[str, Sequence[float | None]]
"""Seconds for each case by name of the tool; None where it decided nothing."""


def plot(title: str, axis: str, cases: Sequence[str], series: Series) -> str:
    """The plot as a document.  A tool without any value is left out."""
    shown = {name: values for name, values in series.items() if any(v for v in values)}
    logs = [log10(v) for values in shown.values() for v in values if v] or [0.0]
    low, high = floor(min(logs)), max(ceil(max(logs)), floor(min(logs)) + 1)

    def at(case: int, seconds: float) -> tuple[float, float]:
        x = LEFT + (WIDTH - LEFT - RIGHT) * case / max(1, len(cases) - 1)
        share = (log10(seconds) - low) / (high - low)
        return round(x, 1), round(HEIGHT - BOTTOM - (HEIGHT - TOP - BOTTOM) * share, 1)

    parts = [_text(LEFT, 18, title, "start", "bold")]
    for power in range(low, high + 1):
        _, y = at(0, 10.0**power)
        parts.append(f'<path d="M{LEFT} {y}H{WIDTH - RIGHT}" stroke="#ddd"/>')
        parts.append(_text(LEFT - 6, y + 4, f"{10.0**power:g} s", "end"))
    for number, case in enumerate(cases):
        parts.append(_text(at(number, 10.0**low)[0], HEIGHT - BOTTOM + 18, case, "middle"))
    parts.append(_text((LEFT + WIDTH - RIGHT) / 2, HEIGHT - 6, axis, "middle"))
    for (name, values), colour in zip(shown.items(), COLOURS * len(shown), strict=False):
        points = [at(number, v) for number, v in enumerate(values) if v]
        parts += _line(name, points, colour)
    head = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" font-family="sans-serif"'
    return "\n".join(
        [f'{head} font-size="12">', '<rect width="100%" height="100%" fill="#fff"/>', *parts, "</svg>\n"]
    )


def _line(name: str, points: Sequence[tuple[float, float]], colour: str) -> Iterator[str]:
    path = "L".join(f"{x} {y}" for x, y in points)
    yield f'<path d="M{path}" fill="none" stroke="{colour}" stroke-width="2"/>'
    yield from (f'<circle cx="{x}" cy="{y}" r="3" fill="{colour}"/>' for x, y in points)
    yield _text(points[-1][0] + 8, points[-1][1] + 4, name, "start", colour=colour)


def _text(x: float, y: float, text: str, anchor: str, weight: str = "normal", colour: str = "#222") -> str:
    style = f'text-anchor="{anchor}" font-weight="{weight}" fill="{colour}"'
    return f'<text x="{x}" y="{y}" {style}>{escape(text)}</text>'
