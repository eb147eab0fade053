"""What a log of a board may hold, and what the charts see of it: samples, ages, updates, slow means."""

from dataclasses import dataclass
from functools import cached_property

from rovercheck.spec_model.abstraction import Board, BoardSignal
from rovercheck.spec_model.abstraction.interface import SignalView


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
        return {s.var.name: s for s in self.board.interface.views}
