"""Tests in files: held blocks of inputs, as JSON that people can read and compare."""

import json
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field

from rovercheck.checker.board_tests.rows import Moment
from rovercheck.checker.testgen.scripts import Script, Test, blocks, stamps_of, steps, unfolded
from rovercheck.spec_model.abstraction import Board, Value
from rovercheck.spec_model.lang.errors import ModelError

FORMAT = 2
FLAGS = 1
"""The format before, in which a stamp is true where its datum is new, and lags are not known."""


@dataclass(frozen=True)
class KeptTests:
    """What is kept of a generation: the tests, and what is known of the goals that none of them reaches.

    ``shortest`` are goals reached by a test after as few steps as any run needs; ``charts`` is the
    fingerprint of the charts of which that and the proofs were found.
    """

    tests: tuple[tuple[str, tuple[str, ...], Script], ...]
    shortest: tuple[str, ...] = ()
    uncoverable: Mapping[str, str] = field(default_factory=dict)
    unknown: Mapping[str, str] = field(default_factory=dict)
    charts: str = ""


def written(board: Board, kept: KeptTests) -> str:
    """The text of a file: each test with its goals and rows of ``steps held, inputs that change``."""
    shown = []
    for name, goals, moments in kept.tests:
        rows = ",\n   ".join(json.dumps(row) for row in blocks(board, moments))
        head = f'{{"name": {json.dumps(name)},\n  "goals": {json.dumps(goals)}'
        shown.append(f'  {head},\n  "held": [{rows}]}}')
    rest = {"shortest": kept.shortest, "uncoverable": dict(kept.uncoverable), "unknown": dict(kept.unknown)}
    more = "".join(f',\n"{key}": {json.dumps(value, indent=1)}' for key, value in rest.items())
    tests = ",\n".join(shown)
    head = f'"format": {FORMAT}, "board": {json.dumps(board.name)}, "charts": {json.dumps(kept.charts)}'
    return f'{{{head}, "tests": [\n{tests}\n]{more}}}\n'


def kept_of(board: Board, text: str) -> KeptTests:
    """What a file holds that ``written`` wrote.  Raises ``ModelError`` for any other."""
    try:
        document = json.loads(text)
        format = document["format"]
        if format not in (FORMAT, FLAGS) or document["board"] != board.name:
            raise ModelError(f"These are no tests of {board.name} in format {FORMAT}; generate them again.")
        stamps = stamps_of(board) if format == FLAGS else frozenset()
        tests = [(t["name"], tuple(t["goals"]), _script(board, t["held"], stamps)) for t in document["tests"]]
        shortest = tuple(document["shortest"])
        proved, unknown = document["uncoverable"], document["unknown"]
        return KeptTests(tuple(tests), shortest, proved, unknown, document.get("charts", ""))
    except (ValueError, KeyError, TypeError) as error:
        raise ModelError(
            f"These are no tests that rovercheck keeps: {error}. Generate them again."
        ) from error


def _script(board: Board, rows: Sequence[tuple[int, Moment]], flags: Collection[str]) -> Script:
    def lag(name: str, value: Value | None) -> Value | None:
        return (0 if value else None) if name in flags else value

    return unfolded(board, [(n, {s: lag(s, v) for s, v in dict(changes).items()}) for n, changes in rows])


def read(board: Board, text: str) -> list[Test]:
    """The tests in a file, with concrete inputs.  Raises ``ModelError`` for any other file."""
    found: Sequence[tuple[str, tuple[str, ...], Script]] = kept_of(board, text).tests
    return [Test(name, goals, steps(board, script)) for name, goals, script in found]
