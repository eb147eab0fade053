"""``rovercheck lint --json``: what can never happen (``checker/schemas/lint-1.json``)."""

from collections.abc import Sequence
from typing import Any, Literal

from typing_extensions import TypedDict

from rovercheck.checker.io.document import Text
from rovercheck.checker.results.exit_code import Exit


class LintRow(TypedDict):
    """A state or a transition of a chart, and whether some run gets there."""

    system: Text
    chart: Text
    kind: Literal["state", "transition"]
    what: Text
    """The path of the state; or where the transition starts and ends, with its label."""
    found: Literal["happens", "never", "unknown"]
    evidence: Text
    """What that rests on."""


class LintSummary(TypedDict):
    """How much of a system was asked about."""

    system: Text
    states: int
    transitions: int


class LintDocument(TypedDict):
    """What ``rovercheck lint --json`` prints."""

    schema: Literal["rovercheck/lint/1"]
    exit: Exit
    findings: Sequence[LintRow]
    """What never happens, and what was not decided."""
    systems: Sequence[LintSummary]


def document(rows: Sequence[LintRow], systems: Sequence[LintSummary], code: Exit) -> dict[str, Any]:
    """The findings as JSON; its fields are those of :class:`LintDocument`."""
    return {"schema": "rovercheck/lint/1", "exit": code, "findings": list(rows), "systems": list(systems)}


__all__ = ["LintDocument", "LintRow", "LintSummary", "document"]
