"""``rovercheck mutate``: faults put into a model, and what notices them."""

from collections.abc import Generator, Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass, replace
from random import Random

from checker.commands.check import results
from checker.commands.codes import Exit, UsageError
from checker.commands.mutating_found import Found
from checker.commands.mutating_json import document
from checker.commands.mutating_text import report
from checker.commands.output import err, out, wrapped
from checker.commands.progress import Watch
from checker.commands.select import pick
from checker.engine import AUTO, Limits
from checker.model import Model
from checker.mutate.asked import as_it_is
from checker.mutate.judging import Fate, Judged
from checker.mutate.mutants import Mutant, mutants
from checker.mutate.planning import Plan, Planned, homes
from checker.mutate.running import Doing, Told, fates
from checker.printable import json_text
from checker.result import Result
from checker.verdict import Proved, Unknown
from properties.forms import Property
from spec_model.lang.system import System


@dataclass(frozen=True)
class Wanted:
    """What the command line asks for; ``alone``: only properties about the named systems count."""

    named: tuple[str, ...]
    sample: int | None = None
    seed: int = 0
    alone: bool = False
    jobs: int | None = None


def mutate(model: Model, wanted: Wanted, limits: Limits, as_json: bool) -> Exit:
    """Judge the mutants of a model, and tell what becomes of each.

    Raises ``UsageError`` for an unknown system, ``ModelError`` where the model has no meaning.
    """
    properties = [p for p in model.stated().values() if not p.costly]
    named = _named(model, wanted, properties)
    if not any(p.on in named for p in properties):
        err.print("Nothing to check: no property is about what was selected.")
        return Exit.NOTHING
    todo = _chosen(model.systems, named, wanted)
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
        for text, indent in report(found):
            out.print(wrapped(text, indent), markup=False)
    return code


def _named(model: Model, wanted: Wanted, properties: Sequence[Property]) -> tuple[str, ...]:
    """The systems to make faulty: those named, else all that some property is about."""
    for name in wanted.named:
        pick("system", name, model.systems)
    stated = {p.on for p in properties}
    return tuple(dict.fromkeys(wanted.named or [name for name in model.systems if name in stated]))


def _chosen(systems: Mapping[str, System], named: Sequence[str], wanted: Wanted) -> list[tuple[str, Mutant]]:
    if wanted.sample is not None and wanted.sample < 1:
        raise UsageError("--sample takes a number of mutants, at least 1.")
    return [
        (name, mutant)
        for name, inside in homes(systems, named).items()
        if inside
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
    proved: dict[str, bool] = {}
    for result in _originals(model.systems, own, limits, wanted.jobs):
        if isinstance(result.verdict, Unknown):
            found.undecided.append(result.property.id)
        else:
            proved[result.property.id] = isinstance(result.verdict, Proved)
    recorded = {p.id: _recorded(model, p.id) for p in properties}
    plan = Plan(model.systems, properties, proved, recorded)
    first = [plan.own(mutant, name) for name, mutant in todo]
    survived: dict[str, Judged] = {}
    try:
        for told in _told(first, limits, wanted.jobs, {}):
            if told.judged.fate is Fate.SURVIVOR and not wanted.alone:
                survived[told.mutant.id] = told.judged
            else:
                found.told.append((at[told.mutant.id], told.mutant, told.judged))
        again = [plan.elsewhere(one.mutant, at[one.mutant.id]) for one in first if one.mutant.id in survived]
        for one in again:
            if not one.cases:
                judged = survived.pop(one.mutant.id)
                found.told.append((at[one.mutant.id], one.mutant, judged))
        again = [one for one in again if one.cases]
        for told in _told(again, limits, wanted.jobs, survived):
            survived.pop(told.mutant.id)
            found.told.append((at[told.mutant.id], told.mutant, told.judged))
    except KeyboardInterrupt:
        left = {one.mutant.id: one.mutant for one in first}
        why = "interrupted before other systems were looked at"
        for id, judged in survived.items():
            found.told.append((at[id], left[id], replace(judged, fate=Fate.UNKNOWN, why=why)))
        raise
    finally:
        order = {mutant.id: number for number, (_, mutant) in enumerate(todo)}
        found.told.sort(key=lambda one: order[one[1].id])


def _recorded(model: Model, id: str) -> bool | None:
    verdict = model.expected(id).verdict
    return None if verdict == "unknown" else verdict == "proved"


def _originals(
    systems: Mapping[str, System], properties: Sequence[Property], limits: Limits, jobs: int | None
) -> Generator[Result, None, None]:
    """The verdicts on the originals, in which every run counts."""
    own = {name: as_it_is(systems[name]) for name in {p.on for p in properties}}
    return results(properties, own, AUTO, limits, jobs)


def _told(
    planned: Sequence[Planned],
    limits: Limits,
    jobs: int | None,
    before: Mapping[str, Judged],
) -> Generator[Told, None, None]:
    """The fates of mutants, while it is said what is being done."""
    heard = fates(planned, limits, jobs, before)
    with Watch(err, len(planned)) as watch, closing(heard):
        for one in heard:
            match one:
                case Doing(mutant, line):
                    watch.say(mutant.id, line)
                case Told():
                    watch.finished(one.mutant.id)
                    yield one


__all__ = ["Found", "Wanted", "mutate"]
