"""Search by random inputs: runs go on from where earlier runs reached something new."""

from collections.abc import Collection, Iterator, Mapping, Sequence
from copy import deepcopy
from dataclasses import dataclass
from random import Random

from checker.system.instrument.goals import Watched
from checker.testgen.compiled import Step, compiled
from checker.testgen.scripts import CLOCK, Moment, Script
from checker.testgen.weather import Weather
from spec_model.abstraction import Board, Value
from spec_model.abstraction.board import BoardReader
from spec_model.lang.lower import lower
from spec_model.lang.system import TICK_MS

LONGEST = 400
"""Ticks of one random run."""
FROM_START = 0.2
"""Share of runs that begin at power-up."""


class RandomMachine:
    """A board whose charts were made one Python function: where runs start and how they go on."""

    def __init__(self, board: Board, watched: Watched) -> None:
        lowered = lower(watched.system)
        self.board = board
        self.step: Step = compiled(lowered)
        self.start = {**lowered.init, **{v.name: v.init for v in lowered.frozen}}
        self.flags = tuple((g.id, g.flag.name) for g in watched.goals)


@dataclass
class TriedPlace:
    """A run so far: the valuation, the clock and stamps, what the reader remembers, the inputs given."""

    machine: RandomMachine
    at: dict[str, int]
    stamps: dict[str, Value]
    reader: BoardReader
    given: list[Moment]

    @staticmethod
    def power_up(machine: RandomMachine) -> "TriedPlace":
        """Before the first step."""
        stamps = {s.name: s.initial for s in machine.board.inputs if s.stamp}
        return TriedPlace(machine, dict(machine.start), stamps, machine.board.reader(), [])

    def copy(self) -> "TriedPlace":
        return TriedPlace(
            self.machine, dict(self.at), dict(self.stamps), deepcopy(self.reader), list(self.given)
        )

    def now(self) -> Mapping[str, int]:
        """The valuation after the last step."""
        return self.at

    def step(self, moment: Moment) -> list[str]:
        """One step; the goals reached in it."""
        self.given.append(moment)
        now = len(self.given) * TICK_MS
        self.stamps |= {name: now for name in self.stamps if moment.get(name)}
        self.stamps[CLOCK] = now
        self.at |= self.reader.step({**moment, **self.stamps})
        self.machine.step(self.at)
        return [id for id, flag in self.machine.flags if self.at[flag]]


@dataclass(frozen=True)
class Find:
    """A script and the goals that its last step is the first to reach."""

    goals: tuple[str, ...]
    script: Script


def explored(
    machine: RandomMachine,
    wanted: Collection[str],
    random: Random,
    ticks: int,
    known: Sequence[Script] = (),
) -> Iterator[Find]:
    """Scripts for goals, found within so many ticks of random runs that go on, too, where known scripts end.

    Reproducible.
    """
    left = set(wanted)
    places = [TriedPlace.power_up(machine), *(_end(machine, script) for script in known)]
    weather = Weather(machine.board)
    while ticks > 0 and left:
        place = (places[0] if random.random() < FROM_START else _recent(random, places)).copy()
        for moment in weather.run(random, random.randint(1, LONGEST), place.now):
            ticks -= 1
            new = left.intersection(place.step(moment))
            if new:
                left -= new
                places.append(place.copy())
                yield Find(tuple(sorted(new)), tuple(place.given))


def _end(machine: RandomMachine, script: Script) -> TriedPlace:
    place = TriedPlace.power_up(machine)
    for moment in script:
        place.step(moment)
    return place


def _recent(random: Random, places: Sequence[TriedPlace]) -> TriedPlace:
    """A place, later ones rather than earlier ones: they are deeper in what is hard to reach."""
    return places[-1 - int(len(places) * random.random() ** 2)] if len(places) > 1 else places[0]


def first_reached(machine: RandomMachine, script: Sequence[Moment]) -> dict[str, int]:
    """The first step, from 1, in which each goal is reached."""
    place, found = TriedPlace.power_up(machine), dict[str, int]()
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
