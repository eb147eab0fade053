"""What is tried on mutants before anything is searched, and in which order."""

from collections.abc import Iterator, Mapping, Sequence
from typing import TypeVar

from checker.lowered import lowered
from checker.verdict import Run
from spec_model.lang.system import System

COUNT, TICKS = 10, 300
"""Random runs of a system, and how long they are: longer than most timers."""
LONGEST = 1_000
"""Ticks of a run on record that is still tried on every mutant."""
ON = 60
"""Ticks for which a run on record goes on with its last inputs: what it leads to may come a little later."""
ROUNDS = (16, 4, 1)
"""Every 16th mutant is judged first, then every 4th of the others, then what is left."""

One = TypeVar("One")


def random_runs(system: System) -> tuple[Run, ...]:
    """Runs of a system whose inputs are drawn at random and held for a while, always the same ones."""
    from checker.encode.cone import as_written, cone, straying  # by numpy and Z3, which take a while to load
    from checker.encode.simulate import Simulator
    from checker.encode.symbolic import transition
    from checker.encode.unrolling import Outside

    whole = lowered(system)
    stepped, names = transition(whole), [v.name for v in whole.variables]
    escapes = straying(stepped, as_written(whole, names))
    part = cone(stepped, [*names, *escapes])
    outside = Outside(whole, part)
    if not outside.possible:
        return ()
    simulator = Simulator(part, tuple(escapes.values()), lanes=COUNT)
    trail = simulator.run(simulator.start(), TICKS)
    frozen = [v.name for v in part.frozen]
    return tuple(outside.complete(trail.extract(TICKS, lane, frozen)) for lane in range(COUNT))


def tried(known: Sequence[Run]) -> Iterator[Run]:
    """Runs on record that are not too long, the shortest first, each going on for a while."""
    for run in sorted(known, key=len):
        if 0 < len(run) <= LONGEST:
            yield Run(run.frozen, run.inputs + run.inputs[-1:] * ON)


def spread(found: Sequence[One]) -> Iterator[One]:
    """Some from everywhere first."""
    numbers: Mapping[int, None] = dict.fromkeys(n for every in ROUNDS for n in range(0, len(found), every))
    return (found[number] for number in numbers)


__all__ = ["ON", "ROUNDS", "random_runs", "spread", "tried"]
