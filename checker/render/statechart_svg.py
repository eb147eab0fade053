"""A chart as an SVG picture a Stateflow user recognises."""

from collections.abc import Collection, Sequence
from functools import lru_cache

from rovercheck.checker.render.drawing import svg
from rovercheck.checker.render.drawing.emphasis import Emphasis, emphasis
from rovercheck.checker.render.drawing.folding import shortened
from rovercheck.checker.render.drawing.labels import action_lines, arrows, explained
from rovercheck.checker.render.drawing.nested_layout import picture
from rovercheck.checker.render.drawing.own_figure import own_picture
from rovercheck.checker.render.drawing.picture import Box, PicturePiece, Spot
from rovercheck.checker.render.drawing.text import LINE, block, width, wrap
from rovercheck.checker.results.format import Format
from rovercheck.checker.results.trace import TakenTransition
from rovercheck.spec_model.lang.chart import Chart

FORMAT = Format(
    "svg",
    "statechart",
    ".svg",
    "picture with nested boxes, labelled transitions and priorities; no outside resources",
)

MARGIN = 24
HISTORY = "History"
"""What the names of history junctions begin with."""
ACTION = 62
"""Letters of a line of a list of actions that is unfolded."""
STYLE = """
.statechart .state>rect{fill:#fffdf6;stroke:#5b5b66;stroke-width:1.3}
.statechart .composite>rect{fill:#f7f8fb;stroke:#5b5b66;stroke-width:1.3}
.statechart .region>rect{fill:#fdfdfd;stroke:#5b5b66;stroke-width:1.3;stroke-dasharray:6 4}
.statechart .title{font-size:13px;font-weight:bold;fill:#1d2433}
.statechart .chart{font-size:17px;font-weight:bold;fill:#1d2433}
.statechart .order{font-size:12px;fill:#5b5b66}
.statechart .action{fill:#333a48}
.statechart .rule{stroke:#c9ccd6;stroke-width:1}
.statechart .line{fill:none;stroke:#35507a;stroke-width:1.3}
.statechart .head,.statechart .dot{fill:#35507a;stroke:none}
.statechart .junction{fill:#ffffff;stroke:#35507a;stroke-width:1.3}
.statechart .label{fill:#1f3558}
.statechart .number{font-size:9.5px;fill:#35507a}
.statechart .note{fill:#6a7080}
.statechart .active>rect{fill:#ffeeb8;stroke:#b86a00;stroke-width:2.2}
.statechart .composite.active>rect,.statechart .region.active>rect{fill:#fffaf0}
.statechart .taken .line{stroke:#d08a80;stroke-width:2}
.statechart .taken .head,.statechart .taken .dot{fill:#d08a80}
.statechart .fired .line{stroke:#c3241c;stroke-width:2.4}
.statechart .fired .head,.statechart .fired .dot{fill:#c3241c}
.statechart .fired .label,.statechart .fired .number{fill:#a81b14}
"""
PAGE_STYLE = f"""{STYLE}
.statechart .folded{{cursor:pointer}}.statechart .folded .action:last-child{{fill:#1f4e9c;font-weight:bold}}
.statechart .all-actions{{display:none;cursor:pointer}}.statechart .all-actions.open{{display:inline}}
.statechart .all-actions rect{{fill:#fffef9;stroke:#1f4e9c;stroke-width:1.6}}
"""
"""With that of lists of actions that unfold."""
LEGEND = (
    "dashed box: parallel region, its number the order of execution",
    "number at the start of a transition: its priority",
    "label: event [guard] {condition action} / transition action",
)


def render(chart: Chart, active: Collection[str] = (), fired: Collection[TakenTransition] = ()) -> str:
    """The picture as SVG text.

    ``active`` names states to be shown as active (the states around them are too), ``fired`` holds
    arrows of a trace to be shown as taken.  Raises ``ModelError`` for an unknown name.
    """
    shown = emphasis(chart, arrows(chart), active, fired)
    wide, high, body = _drawn(chart, shown)
    return svg.document(wide, high, STYLE, _title(chart), body, class_="statechart")


def inline(chart: Chart) -> str:
    """The picture for a page that has ``PAGE_STYLE`` and says what ``LEGEND`` says.

    Its parts are found by attributes, as it has no ids: ``data-state`` is the dotted path of a state,
    ``data-arrow`` the name of a ``ChartArrow`` (on every piece of its line).  The classes ``active``,
    ``fired`` and ``taken`` emphasise them.  Of long lists of actions the beginning is drawn; a click on it
    shows the whole, by the script ``unfold.js`` of pages.
    """
    return _inline(chart)[2]


def size(chart: Chart) -> tuple[int, int]:
    """Width and height of the picture ``inline``, in pixels."""
    return _inline(chart)[:2]


@lru_cache(maxsize=64)
def _inline(chart: Chart) -> tuple[int, int, str]:
    wide, high, body = _drawn(chart, Emphasis(), legend=(), folded=True)
    return wide, high, svg.figure(wide, high, _title(chart), body, class_="statechart", role="img")


def _title(chart: Chart) -> str:
    return f"{chart.name}: statechart"


def _drawn(
    chart: Chart, shown: Emphasis, legend: Sequence[str] = LEGEND, folded: bool = False
) -> tuple[int, int, list[str]]:
    """Width, height and elements."""
    heading = [chart.name, *wrap(chart.text, 110)]
    top = MARGIN + 20 + LINE * (len(heading) - 1) + 10
    figure = chart.figure
    place = picture(chart, folded) if figure is None else own_picture(chart, figure, folded)
    place = place.moved(MARGIN, top)
    wide = max(place.width, *(width(t, 17 if not i else 11) for i, t in enumerate(heading)), 420) + 2 * MARGIN
    foot = _foot(chart, wide - 2 * MARGIN, legend)
    body = [svg.text(MARGIN, MARGIN + 14, heading[0], "chart")]
    body += svg.lines(MARGIN, MARGIN + 24, heading[1:], "note")
    long = {box.path: action_lines(chart.states[box.path]) for box in place.boxes} if folded else {}
    long = {path: lines for path, lines in long.items() if shortened(lines) != lines}
    body += [_box(box, shown, box.path in long) for box in place.boxes]
    body += [_piece(piece, shown) for piece in place.pieces]
    body += [_spot(spot) for spot in place.spots]
    body += svg.lines(MARGIN, top + place.height + 18, foot, "note")
    high = top + place.height + (18 + LINE * len(foot) if foot else 0) + MARGIN
    body += [_unfolded(box, long[box.path], wide, high) for box in place.boxes if box.path in long]
    return wide, high, body


def _unfolded(box: Box, actions: Sequence[str], wide: int, high: int) -> str:
    """All actions of a state over what is below its title, hidden until they are asked for."""
    lines = tuple(line for action in actions for line in wrap(action, ACTION, "    "))
    across, down = max(box.width, block(lines)[0] + 24), LINE * len(lines) + 10
    x, y = max(0, min(box.x, wide - across)), max(0, min(box.y + 22, high - down))
    frame = svg.tag("rect", x=x, y=y, width=across, height=down, rx=4)
    parts = "".join([frame, *svg.lines(x + 12, y + 3, lines, "action")])
    return svg.tag("g", parts, class_="all-actions", data_actions=".".join(box.path))


def _foot(chart: Chart, room: int, legend: Sequence[str]) -> list[str]:
    """What the names in labels stand for, and the legend."""
    limit = max(60, room // 7)
    names = [line for n, body in explained(chart).items() for line in wrap(f"{n} = {body}", limit, "    ")]
    rest = wrap("; ".join(legend), limit)
    return [*names, *([""] if names and rest else []), *rest]


def _box(box: Box, shown: Emphasis, folded: bool = False) -> str:
    kind = "region" if box.order else "composite" if box.composite else "state"
    classes = f"{kind} active" if box.path in shown.states else kind
    radius = 10 if not box.order else 6
    parts = [svg.tag("rect", x=box.x, y=box.y, width=box.width, height=box.height, rx=radius)]
    parts.append(svg.text(box.x + 12, box.y + 17, box.path[-1], "title"))
    if box.order:
        parts.append(svg.text(box.x + box.width - 16, box.y + 17, str(box.order), "order"))
    if box.lines:
        y = box.y + 22
        parts.append(svg.tag("line", x1=box.x, x2=box.x + box.width, y1=y, y2=y, class_="rule"))
        lines = svg.lines(box.x + 12, y + 3, box.lines, "action")
        parts += [_folded(box, lines)] if folded else lines
    return svg.tag("g", "".join(parts), class_=classes, data_state=".".join(box.path))


def _folded(box: Box, lines: Sequence[str]) -> str:
    """The beginning of a long list of actions, which is a button for the whole."""
    button = {"role": "button", "tabindex": 0, "aria_expanded": "false", "aria_label": "all actions"}
    return svg.tag("g", "".join(lines), class_="folded", data_actions=".".join(box.path), **button)


def _piece(piece: PicturePiece, shown: Emphasis) -> str:
    parts = [svg.tag("path", d=svg.path(piece.points), class_="line")]
    if piece.ends:
        parts.append(svg.tag("path", d=svg.arrow_head(piece.points), class_="head"))
    if piece.starts:
        parts += svg.lines(*piece.label, piece.lines, "label")
        parts.append(_number(piece))
    classes = "arrow fired" if piece.arrow.name in shown.arrows else "arrow"
    return svg.tag("g", "".join(parts), class_=classes, data_arrow=piece.arrow.name)


def _number(piece: PicturePiece) -> str:
    """The priority beside the start of the line; beyond the slanting start at a junction."""
    (x, y), (x1, y1), *rest = piece.points
    if x1 != x and y1 != y and rest:
        (x, y), (x1, y1) = (x1, y1), rest[0]
    across = (3 if x1 > x else -9, -3)
    along = (4, 8 if y1 > y else -1)
    dx, dy = along if x == x1 else across
    return svg.text(x + dx, y + dy, piece.arrow.number, "number")


def _spot(spot: Spot) -> str:
    circle = svg.tag("circle", cx=spot.x, cy=spot.y, r=spot.radius, class_="dot" if spot.dot else "junction")
    if not spot.path or not spot.path[-1].startswith(HISTORY):
        return circle
    return circle + svg.text(spot.x - 4, spot.y + 4, "H", "number")
