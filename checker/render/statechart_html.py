"""A chart as a page: the picture as drawn, with what its signs mean, for a browser or an attachment."""

from markupsafe import Markup

from rovercheck.checker.render.page import Part, own, page
from rovercheck.checker.render.statechart_svg import LEGEND, PAGE_STYLE, inline
from rovercheck.checker.results.format import Format
from rovercheck.spec_model.lang.chart import Chart

FORMAT = Format("html", "statechart", ".html", "the picture as a page of its own; no outside resources")
FRAME = """\
body{max-width:1900px}
.drawn{overflow:auto;background:#fff;touch-action:pan-x pan-y}.drawn svg{display:block;height:auto}
"""
SIGNS = Markup("<p>{}</p>").format(
    "; ".join((*LEGEND, "▸ all lines: a click shows the whole list of actions"))
)
FITTED = '"use strict";\ndocument.querySelectorAll(".drawn").forEach(fittedPicture);\n'
SCRIPTS = ("zoom.js", "picture.js", "unfold.js")


def render(chart: Chart) -> str:
    """The page."""
    body = Markup('<main class="drawn" tabindex="0">{}</main>{}').format(Markup(inline(chart)), SIGNS)
    return page(chart.name, [Part(body, (PAGE_STYLE, FRAME), (*map(own, SCRIPTS), FITTED))])
