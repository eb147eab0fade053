"""For each property a fault that it notices: what runs on record and runs drawn by chance show."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from time import monotonic

from checker.lowered import lowered
from checker.mutate.asked import as_it_is
from checker.mutate.mutants import Mutant, mutants
from checker.mutate.planning import ROUNDS
from checker.runs.chance import random_runs
from checker.runs.known import reached
from checker.verdict import Run
from properties.forms import Property
from spec_model.lang.errors import ModelError
from spec_model.lang.system import System

COUNT, TICKS = 10, 300
"""Runs by chance of a system, and how long they are: longer than most timers."""
LONGEST = 1_000
"""Ticks of a run on record that is still tried on every mutant."""
ON = 60
"""Ticks for which a run on record goes on with its last inputs: what it leads to may come a little later."""


@dataclass(frozen=True)
class Kill:
    """The id of a mutant that a property notices, and the run of it that violates the property."""

    mutant: str
    run: Run


def kills(
    system: System, properties: Sequence[Property], known: Sequence[Run], seconds: float
) -> dict[str, Kill]:
    """For properties that hold on the system, by id, a mutant on which they do not.

    Nothing is said of the others: ``seconds`` may have been too few, or the run too rare.
    """
    original = as_it_is(system)
    runs = [*tried(known), *random_runs(lowered(original), COUNT, TICKS)]
    left, found = {p.id: p for p in properties}, dict[str, Kill]()
    deadline = monotonic() + seconds
    for mutant in spread(mutants(original)):
        if not left or monotonic() > deadline:
            break
        for id, run in noticed(mutant, list(left.values()), runs).items():
            found[id] = Kill(mutant.id, run)
            del left[id]
    return found


def noticed(mutant: Mutant, properties: Sequence[Property], runs: Sequence[Run]) -> dict[str, Run]:
    """The properties that some of the runs violate on a mutant; none of one that has no meaning."""
    try:
        return reached(mutant.system, properties, runs)
    except ModelError:
        return {}


def tried(known: Sequence[Run]) -> Iterator[Run]:
    """Runs on record that are not too long, the shortest first, each going on for a while."""
    for run in sorted(known, key=len):
        if 0 < len(run) <= LONGEST:
            yield Run(run.frozen, run.inputs + run.inputs[-1:] * ON)


def spread(found: Sequence[Mutant]) -> Iterator[Mutant]:
    """Some from everywhere first."""
    numbers: Mapping[int, None] = dict.fromkeys(n for every in ROUNDS for n in range(0, len(found), every))
    return (found[number] for number in numbers)


__all__ = ["Kill", "kills", "noticed", "spread", "tried"]
