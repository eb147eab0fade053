"""What a log of a board may hold, and what the charts see of it: samples, ages, updates, slow means."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

from rovercheck.spec_model.abstraction import Board, BoardSignal, board1, board2, gaps
from rovercheck.spec_model.lang.expr import Var

TIME = "now_ms"
"""The time stamp of the step itself."""


@dataclass(frozen=True)
class SignalView:
    """How the charts see a signal: the input made of it, as a sample, age, update, advance or slow mean."""

    var: Var
    how: str
    signal: BoardSignal


@dataclass(frozen=True)
class Vocabulary:
    """The names of a board: of its signals in a log, of the variables in its charts and properties."""

    board: Board

    @cached_property
    def signals(self) -> dict[str, BoardSignal]:
        """Every signal by name, inputs first."""
        return {s.name: s for s in (*self.board.inputs, *(o.signal for o in self.board.outputs))}

    @cached_property
    def inputs(self) -> frozenset[str]:
        return frozenset(s.name for s in self.board.inputs)

    @cached_property
    def sights(self) -> dict[str, SignalView]:
        """What the charts see of the inputs, by the name of the chart's variable."""
        return {s.var.name: s for s in _SEEN[self.board.name]}


def _board1() -> tuple[SignalView, ...]:
    stamps = {s.name: s for s in board1.STAMPS}
    return (
        *(SignalView(var, "sample", signal) for signal, var in board1.SAMPLES.items()),
        *(SignalView(var, "age", stamps[name]) for name, var in board1.AGES.items()),
        *(SignalView(var, "slow", stamps[name]) for name, var in board1.SLOW.items()),
    )


def _board2() -> tuple[SignalView, ...]:
    stamps = {s.name: s for s in board2.STAMPS}
    return (
        *(SignalView(var, "sample", signal) for signal, var in board2.SAMPLES.items()),
        *(SignalView(source.age, "age", stamps[name]) for name, source in board2.SOURCES.items()),
        *(
            SignalView(gaps.advance(source), "advance", stamps[name])
            for name, source in board2.SOURCES.items()
        ),
        *(
            SignalView(source.update, "update", stamps[name])
            for name, source in board2.SOURCES.items()
            if source in board2.COUNTED
        ),
    )


_SEEN: Mapping[str, tuple[SignalView, ...]] = {"board1": _board1(), "board2": _board2()}
