"""Tests of a board with the outputs that the charts require, as the interpreter computes them."""

from collections.abc import Iterator, Mapping, Sequence

from rovercheck.checker.results.board_test import (
    BoardStep,
    BoardTest,
    BoardUnderTest,
    SignalKind,
    StepSignal,
)
from rovercheck.spec_model.abstraction import Board, BoardSignal, Value
from rovercheck.spec_model.abstraction.stamps import NOW
from rovercheck.spec_model.lang.domain import Bool, Num
from rovercheck.spec_model.lang.interpret import Interpreter


def expected(
    board: Board, name: str, inputs: Sequence[Mapping[str, Value]], goals: Sequence[str] = ()
) -> BoardTest:
    """The test with these concrete inputs, step by step, and what the interpreter requires after each."""
    steps = map(BoardStep, inputs, required(board, inputs))
    return BoardTest(under_test(board), name, tuple(steps), tuple(goals))


def required(board: Board, inputs: Sequence[Mapping[str, Value]]) -> Iterator[dict[str, Value]]:
    """The outputs that the charts require after each step from power-up; what they leave open is missing."""
    reader, charts = board.reader(), Interpreter(board.system, measured=True)
    for given in inputs:
        charts.step(reader.step(given))
        yield board.expected(charts.valuation())


def under_test(board: Board) -> BoardUnderTest:
    """A board as its firmware has it."""
    outputs = tuple(_signal(o.signal) for o in board.outputs)
    inputs = tuple(map(_signal, board.inputs))
    return BoardUnderTest(board.name, inputs, outputs, board.supervisor, board.tick_ms, board.model)


def _signal(signal: BoardSignal) -> StepSignal:
    return StepSignal(signal.name, _kind(signal), signal.initial, signal.doc or str(signal.domain.sort))


def _kind(signal: BoardSignal) -> SignalKind:
    if signal.stamp:
        return SignalKind.CLOCK if signal.name == NOW else SignalKind.STAMP
    match signal.domain.sort:
        case Bool():
            return SignalKind.BOOL
        case Num(resolution, _) if not (signal.whole and resolution == 1):
            return SignalKind.NUMBER
    return SignalKind.WHOLE
