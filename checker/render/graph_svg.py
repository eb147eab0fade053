"""A projected state graph as an SVG picture, with what it shows in words above it."""

from rovercheck.checker.render.drawing import svg
from rovercheck.checker.render.drawing.text import LINE, wrap
from rovercheck.checker.render.stategraph.findings import findings
from rovercheck.checker.render.stategraph.picture import drawn
from rovercheck.checker.render.stategraph.words import LEGEND
from rovercheck.checker.results.format import Format, Option
from rovercheck.checker.results.graph import MOST_NODES, StateGraph, drawable

FORMAT = Format(
    "svg",
    "graph",
    ".svg",
    "picture of a small projected graph; refuses what cannot be read",
    takes=frozenset({Option.MOST}),
)

MARGIN = 24
NARROWEST = 860
INDENT = 78

STYLE = """
.box{fill:#fffdf6;stroke:#5b5b66;stroke-width:1.3}
.inner{fill:none;stroke:#5b5b66;stroke-width:1}
.initial .box{stroke-width:2.8}
.loop .box{fill:#eef4ec}
.end .box{fill:#e4e4e8}
.open .box{stroke-dasharray:5 3}
.on-path .box{stroke:#b86a00;stroke-width:2.6}
.bad .box{fill:#ffd9d4;stroke:#c3241c;stroke-width:2.6}
.title{font-size:17px;font-weight:bold;fill:#1d2433}
.value{fill:#1d2433}
.heading{font-weight:bold;fill:#3c4456}
.count,.note{fill:#5b6472}
.line{fill:none;stroke:#35507a;stroke-width:1.2}
.some .line{stroke-dasharray:5 3}
.head{fill:#35507a}
.label{fill:#1f3558}
.far{opacity:.4}
.far.fired{opacity:1}
.fired .line{stroke:#c3241c;stroke-width:2.4}
.fired .head{fill:#c3241c}
.fired .label{fill:#8f1913}
.cut{fill:#c3241c;font-weight:bold}
"""
COLOURS = (
    "Thick border: initial; green: in a cycle of several nodes; grey: never left; double border: a state "
    "that admits no input; orange: on the run shown; red: marked; ↻: stays, (↻): some of the states do"
)


def render(graph: StateGraph, most: int = MOST_NODES) -> str:
    """The picture.  Raises ``ModelError`` when it has more than ``most`` nodes."""
    drawable(graph, most)
    picture = drawn(graph)
    wide = max(picture.width, NARROWEST) + 2 * MARGIN
    room = min(wide, 1200) // 7
    words, top = _words(graph, room)
    legend = [LEGEND, COLOURS]
    if not picture.labelled:
        legend.append(f"Inputs are left out: {len(graph.edges)} edges; see the HTML and JSON exports")
    foot = [line for text in legend for line in wrap(f"{text}.", room)]
    body = [svg.text(MARGIN, MARGIN + 14, graph.title, "title"), *words]
    body += [f'<g transform="translate({MARGIN},{top})">', *picture.body, "</g>"]
    body += svg.lines(MARGIN, top + picture.height + 18, foot, "note")
    high = top + picture.height + 18 + LINE * len(foot) + MARGIN
    return svg.document(wide, high, STYLE, f"{graph.title}: state graph", body)


def _words(graph: StateGraph, room: int) -> tuple[list[str], int]:
    """The findings as lines of text, and where they end."""
    y, last = MARGIN + 26, ""
    body: list[str] = []
    for heading, sentence in findings(graph):
        lines = wrap(sentence, room - INDENT // 7)
        cut = "cut" if heading == "CUT" else "note"
        if heading != last:
            body += svg.lines(MARGIN, y, [heading], "cut" if cut == "cut" else "heading")
        body += svg.lines(MARGIN + INDENT, y, lines, cut)
        y, last = y + LINE * len(lines), heading
    return body, y + 18
