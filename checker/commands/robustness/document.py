"""``rovercheck robustness --json``: what did not hold (``checker/schemas/robustness-1.json``)."""

from collections.abc import Mapping
from pathlib import Path
from typing import Literal

from typing_extensions import TypedDict

from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.io.document import Count, Ordinal, Text
from rovercheck.checker.robustness.odd_inputs import told
from rovercheck.checker.robustness.search import RobustnessFinding, RobustnessResult
from rovercheck.spec_model.abstraction import Board, Value


class InputChange(TypedDict):
    """The inputs that change before a step."""

    step: Ordinal
    inputs: dict[str, str]
    """By name, as they are told: ``nan`` and ``inf`` are no numbers of JSON."""


class RobustnessRow(TypedDict):
    """One thing that must hold and does not, and the shortest run found that shows it in its last step."""

    kind: Text
    where: str
    """The output, function or line that it is about."""
    says: Text
    step: Ordinal
    runs: Count
    """In how many runs it was met."""
    origin: Text
    """The run in which it was met first."""
    inputs: list[InputChange]
    """Steps that change nothing are left out; before the first change every input is at rest."""
    test: str | None
    """The file that the test was written to, if any was."""


class RobustnessDocument(TypedDict):
    """What ``rovercheck robustness --json`` prints."""

    schema: Literal["rovercheck/robustness/1"]
    board: Text
    implementation: Text
    sanitizers: str
    """Whether sanitizers watched, and why not."""
    runs: Count
    steps: Count
    interrupted: bool
    judged: list[str]
    """Outputs that were given and could be judged."""
    exit: int
    findings: list[RobustnessRow]


def document(
    result: RobustnessResult, implementation: str, sanitizers: str, files: Mapping[int, Path], code: Exit
) -> RobustnessDocument:
    """All of it for machines."""
    rows = [_row(one, result, files.get(number)) for number, one in enumerate(result.findings, 1)]
    return {
        "schema": "rovercheck/robustness/1",
        "board": result.board.name,
        "implementation": implementation,
        "sanitizers": sanitizers,
        "runs": result.runs,
        "steps": result.steps,
        "interrupted": result.interrupted,
        "judged": sorted(result.compared),
        "exit": int(code),
        "findings": rows,
    }


def _row(one: RobustnessFinding, result: RobustnessResult, file: Path | None) -> RobustnessRow:
    changes = told(result.board, one.inputs)
    return {
        "kind": one.breach.kind,
        "where": one.breach.where,
        "says": one.breach.says,
        "step": one.breach.step,
        "runs": result.met[one.breach.kind, one.breach.where],
        "origin": one.origin,
        "inputs": [
            {"step": step, "inputs": {name: shown(result.board, name, value) for name, value in now.items()}}
            for step, now in changes
        ],
        "test": None if file is None else str(file),
    }


def shown(board: Board, name: str, value: Value) -> str:
    """A value of an input, with its unit or as the member that it is."""
    return next(s for s in board.inputs if s.name == name).show(value)


__all__ = ["document", "shown"]
