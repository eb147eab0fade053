"""Input sequences in held blocks, and how they become concrete inputs, step by step.

A block may say where a measurement lies relative to what the charts hold, such as the target of a turn: it
is resolved while the charts run, so that the same stimulus always gives the same inputs.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import cycle
from typing import Protocol

from rovercheck.spec_model.abstraction import Board, BoardSignal, Value
from rovercheck.spec_model.abstraction.stamps import CLOCK, NOW
from rovercheck.spec_model.lang.domain import Num
from rovercheck.spec_model.lang.expr import Var
from rovercheck.spec_model.lang.system import TICK_MS

FULL_TURN = 360


@dataclass(frozen=True)
class Every:
    """Updates of a source: the steps from one to the next, in a cycle, and how many ms before its step each
    is stamped, in a cycle.  No gaps: silence."""

    gaps: tuple[int, ...] = (1,)
    lags_ms: tuple[int, ...] = (0,)


SILENT = Every(())


@dataclass(frozen=True)
class Toward:
    """A heading so many degrees from one that the charts hold when the block begins."""

    datum: str
    offset: float


@dataclass(frozen=True)
class Turning:
    """A heading that turns by so many degrees in each step of the block."""

    rate: float


Change = Value | Every | Toward | Turning


@dataclass(frozen=True)
class InputBlock:
    """What changes at its start, and the number of steps for which it then holds."""

    steps: int
    changes: tuple[tuple[str, Change], ...] = ()


@dataclass(frozen=True)
class Stimulus:
    """The time of the first step, and the blocks from power-up on."""

    blocks: tuple[InputBlock, ...]
    start_ms: int = TICK_MS

    def __len__(self) -> int:
        return sum(block.steps for block in self.blocks)


class ChartsView(Protocol):
    """What a stimulus reads of the charts while they run."""

    def valuation(self) -> dict[str, int]: ...


class StimulusSource:
    """A stamp, the fields that arrive with it, and its rhythm."""

    def __init__(self, stamp: str, fields: tuple[str, ...]) -> None:
        self.stamp, self.fields = stamp, fields
        self.follow(SILENT)

    def follow(self, rhythm: Every) -> None:
        """Update in the next step, and from then on in this rhythm."""
        self._gaps, self._lags = cycle(rhythm.gaps), cycle(rhythm.lags_ms)
        self._wait = 1 if rhythm.gaps else 0

    def due(self) -> int | None:
        """The lag of an update in this step, or None without one."""
        if self._wait == 0:
            return None
        self._wait -= 1
        if self._wait:
            return None
        self._wait = next(self._gaps)
        return next(self._lags)


class StimulusPlayer:
    """Turns one stimulus into inputs; ``fields`` names what arrives with each stamp.

    A field changes in the steps in which its stamp does, and what arrives with none at once.
    """

    def __init__(self, board: Board, fields: Mapping[str, tuple[str, ...]], charts: ChartsView) -> None:
        self._charts, self._tick_ms = charts, board.tick_ms
        self._data = {**board.system.written, **board.system.inputs}
        self._inputs = board.at_power_up()
        self._wanted = {s.name: s.initial for s in board.inputs if not s.stamp}
        self._sources = {
            s.name: StimulusSource(s.name, fields.get(s.name, ())) for s in board.inputs if clocked(s)
        }
        arriving = {name for s in self._sources.values() for name in s.fields}
        self._free = [name for name in self._wanted if name not in arriving]

    def steps(self, stimulus: Stimulus) -> Iterator[dict[str, Value]]:
        """The inputs of each step.  The charts must have run the step before the next one is asked for."""
        now = stimulus.start_ms
        for block in stimulus.blocks:
            turning = self._begin(block)
            for _ in range(block.steps):
                for name, rate in turning.items():
                    self._wanted[name] = (self._wanted[name] + rate) % FULL_TURN
                yield self._step(now)
                now = (now + self._tick_ms) % CLOCK

    def _begin(self, block: InputBlock) -> dict[str, float]:
        turning: dict[str, float] = {}
        for name, change in block.changes:
            match change:
                case Every():
                    self._sources[name].follow(change)
                case Turning(rate):
                    turning[name] = rate
                case Toward(datum, offset):
                    held = in_units(self._data[datum], self._charts.valuation()[datum])
                    self._wanted[name] = (held + offset) % FULL_TURN
                case _:
                    self._wanted[name] = change
        return turning

    def _step(self, now: int) -> dict[str, Value]:
        inputs, wanted = self._inputs, self._wanted
        inputs[NOW] = now
        for source in self._sources.values():
            lag = source.due()
            if lag is not None:
                inputs[source.stamp] = (now - lag) % CLOCK
                for name in source.fields:
                    inputs[name] = wanted[name]
        for name in self._free:
            inputs[name] = wanted[name]
        return dict(inputs)


def clocked(signal: BoardSignal) -> bool:
    """Whether the signal is the stamp of a source."""
    return signal.stamp and signal.name != NOW


def in_units(datum: Var, raw: int) -> float:
    """The number of a raw value, in the unit of its variable."""
    assert isinstance(datum.sort, Num)
    return float(raw * datum.sort.resolution)
