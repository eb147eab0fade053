"""The story of a trace as a part of a page: a table of what happened, and the inputs that force the end."""

from collections.abc import Sequence
from functools import partial
from itertools import groupby

from markupsafe import Markup

from rovercheck.checker.render.page import Part
from rovercheck.checker.render.periods import unfolded
from rovercheck.checker.render.reasons import cause, meaning, reasons
from rovercheck.checker.render.story import OMITTED, StoryEvent, standstill, start_of, start_values
from rovercheck.checker.render.timeline.fragment import TEMPLATES, own
from rovercheck.checker.results.trace import TakenTransition, Trace

MOST_ENTERED = 6
"""States entered by default in a tick that are told one by one; more are what a power-up brings."""


def entered(row: StoryEvent) -> Sequence[TakenTransition]:
    """The default transitions of a tick, where there are so many that they hide the others."""
    found = [one for one in row.transitions if not one.order]
    return found if len(found) > MOST_ENTERED else []


def story_part(trace: Trace, *, everything: bool = False) -> Part:
    """The table with the rows of that of the terminal, repetitions to be unfolded; and reasons, if known."""
    shown = trace if everything or not trace.property.relevant else trace.focused()
    by_ticks = groupby(reasons(trace, regular=True), key=lambda reason: f"{reason.when} ({reason.ms})")
    body = TEMPLATES.get_template("story.html").render(
        chosen=start_values(shown),
        rows=list(unfolded(shown)),
        start_of=start_of,
        standstill=partial(standstill, shown),
        entered=entered,
        omitted=OMITTED,
        cause=cause(trace),
        meaning=meaning(trace),
        reasons=[(ticks, [reason.what for reason in group]) for ticks, group in by_ticks],
    )
    return Part(Markup(body), (own("story.css"),), (own("story.js"),))
