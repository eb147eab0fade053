"""``rovercheck lint --json``: what can never happen (``checker/schemas/lint-1.json``)."""

from collections.abc import Sequence
from typing import Any, Literal, TypeAlias

from typing_extensions import TypedDict

from rovercheck.checker.io.document import Text
from rovercheck.checker.results.exit_code import Exit

RowKind: TypeAlias = Literal[
    "state", "transition", "condition", "order", "way out", "range", "step", "overflow"
]
NUMBERS = ("range", "step", "overflow")
"""Kinds of rows about numbers, which are all told."""


class LintRow(TypedDict):
    """A state or a transition of a chart, its condition or its order, and whether some run shows it.

    A state is active, or left, in some run; a transition is taken; its condition does not hold where it is
    tested; it holds together with that of a later transition, so that the order decides.  Of numbers: a
    datum gets a value outside its domain, a step has no meaning, as it divides by 0, and an integer is more
    than its type holds.
    """

    system: Text
    chart: Text
    kind: RowKind
    what: Text
    """The path of the state; or where the transition starts and ends, with its label, both for an order."""
    found: Literal["happens", "never", "unknown"]
    evidence: Text
    """What that rests on."""
    run: Sequence[Text]
    """The inputs of a run that shows it, by tick, of an order and of numbers; else it is empty."""


class LintSummary(TypedDict):
    """How much of a system was asked about."""

    system: Text
    states: int
    transitions: int
    asked: bool
    """Whether states and transitions were asked about: unless some run has no meaning, or it was interrupted
    before that."""
    questions: int
    """How many there are, about states, transitions, conditions, orders and integers."""
    answered: int
    """How many have a run, a proof, or the reason why there is neither: all of them, unless interrupted."""


class LintDocument(TypedDict):
    """What ``rovercheck lint --json`` prints."""

    schema: Literal["rovercheck/lint/1"]
    exit: Exit
    findings: Sequence[LintRow]
    """What never happens, what only the order decides, what was not decided, and all that is of numbers."""
    systems: Sequence[LintSummary]
    interrupted: bool
    """Whether questions were left when it was ended."""


def document(
    rows: Sequence[LintRow], systems: Sequence[LintSummary], code: Exit, interrupted: bool
) -> dict[str, Any]:
    """The findings as JSON; its fields are those of :class:`LintDocument`."""
    return {
        "schema": "rovercheck/lint/1", "exit": code, "findings": list(rows), "systems": list(systems),
        "interrupted": interrupted,
    }  # fmt: skip


__all__ = ["NUMBERS", "LintDocument", "LintRow", "LintSummary", "RowKind", "document"]
