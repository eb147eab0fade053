"""A trace as a pytest file that gives the same run to a supervisor and compares what it produces.

It needs the run as the boards see it (``Trace.concrete``).
"""

from rovercheck.checker.board_tests.pytest_file import pytest_file
from rovercheck.checker.render.reasons import determined_by
from rovercheck.checker.render.waves import outcome
from rovercheck.checker.results.board_test import BoardTest
from rovercheck.checker.results.format import Format, Need
from rovercheck.checker.results.trace import Trace
from rovercheck.spec_model.lang.errors import ModelError

FORMAT = Format(
    "pytest",
    "trace",
    ".py",
    "pytest file: the run given to a supervisor, its outputs compared",
    needs=frozenset({Need.BOARD_STEPS}),
)
"""Shows the run as the boards see it."""

NOTE = (
    "Written by `rovercheck trace`.  The outputs required are those of the charts as they were then, so the "
    "test passes for a supervisor that does as the charts do"
)
BROKEN = ", although they break the property: once they are repaired, write it anew."


def render(trace: Trace) -> str:
    """The text of the file.  Raises ``ModelError`` for a run that is not known as a board sees it."""
    return pytest_file(about(trace), required(trace))


def about(trace: Trace) -> list[str]:
    """What a test of this run says first: which property, and what becomes of it; its text; what passes."""
    broken = outcome(trace) == "violated"
    title = trace.property.id or trace.system.name
    return [
        f"{title}: a run that {'breaks' if broken else 'shows'} it, given to a supervisor.",
        trace.property.text or "A run of the model.",
        *([f"Why: {trace.property.because}"] if trace.property.because else []),
        *([said] if (said := determined_by(trace)) else []),
        NOTE + (BROKEN if broken else "."),
    ]


def required(trace: Trace) -> tuple[BoardTest, ...]:
    """The run as the boards see it.  Raises ``ModelError`` where it was not worked out."""
    if not trace.concrete:
        raise ModelError(
            f"This run of {trace.system.name} is not known as the inputs of a supervisor; use the format "
            "csv or json, or a property of a board."
        )
    return trace.concrete
