"""A chart as a page: the picture as drawn, with what its signs mean, for a browser or an attachment."""

from markupsafe import Markup

from rovercheck.checker.render import statechart_svg
from rovercheck.checker.render.page import Part, page
from rovercheck.checker.results.format import Format
from rovercheck.spec_model.lang.chart import Chart

FORMAT = Format("html", "statechart", ".html", "the picture as a page of its own; no outside resources")
STYLE = ".drawn{overflow-x:auto}.drawn svg{max-width:none}"


def render(chart: Chart) -> str:
    """The page."""
    body = Markup('<main class="drawn">{}</main>').format(Markup(statechart_svg.render(chart)))
    return page(chart.name, [Part(body, (STYLE,))])
