"""Runs of a model of one's own that take its transitions, found by random exploration of its charts."""

from collections.abc import Iterator, Sequence
from itertools import pairwise
from random import Random

from rovercheck.checker.board_tests.rows import Moment
from rovercheck.checker.compare.beside import ComparedStep, Run, SteppedCharts
from rovercheck.checker.compare.environment import Environment
from rovercheck.checker.system.instrument.goals import GoalKind
from rovercheck.checker.system.instrument.watch import watched
from rovercheck.checker.testgen.explore import RandomMachine, TriedRun, explored
from rovercheck.checker.testgen.scripts import Script, steps

TICKS = 40_000
"""Ticks of the exploration, the same in every comparison."""
TRIES = 60_000
"""Steps in which it is looked at whether a value of an input decides which transitions are taken."""
HELD = 3
"""Steps for which such a value is held."""


def covering(env: Environment) -> Iterator[Run]:
    """Runs that together take all transitions, and reach all sides of all boundaries, that were found.

    A boundary is also met where it decides: on both sides in the same state, beside the same other inputs,
    where other transitions are taken on one side than on the other.  Nothing says that others cannot be
    reached: what was taken is told by the coverage of the comparison.
    """
    machine = RandomMachine(env.board, watched(env.board.system, (GoalKind.TRANSITIONS, GoalKind.BOUNDARIES)))
    goals = [id for id, _ in machine.flags]
    scripts: list[Script] = []
    for found in explored(machine, goals, Random(0), TICKS):
        scripts = [s for s in scripts if s != found.script[: len(s)]]
        scripts.append(found.script)
    for number, script in enumerate(scripts, 1):
        yield f"covering run {number}", _admissible(env, script)
    for number, script in enumerate(_deciding(env, scripts), 1):
        yield f"deciding run {number}", _admissible(env, script)


def _deciding(env: Environment, scripts: Sequence[Script]) -> Iterator[Script]:
    """Scripts that end beside a value of one input from which on the charts take other transitions."""
    machine = RandomMachine(env.board, watched(env.board.system, (GoalKind.TRANSITIONS,)))
    seen, left = set[tuple[object, ...]](), TRIES
    for script in sorted(scripts, key=len):
        place = TriedRun.power_up(machine)
        for moment in script:
            for around in (moment, dict(env.calm)):
                for name, values in env.values.aimed.items():
                    left -= len(values)
                    tried = [(value, _taken(place, {**around, name: value})) for value in values]
                    for (low, below), (high, above) in pairwise(tried):
                        key = name, low, high, below ^ above
                        if below != above and key not in seen:
                            seen.add(key)
                            for value in (low, high):
                                yield (*place.given, *(({**around, name: value},) * HELD))
            if left <= 0:
                return
            place.step(moment)


def _taken(place: TriedRun, moment: Moment) -> frozenset[str]:
    """The transitions that are taken in a step from there."""
    return frozenset(place.copy().step(moment))


def _admissible(env: Environment, script: Script) -> list[ComparedStep]:
    """What the charts do, up to the first inputs that the model takes not to come."""
    charts, found = SteppedCharts(env.board), list[ComparedStep]()
    for inputs in steps(env.board, script):
        if not charts.admits(inputs):
            break
        found.append(charts.step(inputs))
    return found
