"""What surrounds a board in a stimulus: sources with their fields, values at rest, phases to draw from."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property

from hypothesis import strategies as st

from rovercheck.checker.compare.stimulus import Change, Every, InputBlock
from rovercheck.checker.compare.values import Values
from rovercheck.spec_model.abstraction import Board, Value

Blocks = list[InputBlock]
Phase = Callable[["Environment"], st.SearchStrategy[Blocks]]
"""A few blocks that belong together, such as a half turn or the loss of a source."""

SHORT = (1, 1, 2, 2, 3, 4, 6, 8, 12)
"""Steps that a block lasts when it waits for nothing."""
AROUND = (-1, 0, 1, 2)
"""Steps beside the length of a timer: a transition may fire a step later than its condition began to hold."""


@dataclass(frozen=True)
class Environment:
    """The surroundings of a board.

    ``themes`` are phases that lead somewhere together, each with blocks that begin it.
    """

    board: Board
    themes: Mapping[str, tuple[Blocks, tuple[Phase, ...]]]
    means: tuple[int, ...] = ()
    scenes: Callable[["Environment"], Iterator[tuple[str, Blocks, Blocks]]] = lambda env: iter(())
    """Sequences that are always tried: what they are, blocks that begin a run of them, and one of them."""
    also: tuple[Board, ...] = ()
    """Boards with other charts, of which the boundaries and timers are aimed at, too."""

    @property
    def fields(self) -> Mapping[str, tuple[str, ...]]:
        """What arrives with each stamp."""
        return self.board.interface.arrivals

    @cached_property
    def values(self) -> Values:
        return Values(self.board, self.also)

    @cached_property
    def at_rest(self) -> tuple[tuple[str, Change], ...]:
        """Everything at rest, and every source updated in every step."""
        stamps = self.values.stamps
        return tuple((name, Every() if name in stamps else value) for name, value in self.calm.items())

    @cached_property
    def calm(self) -> Mapping[str, Value]:
        """The same as the inputs of a step; of a stamp, how many ms before the step it was renewed: 0."""
        initial = {name: s.initial for name, s in self.values.signals.items()}
        return {**initial, **self.board.interface.resting, **dict.fromkeys(self.values.stamps, 0)}

    @cached_property
    def timers(self) -> tuple[int, ...]:
        """Lengths just short of, at and just beyond each timer and counter of the charts."""
        return tuple(sorted({n + d for n in self.values.aims.timers for d in AROUND})) or SHORT

    def silences(self, stamp: str) -> tuple[int, ...]:
        """Lengths around the ages that the charts compare the age of this stamp with."""
        limits = self.values.aims.silences.get(stamp, ())
        return tuple(sorted({n + d for n in limits for d in AROUND})) or (1, 2)

    @cached_property
    def rhythms(self) -> tuple[Every, ...]:
        """Gaps whose mean of ten lies at, below and above each limit, and plain ones."""
        limits = sorted({*self.values.aims.means, *self.means})
        cycles = [(1,), (1, 2), (2, 2, 2, 3)]
        for n in limits:
            cycles += [
                (n,),
                (n + 1,),
                (n - 1, n + 1),
                (*(n,) * 9, n + 1),
                (*(n,) * 10, n - 1),
                (*(1,) * 9, 9 * n),
            ]
        cycles = [c for c in cycles if min(c) > 0]
        lags = [(0,)] if self.board.grid_ms > 1 else [(0,), (7,), (19,), (0, 10), (1, 0, 0), (0, 0, 1)]
        return tuple(Every(cycle, lag) for cycle in cycles for lag in lags)

    @cached_property
    def lags(self) -> tuple[Every, ...]:
        """Updates in every step, stamped at various ms before it."""
        found = (Every(), Every((1,), (1,)), Every((1,), (19,)), Every((1,), (3, 17)))
        return found if self.board.grid_ms == 1 else found[:1]
