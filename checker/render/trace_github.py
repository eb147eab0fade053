"""A trace as GitHub workflow commands: an annotation at the property's line, the explained run in the log."""

from rovercheck.checker.render.ci import of_trace
from rovercheck.checker.render.ci.github import annotation, annotations
from rovercheck.checker.results.format import Format
from rovercheck.checker.results.trace import Trace

FORMAT = Format("github", "trace", ".txt", "GitHub workflow commands: an annotation, and the run in the log")


def render(trace: Trace) -> str:
    """The lines for the log of a step; of a witness, which is nothing to be warned of, a notice."""
    report = of_trace(trace)
    return annotations(report) or annotation("notice", report.findings[0]) + "\n"
