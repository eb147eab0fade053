"""A chart as an SVG picture a Stateflow user recognises."""

from collections.abc import Collection

from checker.render.drawing import svg
from checker.render.drawing.highlight import Emphasis, emphasis
from checker.render.drawing.nested import picture
from checker.render.drawing.picture import Box, Piece, Spot
from checker.render.drawing.scheme import arrows, explained
from checker.render.drawing.text import LINE, width, wrap
from checker.trace import Arrow
from spec_model.lang.chart import Chart

NAME = "svg"
KIND = "statechart"
SUFFIX = ".svg"
SUMMARY = "picture with nested boxes, labelled arrows and priorities; no outside resources"

MARGIN = 24
STYLE = """
.state{fill:#fffdf6;stroke:#5b5b66;stroke-width:1.3}
.composite{fill:#f7f8fb;stroke:#5b5b66;stroke-width:1.3}
.region{fill:#fdfdfd;stroke:#5b5b66;stroke-width:1.3;stroke-dasharray:6 4}
.title{font-size:13px;font-weight:bold;fill:#1d2433}
.chart{font-size:17px;font-weight:bold;fill:#1d2433}
.order{font-size:12px;fill:#5b5b66}
.action{fill:#333a48}
.rule{stroke:#c9ccd6;stroke-width:1}
.line{fill:none;stroke:#35507a;stroke-width:1.3}
.head,.dot{fill:#35507a;stroke:none}
.junction{fill:#ffffff;stroke:#35507a;stroke-width:1.3}
.label{fill:#1f3558}
.number{font-size:9.5px;fill:#35507a}
.note{fill:#6a7080}
.active{fill:#ffeeb8;stroke:#b86a00;stroke-width:2.2}
.composite.active,.region.active{fill:#fffaf0}
.fired .line{stroke:#c3241c;stroke-width:2.4}
.fired .head,.fired .dot{fill:#c3241c}
.fired .label,.fired .number{fill:#a81b14}
"""
LEGEND = (
    "dashed box: parallel region, its number the order of execution",
    "number at the start of an arrow: its priority",
    "label: event [guard] {condition action} / transition action",
)


def render(chart: Chart, active: Collection[str] = (), fired: Collection[Arrow] = ()) -> str:
    """The picture as SVG text.

    ``active`` names states to be shown as active (the states around them are too), ``fired`` holds
    arrows of a trace to be shown as taken.  Raises ``ModelError`` for an unknown name.
    """
    shown = emphasis(chart, arrows(chart), active, fired)
    heading = [chart.name, *wrap(chart.text, 110)]
    top = MARGIN + 20 + LINE * (len(heading) - 1) + 10
    place = picture(chart).moved(MARGIN, top)
    wide = max(place.width, *(width(t, 17 if not i else 11) for i, t in enumerate(heading)), 420) + 2 * MARGIN
    foot = _foot(chart, wide - 2 * MARGIN)
    body = [svg.text(MARGIN, MARGIN + 14, heading[0], "chart")]
    body += svg.lines(MARGIN, MARGIN + 24, heading[1:], "note")
    body += [part for box in place.boxes for part in _box(box, shown)]
    body += [_piece(piece, shown) for piece in place.pieces]
    body += [_spot(spot) for spot in place.spots]
    body += svg.lines(MARGIN, top + place.height + 18, foot, "note")
    high = top + place.height + 18 + LINE * len(foot) + MARGIN
    return svg.document(wide, high, STYLE, f"{chart.name}: statechart", body)


def _foot(chart: Chart, room: int) -> list[str]:
    """What the names in labels stand for, and the legend."""
    limit = max(60, room // 7)
    names = [line for n, body in explained(chart).items() for line in wrap(f"{n} = {body}", limit, "    ")]
    legend = wrap("; ".join(LEGEND), limit)
    return [*names, *([""] if names else []), *legend]


def _box(box: Box, shown: Emphasis) -> list[str]:
    kind = "region" if box.order else "composite" if box.composite else "state"
    classes = f"{kind} active" if box.path in shown.states else kind
    radius = 10 if not box.order else 6
    parts = [svg.tag("rect", x=box.x, y=box.y, width=box.width, height=box.height, rx=radius, class_=classes)]
    parts.append(svg.text(box.x + 12, box.y + 17, box.path[-1], "title"))
    if box.order:
        parts.append(svg.text(box.x + box.width - 16, box.y + 17, str(box.order), "order"))
    if box.lines:
        y = box.y + 22
        parts.append(svg.tag("line", x1=box.x, x2=box.x + box.width, y1=y, y2=y, class_="rule"))
        parts += svg.lines(box.x + 12, y + 3, box.lines, "action")
    return parts


def _piece(piece: Piece, shown: Emphasis) -> str:
    parts = [svg.tag("path", d=svg.path(piece.points), class_="line")]
    if piece.ends:
        parts.append(svg.tag("path", d=svg.arrow_head(piece.points), class_="head"))
    if piece.starts:
        parts += svg.lines(*piece.label, piece.lines, "label")
        parts.append(_number(piece))
    classes = "arrow fired" if piece.arrow.name in shown.arrows else "arrow"
    return svg.tag("g", "".join(parts), class_=classes)


def _number(piece: Piece) -> str:
    """The priority just above the start of the line; beyond the slanting start at a junction."""
    (x, y), (x1, y1) = piece.points[0], piece.points[1]
    right = x1 > x
    if x1 != x and y1 != y:
        x, y = x1, y1
    return svg.text(x + (3 if right else -9), y - 3, piece.arrow.number, "number")


def _spot(spot: Spot) -> str:
    return svg.tag("circle", cx=spot.x, cy=spot.y, r=spot.radius, class_="dot" if spot.dot else "junction")
