"""Runs of a model of one's own that take its transitions, found by random exploration of its charts."""

from collections.abc import Iterator
from random import Random

from rovercheck.checker.compare.beside import ComparedStep, SteppedCharts
from rovercheck.checker.compare.environment import Environment
from rovercheck.checker.compare.search import Run
from rovercheck.checker.system.instrument.goals import GoalKind
from rovercheck.checker.system.instrument.watch import watched
from rovercheck.checker.testgen.explore import RandomMachine, explored
from rovercheck.checker.testgen.scripts import Script, steps

TICKS = 40_000
"""Ticks of the exploration, the same in every comparison."""


def covering(env: Environment) -> Iterator[Run]:
    """Runs that together take all transitions, and reach all sides of all boundaries, that were found.

    Nothing says that others cannot be reached: what was taken is told by the coverage of the comparison.
    """
    machine = RandomMachine(env.board, watched(env.board.system, (GoalKind.TRANSITIONS, GoalKind.BOUNDARIES)))
    goals = [id for id, _ in machine.flags]
    scripts: list[Script] = []
    for found in explored(machine, goals, Random(0), TICKS):
        scripts = [s for s in scripts if s != found.script[: len(s)]]
        scripts.append(found.script)
    for number, script in enumerate(scripts, 1):
        yield f"covering run {number}", _admissible(env, script)


def _admissible(env: Environment, script: Script) -> list[ComparedStep]:
    """What the charts do, up to the first inputs that the model takes not to come."""
    charts, found = SteppedCharts(env.board), list[ComparedStep]()
    for inputs in steps(env.board, script):
        if not charts.admits(inputs):
            break
        found.append(charts.step(inputs))
    return found
