"""A trace as JUnit XML: one test case, which fails with the explained run; a witness passes."""

from rovercheck.checker.render.ci import of_trace
from rovercheck.checker.render.ci.junit import junit
from rovercheck.checker.results.format import Format
from rovercheck.checker.results.trace import Trace

FORMAT = Format("junit", "trace", ".junit.xml", "JUnit XML: a test case that fails with the explained run")


def render(trace: Trace) -> str:
    """The XML text."""
    return junit(of_trace(trace))
