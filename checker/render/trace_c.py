"""A trace as a C99 program that gives the same run to a supervisor through four functions of its user.

The functions and structures are those of ``rovercheck generate-tests --format c``.  It needs the run as the
boards see it (``Trace.concrete``); of a run of several boards, each is compiled by itself.
"""

from rovercheck.checker.board_tests.c_program import c_program
from rovercheck.checker.render.trace_pytest import about, required
from rovercheck.checker.results.format import Format, Need
from rovercheck.checker.results.trace import Trace

FORMAT = Format(
    "c",
    "trace",
    ".c",
    "C99 program: the run given to your board functions, outputs compared",
    needs=frozenset({Need.BOARD_STEPS}),
)
"""Shows the run as the boards see it."""


def render(trace: Trace) -> str:
    """The text of the program.  Raises ``ModelError`` for a run that is not known as a board sees it."""
    return c_program(about(trace), required(trace))
