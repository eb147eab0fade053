"""A trace as one HTML page: the sentence, the timeline with a cursor, the charts played, the story."""

from markupsafe import Markup

from rovercheck.checker.render import player, timeline
from rovercheck.checker.render.page import Part, page, together
from rovercheck.checker.render.story import heading
from rovercheck.checker.results.format import Format, Option
from rovercheck.checker.results.trace import Trace

FORMAT = Format(
    "html",
    "trace",
    ".html",
    "page with a timeline to explore, the run played on its charts, and the story; fetches nothing",
    takes=frozenset({Option.EVERYTHING}),
)

LANDSCAPE = "@page{size:landscape;margin:12mm}"


def render(trace: Trace, everything: bool = False) -> str:
    """The page; ``everything``: also what the property does not depend on."""
    title = trace.property.id or trace.system.name
    parts = [timeline.part(trace, everything=everything)]
    parts += [_heading("What happened"), timeline.story_part(trace, everything=everything)]
    if trace.system.statecharts:
        parts += [_heading("Played on the charts"), player.part(trace, everything=everything, printed=False)]
    return page(f"{title}: {_verdict(trace)}", [_head(trace, title), together(parts)])


def _head(trace: Trace, title: str) -> Part:
    body = Markup("<h1>{}</h1><p>{}</p><p><b>{}</b> in {}</p>").format(
        title, trace.property.text, _verdict(trace).capitalize(), heading(trace)
    )
    return Part(body + why(trace), (LANDSCAPE,))


def why(trace: Trace) -> Markup:
    """The reason on record as a paragraph; nothing where there is none."""
    because = trace.property.because
    return Markup('<p class="why"><b>Why:</b> {}</p>').format(because) if because else Markup()


def _verdict(trace: Trace) -> str:
    """What the run is: of a property one of two, or a run of nothing in particular."""
    if trace.breaks():
        return "counterexample"
    return "witness" if trace.property.violated is False else "run"


def _heading(text: str) -> Part:
    return Part(Markup("<h2>{}</h2>").format(text))
