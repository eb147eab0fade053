"""Runs with inputs drawn at random and held for a while: cheap to have, and they prove nothing."""

from collections.abc import Iterator, Mapping, Sequence
from random import Random

from checker.partition import Partition, partitions
from checker.verdict import Run
from spec_model.lang.evaluate import admissible, step
from spec_model.lang.system import TransitionSystem

HELD = (1, 1, 2, 5, 20, 60, 170)
"""For how many ticks an input may keep its value: some are over sooner than a timer, some later."""
ATTEMPTS = 20
"""Draws for one tick before the inputs of the last one are tried, and the run ends if they do not do."""


def random_runs(system: TransitionSystem, count: int, ticks: int, seed: int = 0) -> Iterator[Run]:
    """So many runs of at most so many ticks; the same ones for the same seed.

    Each value is drawn from the ends of the cells that the step tells apart.  A run ends early where no draw
    satisfies the assumption.
    """
    cells = partitions(system)
    values = {v.name: _ends(cells[v.name]) for v in system.inputs}
    frozen = {v.name: v.domain for v in system.frozen}
    for number in range(count):
        chance = Random(seed * 1_000_003 + number)
        at = {name: chance.choice(domain.values) for name, domain in frozen.items()}
        yield Run(at, tuple(_inputs(system, at, values, ticks, chance)))


def _ends(partition: Partition) -> Sequence[int]:
    """The lowest and the highest value of each cell."""
    ends: dict[int, tuple[int, int]] = {}
    for value, number in zip(partition.values, partition.numbers, strict=True):
        low, high = ends.get(number, (value, value))
        ends[number] = (min(low, value), max(high, value))
    return sorted({value for pair in ends.values() for value in pair})


def _inputs(
    system: TransitionSystem,
    frozen: Mapping[str, int],
    values: Mapping[str, Sequence[int]],
    ticks: int,
    chance: Random,
) -> Iterator[dict[str, int]]:
    at: Mapping[str, int] = {**system.init, **frozen}
    now = {v.name: v.init for v in system.inputs}
    left = dict.fromkeys(values, 0)
    calm = chance.random()
    for _ in range(ticks):
        for name in values:
            left[name] -= 1
        for attempt in range(ATTEMPTS):
            drawn = dict(now)
            for name, among in values.items():
                if among and (left[name] < 0 or (attempt and chance.random() < calm)):
                    drawn[name] = chance.choice(among)
            if admissible(system, at, drawn):
                break
        else:
            if not admissible(system, at, now):
                return
            drawn = dict(now)
        for name, value in drawn.items():
            if left[name] < 0 or value != now[name]:
                left[name] = chance.choice(HELD)
        now = drawn
        yield dict(now)
        after = step(system, at, now)
        at = {n: v for n, v in after.items() if n not in now}


__all__ = ["random_runs"]
