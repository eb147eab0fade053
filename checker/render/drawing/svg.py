"""Write SVG: elements with escaped text, rounded polylines, a document without outside resources."""

from collections.abc import Iterable, Sequence
from xml.sax.saxutils import escape, quoteattr

from rovercheck.checker.render.drawing.graph import Point
from rovercheck.checker.render.drawing.text import LINE, SIZE

FONT = "'DejaVu Sans', Verdana, Helvetica, Arial, sans-serif"


def tag(name: str, content: str = "", **attributes: object) -> str:
    """An element; ``_`` in attribute names stands for ``-`` (``class_`` for ``class``)."""
    shown = "".join(
        f" {key.rstrip('_').replace('_', '-')}={quoteattr(str(value))}"
        for key, value in attributes.items()
        if value != ""
    )
    return f"<{name}{shown}>{content}</{name}>" if content else f"<{name}{shown}/>"


def text(x: float, y: float, shown: str, class_: str = "", **attributes: object) -> str:
    """A line of text whose baseline starts at (x, y); leading spaces indent it."""
    rest = shown.lstrip(" ")
    indent = (len(shown) - len(rest)) * SIZE // 3
    return tag("text", escape(rest), x=x + indent, y=y, class_=class_, **attributes) if rest else ""


def lines(x: int, y: int, shown: Sequence[str], class_: str = "") -> list[str]:
    """Lines of text below each other, the first with its top at y."""
    return [text(x, y + LINE * i + SIZE, line, class_) for i, line in enumerate(shown)]


def path(points: Sequence[Point], radius: int = 6) -> str:
    """The ``d`` of a polyline with rounded corners."""
    points = _simple(points)
    d = [f"M{points[0][0]} {points[0][1]}"]
    for before, corner, after in zip(points, points[1:], points[2:], strict=False):
        near, far = _short(corner, before, radius), _short(corner, after, radius)
        d.append(f"L{near[0]} {near[1]}Q{corner[0]} {corner[1]} {far[0]} {far[1]}")
    d.append(f"L{points[-1][0]} {points[-1][1]}")
    return "".join(d)


def _simple(points: Sequence[Point]) -> list[Point]:
    """Without repeated points and points on the way of a straight line."""
    kept = [points[0]]
    for p, q in zip(points[1:], [*points[2:], None], strict=True):
        (x, y) = kept[-1]
        inline = q is not None and (x == p[0] == q[0] or y == p[1] == q[1])
        if p != kept[-1] and not inline:
            kept.append(p)
    return kept if len(kept) > 1 else [points[0], points[-1]]


def _short(corner: Point, other: Point, radius: int) -> tuple[float, float]:
    """The point ``radius`` away from the corner towards the other, at most halfway."""
    dx, dy = other[0] - corner[0], other[1] - corner[1]
    length = max(1.0, (dx * dx + dy * dy) ** 0.5)
    share = min(radius, length / 2) / length
    return round(corner[0] + dx * share, 1), round(corner[1] + dy * share, 1)


def arrow_head(points: Sequence[Point]) -> str:
    """The ``d`` of a filled head at the end of a polyline."""
    kept = _simple(points)
    (x0, y0), (x, y) = kept[-2], kept[-1]
    length = max(1.0, ((x - x0) ** 2 + (y - y0) ** 2) ** 0.5)
    ux, uy = (x - x0) / length, (y - y0) / length
    bx, by = x - 9 * ux, y - 9 * uy
    corners = [(bx - 3.6 * uy, by + 3.6 * ux), (bx + 3.6 * uy, by - 3.6 * ux)]
    return f"M{x} {y}" + "".join(f"L{round(a, 1)} {round(b, 1)}" for a, b in corners) + "Z"


def document(
    width: int, height: int, style: str, title: str, body: Iterable[str], **attributes: object
) -> str:
    """A whole SVG file with white background."""
    return figure(width, height, title, [f"<style>{style}</style>", *body], **attributes) + "\n"


def figure(width: int, height: int, title: str, body: Iterable[str], **attributes: object) -> str:
    """A picture with white background as it may stand in a page, which brings the style."""
    shown = tag("title", escape(title)) + tag("rect", width=width, height=height, fill="#ffffff")
    content = "\n".join(["", shown, *filter(None, body), ""])
    size = {"width": width, "height": height, "viewBox": f"0 0 {width} {height}"}
    font = {"font_family": FONT, "font_size": SIZE}
    return tag("svg", content, xmlns="http://www.w3.org/2000/svg", **size, **font, **attributes)
