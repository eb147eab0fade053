"""A trace as a message sequence: what boards, charts and the environment hand to each other, and when."""

from rovercheck.checker.render.sequence import message_sequence, picture
from rovercheck.checker.results.format import Format, Option
from rovercheck.checker.results.trace import Trace

FORMAT = Format(
    "sequence",
    "trace",
    ".svg",
    "a picture of the messages between boards or charts, time flowing down",
    takes=frozenset({Option.EVERYTHING}),
)


def render(trace: Trace, everything: bool = False) -> str:
    """The SVG document; ``everything``: also what the property does not depend on.

    Raises ``ModelError`` for a run without any message.
    """
    return picture(trace, message_sequence(trace, everything=everything))
