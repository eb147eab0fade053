"""Search by random inputs: runs go on from where earlier runs reached something new."""

from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from random import Random

from rovercheck.checker.board_tests.rows import Moment
from rovercheck.checker.system.instrument.goals import Watched
from rovercheck.checker.testgen.compiled_charts import Step, compiled
from rovercheck.checker.testgen.scripts import Script, advance, stamps_of
from rovercheck.spec_model.abstraction import Board, BoardSignal, InterfaceReader, Value
from rovercheck.spec_model.abstraction.signals import units
from rovercheck.spec_model.abstraction.stamps import NOW
from rovercheck.spec_model.lang.chart import Chart
from rovercheck.spec_model.lang.domain import Num
from rovercheck.spec_model.lang.expr import Temporal
from rovercheck.spec_model.lang.lower import lower
from rovercheck.spec_model.lang.walk import nodes

# --- random inputs as a rover meets them ---------------------------------------------------------------

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


class RandomInputs:
    """Random inputs of one board."""

    def __init__(self, board: Board) -> None:
        self._signals = [s for s in board.inputs if s.name != NOW]
        well = {s.name: s.initial for s in self._signals} | dict(board.interface.in_charge)
        self._well: Moment = {s.name: 0 if s.stamp else well[s.name] for s in self._signals}
        self._holds = lengths(board)
        self._read = [names for c in board.system.charts if (names := _signals_read(c, self._signals))]

    def run(self, random: Random, ticks: int, data: Data) -> Iterator[Moment]:
        """The inputs of a random run; ``data`` is asked as it goes."""
        at: Moment = self._well
        lively = self._lively(random)
        left = 0
        for _ in range(ticks):
            if left <= 0:
                left = random.choice(self._holds if random.random() < LONG else SHORT)
                if random.randrange(OFTEN) == 0:
                    lively = self._lively(random)
                at = {
                    s.name: self._next(random, s, at[s.name], s.name in lively, data) for s in self._signals
                }
            left -= 1
            yield at

    def _lively(self, random: Random) -> set[str]:
        """The signals that change: what one chart reads, or any, few or many."""
        if self._read and random.random() < FOCUS:
            return {name for name in random.choice(self._read) if random.random() < 0.8}
        share = random.choice((0.05, 0.1, 0.25, 0.6))
        return {s.name for s in self._signals if random.random() < share}

    def _next(
        self, random: Random, signal: BoardSignal, now: Value | None, lively: bool, data: Data
    ) -> Value | None:
        if not lively:
            return self._well[signal.name] if random.random() < 0.3 else now
        if signal.stamp:
            return 0 if random.random() < 0.5 else None
        if random.random() < 0.3:
            return now
        if _heading(signal) and random.random() < 0.7:
            return _near_a_heading(random, signal, data())
        return units(signal.domain, random.choice(signal.domain.values))


def _signals_read(chart: Chart, signals: Sequence[BoardSignal]) -> list[str]:
    """The signals that a chart reads itself, in the order of the board."""
    read = {v.name.rpartition(".")[2] for v in chart.read.values()}
    return [s.name for s in signals if s.name in read]


def _heading(signal: BoardSignal) -> bool:
    return isinstance(signal.domain.sort, Num) and str(signal.domain.sort.unit) == "°"


def _near_a_heading(random: Random, signal: BoardSignal, data: Mapping[str, int]) -> Value:
    """A heading at or near one that the charts remember, or near a right or half turn from it."""
    targets = [raw for name, raw in data.items() if "target" in name]
    steps = random.choice((0, 0, 1, 2, 3, 4, 17, 18, 19, 53, 54, 55, 71, 72)) * random.choice((-1, 1))
    values = signal.domain.values
    return units(signal.domain, values[(int(random.choice(targets or [0])) + steps) % len(values)])


LONGEST = 400
"""Ticks of one random run."""
FROM_START = 0.2
"""Share of runs that begin at power-up."""


class RandomMachine:
    """A board whose charts were made one Python function: where runs start and how they go on."""

    def __init__(self, board: Board, watched: Watched) -> None:
        lowered = lower(watched.system)
        self.board, self.stamps = board, stamps_of(board)
        self.step: Step = compiled(lowered)
        self.start = {**lowered.init, **{v.name: v.init for v in lowered.frozen}}
        self.flags = tuple((g.id, g.flag.name) for g in watched.goals)


@dataclass
class TriedRun:
    """A run so far: the state, the concrete inputs, what the reader remembers, the inputs given."""

    machine: RandomMachine
    at: dict[str, int]
    inputs: dict[str, Value]
    reader: InterfaceReader
    given: list[Moment]

    @staticmethod
    def power_up(machine: RandomMachine) -> "TriedRun":
        """Before the first step."""
        board = machine.board
        return TriedRun(machine, dict(machine.start), board.at_power_up(), board.reader(), [])

    def copy(self) -> "TriedRun":
        return TriedRun(self.machine, dict(self.at), dict(self.inputs), self.reader.copy(), list(self.given))

    def now(self) -> Mapping[str, int]:
        """The state after the last step."""
        return self.at

    def step(self, moment: Moment) -> list[str]:
        """One step; the goals reached in it."""
        self.given.append(moment)
        advance(self.inputs, self.machine.stamps, len(self.given) * self.machine.board.tick_ms, moment)
        self.at |= self.reader.step(self.inputs)
        self.machine.step(self.at)
        return [id for id, flag in self.machine.flags if self.at[flag]]


@dataclass(frozen=True)
class NewScript:
    """A script and the goals that its last step is the first to reach."""

    goals: tuple[str, ...]
    script: Script


def explored(
    machine: RandomMachine,
    wanted: Collection[str],
    random: Random,
    ticks: int,
    known: Sequence[Script] = (),
) -> Iterator[NewScript]:
    """Scripts for goals, found within so many ticks of random runs that go on, too, where known scripts end.

    Reproducible.
    """
    left = set(wanted)
    places = [TriedRun.power_up(machine), *(_end(machine, script) for script in known)]
    source = RandomInputs(machine.board)
    while ticks > 0 and left:
        place = (places[0] if random.random() < FROM_START else _recent(random, places)).copy()
        for moment in source.run(random, random.randint(1, LONGEST), place.now):
            ticks -= 1
            new = left.intersection(place.step(moment))
            if new:
                left -= new
                places.append(place.copy())
                yield NewScript(tuple(sorted(new)), tuple(place.given))


def _end(machine: RandomMachine, script: Script) -> TriedRun:
    place = TriedRun.power_up(machine)
    for moment in script:
        place.step(moment)
    return place


def _recent(random: Random, places: Sequence[TriedRun]) -> TriedRun:
    """A place, later ones rather than earlier ones: they are deeper in what is hard to reach."""
    return places[-1 - int(len(places) * random.random() ** 2)] if len(places) > 1 else places[0]


def first_reached(machine: RandomMachine, script: Sequence[Moment]) -> dict[str, int]:
    """The first step, from 1, in which each goal is reached."""
    place, found = TriedRun.power_up(machine), dict[str, int]()
    for number, moment in enumerate(script, start=1):
        for id in place.step(moment):
            found.setdefault(id, number)
    return found


Reached = Mapping[str, int]


def shortened(machine: RandomMachine, script: Script, wanted: Collection[str], most: int = 60_000) -> Script:
    """A script that still reaches the wanted goals, without steps that can be left out.

    Groups of steps are left out in turn, half of them, then ever smaller groups; at most ``most`` ticks run.
    """
    script = _ended(machine, script, wanted)
    size = len(script) // 2
    while size and most > 0:
        start = 0
        while start < len(script) and most > 0:
            shorter = (*script[:start], *script[start + size :])
            most -= len(shorter)
            reached = first_reached(machine, shorter)
            if all(id in reached for id in wanted):
                script = shorter[: max(reached[id] for id in wanted)]
            else:
                start += size
        size //= 2
    return script


def _ended(machine: RandomMachine, script: Script, wanted: Collection[str]) -> Script:
    """The script up to the step in which the last of the goals is reached."""
    reached = first_reached(machine, script)
    return script[: max(reached[id] for id in wanted)]
