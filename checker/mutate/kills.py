"""For each property a fault that it notices: by recorded runs, by random runs, then by a search."""

import re
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from time import monotonic
from types import MappingProxyType

from rovercheck.checker.engines import AUTO, Limits
from rovercheck.checker.mutate.mutants import Mutant, mutants
from rovercheck.checker.mutate.relevance import as_it_is, changed
from rovercheck.checker.mutate.tries import RandomRuns, spread, tried
from rovercheck.checker.results.verdict import Run, Violated
from rovercheck.checker.system.lowering_cache import lowered
from rovercheck.checker.verify.decide import decide
from rovercheck.checker.verify.runs.known_runs import reached, run_of
from rovercheck.checker.verify.tasks import tasks
from rovercheck.properties.forms import Property, formulas
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.system import System
from rovercheck.spec_model.lang.walk import variables

SEARCHES = (
    ("bmc", Limits(depth=6, seconds=2.0)),
    ("bmc", Limits(depth=60, seconds=10.0)),
    (AUTO, Limits(seconds=30.0)),
)
"""Engines, with what each may spend on a fault, as another fault may be noticed sooner.  ``bmc`` proves
nothing, which is not asked; what takes long runs is left to all of them."""
WORD = re.compile(r"\w+")
DEAD = "dead"
"""The operator that takes a whole part away: tried first, a property that notices it needs the part."""


@dataclass(frozen=True)
class Kill:
    """The id of a mutant that a property notices, and the run of it that violates the property."""

    mutant: str
    run: Run


def still(system: System, properties: Sequence[Property], known: Mapping[str, Kill]) -> dict[str, Kill]:
    """Of the recorded kills those that are kills of the properties and charts as they are now, by id."""
    original, found = as_it_is(system), dict[str, Kill]()
    wanted = {kill.mutant for kill in known.values()}
    made = {m.id: m for m in mutants(original, {id.partition("/")[0] for id in wanted}) if m.id in wanted}
    for prop in (p for p in properties if p.id in known):
        kill = known[prop.id]
        if kill.mutant in made and noticed(made[kill.mutant], [prop], [kill.run]):
            found[prop.id] = kill
    again = reached(original, properties, [kill.run for kill in found.values()])
    return {id: kill for id, kill in found.items() if id not in again}


def kills(
    system: System,
    properties: Sequence[Property],
    known: Sequence[Run],
    seconds: float,
    premises: Mapping[str, Run] = MappingProxyType({}),
) -> Iterator[dict[str, Kill]]:
    """For properties that hold on the system, by id, a mutant on which they do not; as they are found.

    Runs are tried for ``seconds`` at most, then for as long others that are near one of ``premises``, which
    shows the case that a property speaks of, and then a run is searched for as long.  Nothing is said of the
    others: ``seconds`` may have been too few.
    """
    original = as_it_is(system)
    drawn = RandomRuns(original)
    runs = [*tried(known), *drawn.from_the_start()]
    left = {p.id: p for p in properties}
    deadline = monotonic() + seconds
    for mutant in spread(mutants(original)):
        if not left or monotonic() > deadline:
            break
        found = noticed(mutant, list(left.values()), runs)
        if found:
            left = {id: prop for id, prop in left.items() if id not in found}
            yield {id: Kill(mutant.id, run) for id, run in found.items()}
    deadline = monotonic() + seconds
    for one in [left[id] for id in premises if id in left]:
        near = list(drawn.around(premises[one.id]))
        for mutant in alike(mutants(original), one):
            if one.id not in left or monotonic() > deadline:
                break
            found = noticed(mutant, [one], near)
            if found:
                left.pop(one.id)
                yield {id: Kill(mutant.id, run) for id, run in found.items()}
    yield from searched(original, list(left.values()), seconds)


def alike(made: Sequence[Mutant], prop: Property) -> list[Mutant]:
    """The mutants first that are about what a property speaks of."""
    spoken = {name.rpartition(".")[2] for name in variables(*formulas(prop.form))}
    words = {m.id: spoken & set(WORD.findall(f"{m.id} {m.text}")) for m in made}
    return sorted(made, key=lambda m: len(words[m.id]), reverse=True)


def searched(original: System, properties: Sequence[Property], seconds: float) -> Iterator[dict[str, Kill]]:
    """The same by engines, only of faults that change what a property depends on."""
    left = {p.id: p for p in properties}
    made = _the_dead_first(original) if left else []
    for engine, limits in SEARCHES:
        deadline = monotonic() + seconds
        for mutant in made:
            if not left or monotonic() > deadline:
                break
            asked = list(left.values())
            found = dict(_violated(original, mutant, asked, engine, limits, deadline))
            if found:
                left = {id: prop for id, prop in left.items() if id not in found}
                yield {id: Kill(mutant.id, run) for id, run in found.items()}


def _the_dead_first(original: System) -> list[Mutant]:
    made = mutants(original)
    return [m for m in made if m.operator == DEAD] + [*spread([m for m in made if m.operator != DEAD])]


def _violated(
    original: System,
    mutant: Mutant,
    properties: Sequence[Property],
    engine: str,
    limits: Limits,
    deadline: float,
) -> Iterator[tuple[str, Run]]:
    """The properties that a run found now violates on a mutant; none of one that has no meaning."""
    try:
        asked = list(changed(lowered(original), lowered(mutant.system), properties))
        systems = {mutant.system.name: mutant.system}
        for task in tasks(asked, systems):
            seconds = min(limits.seconds or 0.0, deadline - monotonic())
            if seconds <= 0:
                return
            for one in decide(task, systems, engine, replace(limits, seconds=seconds)):
                run = run_of(one.verdict) if isinstance(one.verdict, Violated) else None
                if run is not None:
                    yield one.property.id, run
    except ModelError:
        return


def noticed(mutant: Mutant, properties: Collection[Property], runs: Sequence[Run]) -> dict[str, Run]:
    """The properties that some of the runs violate on a mutant; none of one that has no meaning."""
    try:
        return reached(mutant.system, list(properties), runs)
    except ModelError:
        return {}


__all__ = ["Kill", "kills", "noticed", "searched", "still"]
