"""``rovercheck mutate``: faults put into a model, and what notices them."""

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from random import Random

from rovercheck.checker.commands.check.premises import recordable
from rovercheck.checker.commands.mutate import MutateOptions
from rovercheck.checker.commands.mutate.judge import judge
from rovercheck.checker.commands.mutate.results import MutationResults, One
from rovercheck.checker.commands.mutate.text import report
from rovercheck.checker.commands.shared.codes import Exit, UsageError
from rovercheck.checker.commands.shared.output import counted, err, out, wrapped, write
from rovercheck.checker.commands.shared.select import pick
from rovercheck.checker.commands.shared.tables import listed
from rovercheck.checker.engines import Limits
from rovercheck.checker.io.printable import json_text
from rovercheck.checker.model import Model
from rovercheck.checker.model.kept_invariants import invariants_of
from rovercheck.checker.model.kept_runs import MUTANTS, KeptRun, file_of, read, text
from rovercheck.checker.mutate.fate import Fate
from rovercheck.checker.mutate.mutants import Mutant, mutants
from rovercheck.checker.mutate.plan import homes
from rovercheck.checker.mutate.relevance import as_it_is
from rovercheck.checker.verify.searches import SearchSettings
from rovercheck.spec_model.lang.chart import parts
from rovercheck.spec_model.lang.system import System

# --- which properties constrain each transition, action, wire and initial value -----------------------------

FAULTY = (Fate.KILLED, Fate.SURVIVOR, Fate.UNKNOWN, Fate.NOTICED)
"""What becomes of a mutant that is not known to behave like the original."""


@dataclass(frozen=True)
class Site:
    """A place in a chart or block: ``Relay/arrow/B1_actuating.1``, with the fates of its mutants."""

    name: str
    judged: tuple[One, ...]

    @property
    def killers(self) -> tuple[str, ...]:
        """The properties that notice a fault there, those first that notice most."""
        ids = [judged.killer for _, _, judged in self.judged if judged.fate is Fate.KILLED]
        return tuple(sorted(set(ids), key=lambda id: (-ids.count(id), id)))

    @property
    def counts(self) -> str:
        """``3 of 4 killed``; what behaves like the original, or is no chart, is not counted."""
        faults = [judged.fate for _, _, judged in self.judged if judged.fate in FAULTY]
        return f"{faults.count(Fate.KILLED)} of {len(faults)} killed" if faults else "no fault"

    @property
    def by(self) -> str:
        """The killers, or that there is none though something can go wrong."""
        return ", ".join(self.killers) or ("-" if self.counts == "no fault" else "NO PROPERTY")


def sites(found: MutationResults) -> Iterator[Site]:
    """The places in the order in which faults were made."""
    by: dict[str, list[One]] = {}
    for one in found.judged:
        by.setdefault(one[1].id.rpartition("/")[0], []).append(one)
    return (Site(name, tuple(told)) for name, told in by.items())


def mutate(model: Model, wanted: MutateOptions, limits: Limits, as_json: bool) -> Exit:
    """Judge the mutants of a model, and tell what becomes of each.

    Raises ``UsageError`` for an unknown system, or where what is found cannot be kept, ``ModelError`` where
    the model has no meaning.
    """
    if wanted.record_mutants:
        recordable(model, "", MUTANTS)
    properties = [p for p in model.stated().values() if not p.costly]
    at_home = _homes(model, wanted, {p.on for p in properties})
    if not any(p.on in at_home for p in properties):
        err.print("Nothing to check: no property is about what was selected.")
        return Exit.NOTHING
    made = todo = _chosen(model.systems, at_home, wanted)
    named = wanted.about if wanted.about and not wanted.part else tuple(at_home)
    found = MutationResults(named, len(todo), seed=None if wanted.sample is None else wanted.seed)
    if wanted.sample is not None and wanted.sample < len(todo):
        kept = sorted(Random(wanted.seed).sample(range(len(todo)), wanted.sample))
        todo = [todo[number] for number in kept]
    found.chosen = len(todo)
    code = Exit.INTERRUPTED
    try:
        search = SearchSettings(
            limits=limits, jobs=wanted.scheduler or wanted.jobs, invariants=invariants_of(model)
        )
        judge(model, properties, todo, search, wanted.alone, found)
        code = found.code
    except KeyboardInterrupt:
        err.print(f"Interrupted: {len(found.judged)} of {found.chosen} mutants judged.")
    if wanted.record_mutants:
        _record(model, found, {mutant.id for _, mutant in made}, wanted.alone)
    if as_json:
        from rovercheck.checker.commands.mutate.document import document

        print(json_text(document(found, code), ascii=True))
    else:
        if wanted.by_place:
            rows = [(site.name, site.counts, site.by) for site in sites(found)]
            listed(("place", "faults", "constrained by"), rows)
            out.print()
        for text, indent in report(found):
            out.print(wrapped(text, indent), markup=False)
    return code


def _record(model: Model, found: MutationResults, made: Collection[str], alone: bool) -> None:
    """Keep the runs by which searches killed mutants.

    What is recorded stays, but for mutants that no run kills, if not only properties of some systems were
    asked (``alone``), and those of the same parts that are not ``made`` any more.
    """
    place, parts_of = file_of(model, MUTANTS), {id.partition("/")[0] for id in made}
    rows = {
        mutant.id: KeptRun(judged.on, judged.run)
        for _, mutant, judged in found.judged
        if judged.fate is Fate.KILLED and judged.run is not None and mutant.id in found.searched
    }
    judged_so = () if alone else found.judged
    alive = {mutant.id for _, mutant, judged in judged_so if judged.fate not in (Fate.KILLED, Fate.UNKNOWN)}
    known = {
        id: row
        for id, row in read(place, MUTANTS).items()
        if id not in alive and (id in made or id.partition("/")[0] not in parts_of)
    }
    write(text({**known, **rows}, MUTANTS), place)
    err.print(f"{counted(len(rows), 'run is', 'runs are')} recorded that searches found now.")


def _homes(model: Model, wanted: MutateOptions, stated: Collection[str]) -> dict[str, list[str]]:
    """The parts to make faulty by the system in which each is judged first: the smallest with properties.

    That is one of the systems named, if properties of no other count.
    """
    systems = {name: pick("system", name, model.systems) for name in wanted.about}
    known = {p.name: p for system in model.systems.values() for p in parts(system.components)}
    chosen = {pick("chart or block", name, known).name for name in wanted.part} or known.keys()
    if systems:
        chosen = chosen & {p.name for system in systems.values() for p in parts(system.components)}
    among = [name for name in model.systems if name in stated]
    if wanted.alone and systems:
        among = list(systems)
    inside = homes(model.systems, dict.fromkeys([*among, *systems]), chosen)
    return {name: names for name, names in inside.items() if names}


def _chosen(
    systems: Mapping[str, System], at_home: Mapping[str, Sequence[str]], wanted: MutateOptions
) -> list[tuple[str, Mutant]]:
    if wanted.sample is not None and wanted.sample < 1:
        raise UsageError("--sample takes a number of mutants, at least 1.")
    return [
        (name, mutant)
        for name, inside in at_home.items()
        for mutant in mutants(as_it_is(systems[name]), inside)
    ]


__all__ = ["MutationResults", "mutate"]
