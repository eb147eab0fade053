"""A trace as a picture over time: lanes of values, limits and timers, readable on paper too."""

from rovercheck.checker.render.timeline import picture, timeline
from rovercheck.checker.results.format import Format, Option
from rovercheck.checker.results.trace import Trace

FORMAT = Format(
    "svg",
    "trace",
    ".svg",
    "a picture over time: states as bands, numbers as lines with their limits, timers as ramps",
    takes=frozenset({Option.EVERYTHING}),
)


def render(trace: Trace, everything: bool = False) -> str:
    """The SVG document; ``everything``: also what the property does not depend on."""
    return picture(timeline(trace, everything=everything))
