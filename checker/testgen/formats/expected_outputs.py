"""Tests with the outputs that the charts require, as the interpreter computes them."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

from rovercheck.checker.testgen.scripts import Moment, Script, steps
from rovercheck.spec_model.abstraction import Board, Value
from rovercheck.spec_model.lang.interpret import Interpreter


@dataclass(frozen=True)
class ExpectedTest:
    """A test: its name, the goals it reaches in words, its script, and the outputs after each step.

    Outputs that the charts leave open in a step are missing there.
    """

    name: str
    goals: tuple[str, ...]
    script: Script
    inputs: tuple[Mapping[str, Value], ...]
    outputs: tuple[Mapping[str, Value], ...]


def expected(board: Board, name: str, goals: Iterable[str], script: Script) -> ExpectedTest:
    """The test with what the interpreter requires of a board with these inputs."""
    inputs = steps(board, script)
    return ExpectedTest(name, tuple(goals), script, inputs, tuple(required(board, inputs)))


def required(board: Board, inputs: Sequence[Mapping[str, Value]]) -> Iterator[dict[str, Value]]:
    """The outputs that the charts require after each step from power-up."""
    reader, charts = board.reader(), Interpreter(board.system, measured=True)
    for given in inputs:
        charts.step(reader.step(given))
        yield board.expected(charts.data)


@dataclass(frozen=True)
class ExpectedRow:
    """Equal steps in a row: how many, and what differs from the row before (an open output is None)."""

    held: int
    inputs: Mapping[str, Value]
    outputs: Mapping[str, Value | None]


def rows(board: Board, test: ExpectedTest) -> list[ExpectedRow]:
    """A test as rows; before the first, inputs are at rest and outputs are open."""
    found: list[ExpectedRow] = []
    moment: Moment = {s.name: False if s.stamp else s.initial for s in board.inputs}
    before: Mapping[str, Value | None] = {o.name: None for o in board.outputs}
    for given, required_ in zip(test.script, test.outputs, strict=True):
        after = {name: required_.get(name) for name in before}
        inputs = {name: value for name, value in given.items() if value != moment[name]}
        outputs = {name: value for name, value in after.items() if value != before[name]}
        if found and not inputs and not outputs:
            found[-1] = ExpectedRow(found[-1].held + 1, found[-1].inputs, found[-1].outputs)
        else:
            found.append(ExpectedRow(1, inputs, outputs))
        moment, before = given, after
    return found
