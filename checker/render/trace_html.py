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
BESIDE = """\
body{max-width:1900px}h1{margin:.2em 0}p{margin:.3em 0}
@media screen and (min-width:1100px){
.beside{display:grid;grid-template-columns:minmax(0,1.25fr) minmax(0,1fr);
gap:16px;align-items:start}.beside .tl-frame{max-height:62vh}
.beside .player{margin:.3em 0;padding:6px 8px;position:sticky;top:4px}
.beside .player-charts{max-height:50vh;overflow:auto}
.beside .tl{--tl-names:230px}.beside .player-body{grid-template-columns:minmax(0,1fr)}
.beside .player-charts{order:0}.beside .player-said{height:8em;min-height:0;position:static}
.beside .player-chart{max-height:48vh}}
"""


def render(trace: Trace, everything: bool = False) -> str:
    """The page; ``everything``: also what the property does not depend on."""
    title = trace.property.id or trace.system.name
    first = timeline.part(trace, everything=everything)
    if trace.system.statecharts:
        first = _beside(first, player.part(trace, everything=everything, printed=False))
    parts = [first]
    parts += [_heading("What happened"), timeline.story_part(trace, everything=everything)]
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


def _beside(lanes: Part, charts: Part) -> Part:
    """Both on one screen where it is wide enough, else one below the other."""
    body = Markup('<div class="beside"><div>{}</div><div>{}</div></div>').format(lanes.body, charts.body)
    return Part(body, (*lanes.styles, *charts.styles, BESIDE), (*lanes.scripts, *charts.scripts))


def _heading(text: str) -> Part:
    return Part(Markup("<h2>{}</h2>").format(text))
