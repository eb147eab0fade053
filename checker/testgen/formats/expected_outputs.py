"""Tests with the outputs that the charts require, as the interpreter computes them."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

from rovercheck.checker.results.board_steps import Cells, in_rows
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


def rows(board: Board, test: ExpectedTest) -> list[tuple[int, Moment, Cells]]:
    """A test as rows; before the first, inputs are at rest and outputs are open."""
    inputs: Moment = {s.name: False if s.stamp else s.initial for s in board.inputs}
    open_: Cells = {o.name: None for o in board.outputs}
    outputs = ({name: required_.get(name) for name in open_} for required_ in test.outputs)
    return in_rows(inputs, open_, zip(test.script, outputs, strict=True))
