"""Random inputs as a rover meets them: mostly well, data held for the lengths that timers ask for, bursts.

Most goals are reached by such runs in seconds.  A run found here is shortened, but nothing proves that no
shorter one exists.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from random import Random

from checker.testgen.scripts import CLOCK, Moment
from spec_model.abstraction import Board, BoardSignal, Value
from spec_model.abstraction.board import units
from spec_model.lang.chart import Chart
from spec_model.lang.domain import Num
from spec_model.lang.expr import Temporal
from spec_model.lang.walk import nodes

WELL: Mapping[str, Value] = {
    "temperature_degC": 25, "battery_pct": 80, "d1": 301, "d2": 301, "d3": 301, "isMotionConsistent": True,
    "crit_mask_b1": 4, "x_norm": 0, "y_norm": 0, "bx_norm": 0, "ay_norm": 0, "gz_dps": 0,
}  # fmt: skip
"""A rover at rest with nothing wrong; on Board 2, Board 1 asks for its references."""
SHORT = (1, 1, 1, 2, 2, 3, 5, 7)
LONG = 0.3
"""Share of blocks that are held for the length of a timer."""
FOCUS = 0.5
"""Share of moods in which only what one chart reads changes."""
OFTEN = 12
"""Held blocks out of which one changes how lively the rover is."""

Data = Callable[[], Mapping[str, int]]
"""What the charts hold now: headings to which a turn goes."""


def lengths(board: Board) -> tuple[int, ...]:
    """How long inputs are held: a few steps, and around the length of every timer of the charts."""
    words = (n for c in board.system.charts for n in nodes(*c.expressions) if isinstance(n, Temporal))
    timers = {w.span.ticks(board.system.step_ms) for w in words if w.span is not None}
    return (*SHORT * 3, *sorted(t + d for t in timers for d in (-2, -1, 0, 1, 2) if t + d > 0))


class Weather:
    """Random inputs of one board."""

    def __init__(self, board: Board) -> None:
        self._signals = [s for s in board.inputs if s.name != CLOCK]
        self._holds = lengths(board)
        self._read = [names for c in board.system.charts if (names := _signals_read(c, self._signals))]

    def run(self, random: Random, ticks: int, data: Data) -> Iterator[Moment]:
        """The inputs of a random run; ``data`` is asked as it goes."""
        at = {s.name: _well(s) for s in self._signals}
        lively = self._lively(random)
        left = 0
        for _ in range(ticks):
            if left <= 0:
                left = random.choice(self._holds if random.random() < LONG else SHORT)
                if random.randrange(OFTEN) == 0:
                    lively = self._lively(random)
                at = {s.name: _next(random, s, at[s.name], s.name in lively, data) for s in self._signals}
            left -= 1
            yield at

    def _lively(self, random: Random) -> set[str]:
        """The signals that change: what one chart reads, or any, few or many."""
        if self._read and random.random() < FOCUS:
            return {name for name in random.choice(self._read) if random.random() < 0.8}
        share = random.choice((0.05, 0.1, 0.25, 0.6))
        return {s.name for s in self._signals if random.random() < share}


def _signals_read(chart: Chart, signals: Sequence[BoardSignal]) -> list[str]:
    """The signals that a chart reads itself, in the order of the board."""
    read = {v.name.rpartition(".")[2] for v in chart.read.values()}
    return [s.name for s in signals if s.name in read]


def _well(signal: BoardSignal) -> Value:
    return True if signal.stamp else WELL.get(signal.name, signal.initial)


def _next(random: Random, signal: BoardSignal, now: Value, lively: bool, data: Data) -> Value:
    if not lively:
        return _well(signal) if random.random() < 0.3 else now
    if signal.stamp:
        return random.random() < 0.5
    if random.random() < 0.3:
        return now
    if _heading(signal) and random.random() < 0.7:
        return _near_a_heading(random, signal, data())
    return units(signal.domain, random.choice(signal.domain.values))


def _heading(signal: BoardSignal) -> bool:
    return isinstance(signal.domain.sort, Num) and str(signal.domain.sort.unit) == "°"


def _near_a_heading(random: Random, signal: BoardSignal, data: Mapping[str, int]) -> Value:
    """A heading at or near one that the charts remember, or near a right or half turn from it."""
    targets = [raw for name, raw in data.items() if "target" in name]
    steps = random.choice((0, 0, 1, 2, 3, 4, 17, 18, 19, 53, 54, 55, 71, 72)) * random.choice((-1, 1))
    values = signal.domain.values
    return units(signal.domain, values[(int(random.choice(targets or [0])) + steps) % len(values)])
