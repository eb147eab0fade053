"""``rovercheck mutate``: faults put into a model, and what notices them."""

from collections.abc import Collection, Generator, Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass, replace
from random import Random

from checker.commands.check import results
from checker.commands.codes import Exit, UsageError
from checker.commands.mutating_found import Found
from checker.commands.mutating_json import document
from checker.commands.mutating_places import sites
from checker.commands.mutating_text import report
from checker.commands.output import err, out, wrapped
from checker.commands.progress import Watch
from checker.commands.select import pick
from checker.commands.tables import listed
from checker.engine import AUTO, Limits
from checker.model import Model
from checker.model.kept_invariants import Recorded, invariants_of
from checker.model.kept_runs import file_of, read
from checker.mutate.asked import as_it_is
from checker.mutate.judging import Fate, Judged
from checker.mutate.mutants import Mutant, mutants
from checker.mutate.planning import Plan, Planned, homes, rounds
from checker.mutate.running import Doing, Told, fates
from checker.printable import json_text
from checker.verdict import Run
from properties.forms import Property, Reachable, Unbounded
from spec_model.lang.chart import parts
from spec_model.lang.system import System

UNKILLED = (Fate.SURVIVOR, Fate.NOTICED, Fate.UNKNOWN)
"""What a mutant may be in its own system that properties of other systems may still kill."""
WORTH_RUNS = 4
"""Such mutants from which on the runs of other systems are searched once, to be tried on each of them."""


@dataclass(frozen=True)
class Wanted:
    """What the command line asks for.

    ``named`` are systems, ``parts`` charts and blocks; without any, all are meant.  ``alone``: only
    properties about the named systems count; ``by_place``: also which properties constrain each place.
    """

    named: tuple[str, ...]
    parts: tuple[str, ...] = ()
    sample: int | None = None
    seed: int = 0
    alone: bool = False
    by_place: bool = False
    jobs: int | None = None


def mutate(model: Model, wanted: Wanted, limits: Limits, as_json: bool) -> Exit:
    """Judge the mutants of a model, and tell what becomes of each.

    Raises ``UsageError`` for an unknown system, ``ModelError`` where the model has no meaning.
    """
    properties = [p for p in model.stated().values() if not p.costly]
    at_home = _homes(model, wanted, {p.on for p in properties})
    if not any(p.on in at_home for p in properties):
        err.print("Nothing to check: no property is about what was selected.")
        return Exit.NOTHING
    todo = _chosen(model.systems, at_home, wanted)
    named = wanted.named if wanted.named and not wanted.parts else tuple(at_home)
    found = Found(named, len(todo), seed=None if wanted.sample is None else wanted.seed)
    if wanted.sample is not None and wanted.sample < len(todo):
        kept = sorted(Random(wanted.seed).sample(range(len(todo)), wanted.sample))
        todo = [todo[number] for number in kept]
    found.chosen = len(todo)
    code = Exit.INTERRUPTED
    try:
        _judged(model, properties, todo, wanted, limits, found)
        code = found.code
    except KeyboardInterrupt:
        err.print(f"Interrupted: {len(found.told)} of {found.chosen} mutants judged.")
    if as_json:
        print(json_text(document(found, code), ascii=True))
    else:
        if wanted.by_place:
            rows = [(site.name, site.counts, site.by) for site in sites(found)]
            listed(("place", "faults", "constrained by"), rows)
            out.print()
        for text, indent in report(found):
            out.print(wrapped(text, indent), markup=False)
    return code


def _homes(model: Model, wanted: Wanted, stated: Collection[str]) -> dict[str, list[str]]:
    """The parts to make faulty by the system in which each is judged first: the smallest with properties.

    That is one of the systems named, if properties of no other count.
    """
    systems = {name: pick("system", name, model.systems) for name in wanted.named}
    known = {p.name: p for system in model.systems.values() for p in parts(system.components)}
    chosen = {pick("chart or block", name, known).name for name in wanted.parts} or known.keys()
    if systems:
        chosen = chosen & {p.name for system in systems.values() for p in parts(system.components)}
    among = [name for name in model.systems if name in stated]
    if wanted.alone and systems:
        among = list(systems)
    inside = homes(model.systems, dict.fromkeys([*among, *systems]), chosen)
    return {name: names for name, names in inside.items() if names}


def _chosen(
    systems: Mapping[str, System], at_home: Mapping[str, Sequence[str]], wanted: Wanted
) -> list[tuple[str, Mutant]]:
    if wanted.sample is not None and wanted.sample < 1:
        raise UsageError("--sample takes a number of mutants, at least 1.")
    return [
        (name, mutant)
        for name, inside in at_home.items()
        for mutant in mutants(as_it_is(systems[name]), inside)
    ]


def _judged(
    model: Model,
    properties: Sequence[Property],
    todo: Sequence[tuple[str, Mutant]],
    wanted: Wanted,
    limits: Limits,
    found: Found,
) -> None:
    """Judge the mutants, each first in its own system; what is found goes to ``found`` at once."""
    at = {mutant.id: name for name, mutant in todo}
    own = [p for p in properties if p.on in set(at.values())]
    recorded = {p.id: _recorded(model, p.id) for p in properties}
    plan = Plan(model.systems, properties, recorded, premises=_premises(model))
    invariants = invariants_of(model)
    _decide(plan, own, limits, wanted.jobs, invariants)
    found.undecided += [p.id for p in own if p.id not in plan.proved]
    first = [plan.own(mutant, name) for name, mutant in todo]
    unkilled: dict[str, Judged] = {}
    try:
        for told in _told(plan, first, limits, wanted.jobs, {}):
            if told.judged.fate in UNKILLED and not wanted.alone:
                unkilled[told.mutant.id] = told.judged
            else:
                found.told.append((at[told.mutant.id], told.mutant, told.judged))
        again = [plan.elsewhere(one.mutant, at[one.mutant.id]) for one in first if one.mutant.id in unkilled]
        for one in again:
            if not one.cases:
                judged = unkilled.pop(one.mutant.id)
                found.told.append((at[one.mutant.id], one.mutant, judged))
        again = [one for one in again if one.cases]
        if len(again) >= WORTH_RUNS:
            asked = {p.id: p for one in again for case in one.cases for p in case.properties}
            with_runs = [p for p in asked.values() if p.id not in plan.proved and _has_run(plan, p)]
            _decide(plan, with_runs, limits, wanted.jobs, invariants)
        for told in _told(plan, again, limits, wanted.jobs, unkilled):
            unkilled.pop(told.mutant.id)
            found.told.append((at[told.mutant.id], told.mutant, told.judged))
    except KeyboardInterrupt:
        left = {one.mutant.id: one.mutant for one in first}
        why = "interrupted before other systems were looked at"
        for id, judged in unkilled.items():
            found.told.append((at[id], left[id], replace(judged, fate=Fate.UNKNOWN, why=judged.why or why)))
        raise
    finally:
        order = {mutant.id: number for number, (_, mutant) in enumerate(todo)}
        found.told.sort(key=lambda one: order[one[1].id])


def _premises(model: Model) -> dict[str, list[Run]]:
    """The runs on record that show cases of which properties speak, by system."""
    found: dict[str, list[Run]] = {}
    for kept in read(file_of(model)).values():
        found.setdefault(kept.system, []).append(kept.run)
    return found


def _has_run(plan: Plan, prop: Property) -> bool:
    """Whether the verdict on record rests on a finite run."""
    if isinstance(prop.form, Unbounded):
        return False
    return plan.recorded[prop.id] is isinstance(prop.form, Reachable)


def _recorded(model: Model, id: str) -> bool | None:
    verdict = model.expected(id).verdict
    return None if verdict == "unknown" else verdict == "proved"


def _decide(
    plan: Plan, asked: Sequence[Property], limits: Limits, jobs: int | None, invariants: Recorded
) -> None:
    """Let the plan know the verdicts on the originals, in which every run counts."""
    own = {name: as_it_is(plan.systems[name]) for name in {p.on for p in asked}}
    for result in results(asked, own, AUTO, limits, jobs, invariants=invariants):
        plan.learn(result)


def _told(
    plan: Plan,
    planned: Sequence[Planned],
    limits: Limits,
    jobs: int | None,
    before: Mapping[str, Judged],
) -> Generator[Told, None, None]:
    """The fates of mutants, round by round, while it is said what is being done."""
    with Watch(err, len(planned)) as watch:
        for some in rounds(planned):
            heard = fates([plan.with_runs(one) for one in some], limits, jobs, before)
            with closing(heard):
                for one in heard:
                    match one:
                        case Doing(mutant, line):
                            watch.say(mutant.id, line)
                        case Told():
                            watch.finished(one.mutant.id)
                            plan.kills(one.judged)
                            yield one


__all__ = ["Found", "Wanted", "mutate"]
