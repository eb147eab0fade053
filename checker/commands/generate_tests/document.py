"""``rovercheck generate-tests --json``: every goal and test (``checker/schemas/testgen-1.json``)."""

from collections.abc import Mapping, Sequence
from typing import Literal

from typing_extensions import TypedDict

from rovercheck.checker.commands.generate_tests.run import Generated
from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.io.document import Ordinal, Text
from rovercheck.checker.system.instrument.goals import GoalKind
from rovercheck.checker.testgen.keep import KeptTests

GoalWord = Literal["covered", "uncoverable", "unknown"]


class GoalRow(TypedDict):
    """A goal, and the test that reaches it or why none does."""

    id: Text
    kind: GoalKind
    text: str
    """The goal in words."""
    verdict: GoalWord
    """Uncoverable is proved; unknown is neither."""
    test: str | None
    """The test that reaches it."""
    shortest: bool
    """No shorter run of the model reaches it."""
    because: str | None
    """The proof that no run reaches it, or why it is not known."""


class GeneratedTestRow(TypedDict):
    """A test of a board."""

    name: Text
    steps: Ordinal
    """Steps of 20 ms."""
    goals: list[str]
    """Ids of the goals that it reaches."""


class BoardRow(TypedDict):
    """What came of one board."""

    board: Text
    goals: list[GoalRow]
    tests: list[GeneratedTestRow]
    files: list[str]
    """Names of the files written."""


class GenerateTestsDocument(TypedDict):
    """What ``rovercheck generate-tests --json`` prints."""

    schema: Literal["rovercheck/testgen/1"]
    complete: bool
    """False after an interruption: this is what was found so far."""
    exit: Exit
    boards: list[BoardRow]


def document(found: Sequence[Generated], code: Exit) -> GenerateTestsDocument:
    """All of it for machines."""
    return {
        "schema": "rovercheck/testgen/1",
        "complete": not any(one.interrupted for one in found),
        "exit": code,
        "boards": [_board(one) for one in found],
    }


def _board(one: Generated) -> BoardRow:
    kept = one.kept
    test_of = {goal: name for name, reached, _ in kept.tests for goal in reached}
    goals: list[GoalRow] = [
        {
            "id": g.id,
            "kind": g.kind,
            "text": g.text,
            "verdict": _verdict(g.id, test_of, kept),
            "test": test_of.get(g.id),
            "shortest": g.id in kept.shortest,
            "because": kept.uncoverable.get(g.id) or kept.unknown.get(g.id),
        }
        for g in one.aim.goals
    ]
    tests: list[GeneratedTestRow] = [
        {"name": name, "steps": len(script), "goals": [*reached]} for name, reached, script in kept.tests
    ]
    return {"board": one.aim.board.name, "goals": goals, "tests": tests, "files": [*one.files]}


def _verdict(id: str, test_of: Mapping[str, str], kept: KeptTests) -> GoalWord:
    if id in test_of:
        return "covered"
    return "uncoverable" if id in kept.uncoverable else "unknown"


__all__ = ["document"]
