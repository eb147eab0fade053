"""A trace as SARIF 2.1.0: a code flow through the lines of the charts, for code scanning and editors."""

from rovercheck.checker.render.ci import of_trace
from rovercheck.checker.render.ci.sarif import sarif
from rovercheck.checker.results.format import Format
from rovercheck.checker.results.trace import Trace

FORMAT = Format("sarif", "trace", ".sarif", "SARIF 2.1.0: a code flow through the lines of the charts")


def render(trace: Trace) -> str:
    """The JSON text."""
    return sarif(of_trace(trace), witnesses=True)
