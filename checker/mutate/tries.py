"""What is tried on mutants before anything is searched, and in which order."""

from collections.abc import Iterator, Mapping, Sequence
from typing import TypeVar

from checker.lowered import lowered
from checker.runs.chance import random_runs
from checker.verdict import Run
from spec_model.lang.system import System

COUNT, TICKS = 10, 300
"""Runs by chance of a system, and how long they are: longer than most timers."""
LONGEST = 1_000
"""Ticks of a run on record that is still tried on every mutant."""
ON = 60
"""Ticks for which a run on record goes on with its last inputs: what it leads to may come a little later."""
ROUNDS = (16, 4, 1)
"""Every 16th mutant is judged first, then every 4th of the others, then what is left."""

One = TypeVar("One")


def by_chance(system: System) -> tuple[Run, ...]:
    """Runs of a system with inputs drawn by chance, always the same ones."""
    return tuple(random_runs(lowered(system), COUNT, TICKS))


def tried(known: Sequence[Run]) -> Iterator[Run]:
    """Runs on record that are not too long, the shortest first, each going on for a while."""
    for run in sorted(known, key=len):
        if 0 < len(run) <= LONGEST:
            yield Run(run.frozen, run.inputs + run.inputs[-1:] * ON)


def spread(found: Sequence[One]) -> Iterator[One]:
    """Some from everywhere first."""
    numbers: Mapping[int, None] = dict.fromkeys(n for every in ROUNDS for n in range(0, len(found), every))
    return (found[number] for number in numbers)


__all__ = ["ON", "ROUNDS", "by_chance", "spread", "tried"]
