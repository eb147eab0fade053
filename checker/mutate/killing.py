"""For each property a fault that it notices: what runs on record and random runs show."""

from collections.abc import Sequence
from dataclasses import dataclass
from time import monotonic

from checker.mutate.asked import as_it_is
from checker.mutate.mutants import Mutant, mutants
from checker.mutate.tries import random_runs, spread, tried
from checker.runs.known import reached
from checker.verdict import Run
from properties.forms import Property
from spec_model.lang.errors import ModelError
from spec_model.lang.system import System


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
    runs = [*tried(known), *random_runs(original)]
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


__all__ = ["Kill", "kills", "noticed"]
