"""A trace as an HTML page that plays it on the charts."""

from markupsafe import Markup

from rovercheck.checker.render.page import Part, page
from rovercheck.checker.render.player import part
from rovercheck.checker.render.trace_html import why
from rovercheck.checker.results.format import Format, Option
from rovercheck.checker.results.trace import Trace

FORMAT = Format(
    "play",
    "trace",
    ".html",
    "page that plays the run on its charts, transition by transition; fetches nothing",
    takes=frozenset({Option.EVERYTHING}),
)


def render(trace: Trace, *, everything: bool = False) -> str:
    """The page; ``everything`` shows also charts and values that the property does not depend on."""
    title = trace.property.id or trace.system.name
    heading = Markup("<h1>{}</h1>{}").format(title, _sentence(trace))
    return page(f"{title}: played on its charts", [Part(heading), part(trace, everything=everything)])


def _sentence(trace: Trace) -> Markup:
    text = Markup("<p>{}</p>").format(trace.property.text) if trace.property.text else Markup()
    return text + why(trace)
