"""Which mutants are made, and which properties are asked about each, in which systems."""

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

from rovercheck.checker.mutate.fate import Fate, MutantCase, MutantFate
from rovercheck.checker.mutate.mutants import Mutant, mutants
from rovercheck.checker.mutate.relevance import Cone, as_it_is, concerned, cones
from rovercheck.checker.mutate.tries import ROUNDS, RandomRuns, tried
from rovercheck.checker.results.verdict import Proved, Run, Unknown
from rovercheck.checker.verify.result import Result
from rovercheck.checker.verify.runs.known_runs import run_of
from rovercheck.checker.verify.tasks import Task
from rovercheck.properties.forms import Property, formulas
from rovercheck.spec_model.lang.chart import parts
from rovercheck.spec_model.lang.system import System
from rovercheck.spec_model.lang.walk import variables

PROVERS = ("kinduction", "pdr")
"""Engines that also look for short runs as they look for a proof: what they proved of the original, they are
asked about a mutant at once."""
SMALL = 200
"""Bits (``Task.size``) of a system in which runs are tried early: lowering a larger one takes longer."""
KILLERS = 3
"""Runs kept of each property that kills mutants of a system."""


@dataclass(frozen=True)
class PlannedMutant:
    """A mutant, and the cases in which it is looked at, its own system first."""

    mutant: Mutant
    cases: tuple[MutantCase, ...]


@dataclass
class Plan:
    """What is known of systems and properties.

    ``recorded`` tells of a property whether it is proved, as far as that is recorded, None if it is neither
    proved nor violated; ``proved`` and ``runs`` hold what was found out of the originals, ``killers`` the
    runs that kill mutants of a system, by property, ``engines`` what proved a property of the original, and
    ``on_record`` runs of a system that are tried on every mutant.
    """

    systems: Mapping[str, System]
    properties: Sequence[Property]
    recorded: Mapping[str, bool | None]
    proved: dict[str, bool] = field(default_factory=dict)
    runs: dict[str, Run] = field(default_factory=dict)
    killers: dict[str, dict[str, list[Run]]] = field(default_factory=dict)
    engines: dict[str, str] = field(default_factory=dict)
    on_record: Mapping[str, Sequence[Run]] = field(default_factory=dict)
    _tries: dict[str, tuple[Run, ...]] = field(default_factory=dict)
    _cones: dict[str, list[Cone]] = field(default_factory=dict)
    _read_abroad: dict[str, frozenset[str]] = field(default_factory=dict)
    _mutants: dict[tuple[str, str], dict[str, Mutant]] = field(default_factory=dict)

    def learn(self, result: Result) -> None:
        """Keep a verdict on an original, and the run that it rests on."""
        if not isinstance(result.verdict, Unknown):
            self.proved[result.property.id] = isinstance(result.verdict, Proved)
        if isinstance(result.verdict, Proved) and result.verdict.engine in PROVERS:
            self.engines[result.property.id] = result.verdict.engine
        if (run := run_of(result.verdict)) is not None:
            self.runs[result.property.id] = run

    def kills(self, judged: MutantFate) -> None:
        """Keep the run that kills a mutant, unless enough are known that violate the same."""
        if judged.fate is Fate.KILLED and judged.run is not None:
            known = self.killers.setdefault(judged.on, {}).setdefault(judged.killer, [])
            if len(known) < KILLERS and judged.run not in known:
                known.append(judged.run)

    def own(self, mutant: Mutant, name: str) -> PlannedMutant:
        """The mutant of the system of that name, in this system."""
        return PlannedMutant(mutant, (self._case(mutant, name, sure=True),))

    def nearby(self) -> list[str]:
        """The small systems with properties, the smallest first."""
        bits = {name: Task(of, ()).size for name, of in self.systems.items() if self._stated(name)}
        return sorted((name for name in bits if bits[name] <= SMALL), key=lambda name: bits[name])

    def tried_in(self, name: str, mutant: Mutant, home: str) -> PlannedMutant | None:
        """The same fault in another system, whose expected verdicts are taken for granted until something
        kills; None if the system has it not, or is its home."""
        if name == home or not self._has(name, mutant.parts):
            return None
        same = self._made(name, mutant.part).get(mutant.id)
        if same is None or same.text != mutant.text:
            return None
        known = {p.id: self.proved.get(p.id, self.recorded[p.id]) for p in self._stated(name)}
        proved = {id: is_so for id, is_so in known.items() if is_so is not None}
        properties = tuple(p for p in self._stated(name) if p.id in proved)
        original = as_it_is(self.systems[name])
        return PlannedMutant(mutant, (MutantCase(original, same.system, same.parts, properties, proved),))

    def elsewhere(self, mutant: Mutant, name: str) -> PlannedMutant:
        """The same fault in all other systems with the part, those with the smallest cones first."""
        found: list[tuple[int, MutantCase]] = []
        for other in self.systems:
            if other == name or not self._stated(other) or not self._has(other, mutant.parts):
                continue
            same = self._made(other, mutant.part).get(mutant.id)
            if same is not None and same.text == mutant.text:
                case = self._case(same, other, sure=False)
                if case.properties:
                    first = next(c.bits for c in self._known(other) if c.property.id == case.properties[0].id)
                    found.append((first, case))
        return PlannedMutant(mutant, tuple(case for _, case in sorted(found, key=lambda pair: pair[0])))

    def with_runs(self, planned: PlannedMutant, drawn: bool = True) -> PlannedMutant:
        """The same with the runs that are known by now, also with runs ``drawn`` at random."""
        cases = (
            replace(
                c,
                runs=self._runs(c.properties),
                killers=self._killers(c.original.name),
                tries=self._tried(c.original) if drawn else self._listed(c.original.name),
                engines=self._engines(c.properties),
            )
            for c in planned.cases
        )
        return replace(planned, cases=tuple(cases))

    def _runs(self, properties: Sequence[Property]) -> dict[str, Run]:
        return {p.id: self.runs[p.id] for p in properties if p.id in self.runs}

    def _engines(self, properties: Sequence[Property]) -> dict[str, str]:
        return {p.id: self.engines[p.id] for p in properties if p.id in self.engines}

    def _killers(self, name: str) -> tuple[Run, ...]:
        return tuple(run for runs in self.killers.get(name, {}).values() for run in runs)

    def _tried(self, original: System) -> tuple[Run, ...]:
        """Recorded runs of a system, and random runs."""
        name = original.name
        if name not in self._tries:
            self._tries[name] = (*self._listed(name), *RandomRuns(original).from_the_start())
        return self._tries[name]

    def _listed(self, name: str) -> tuple[Run, ...]:
        return tuple(tried(self.on_record.get(name, ())))

    def _case(self, mutant: Mutant, name: str, sure: bool) -> MutantCase:
        original = as_it_is(self.systems[name])
        proved = {p.id: self.proved.get(p.id, self.recorded[p.id]) for p in self._stated(name)}
        known = {
            id: is_so for id, is_so in proved.items() if is_so is not None and (id in self.proved or not sure)
        }
        asked = concerned({name: self._known(name)}, original, mutant.system, mutant.parts)
        properties = tuple(c.property for c in asked if c.property.id in known)
        return MutantCase(
            original, mutant.system, mutant.parts, properties, known, sure,
            self._named, self._abroad(original), self._runs(properties),
        )  # fmt: skip

    @cached_property
    def _named(self) -> frozenset[str]:
        """What the properties of any system speak of."""
        return frozenset(n for p in self.properties for n in variables(*formulas(p.form)))

    def _abroad(self, original: System) -> frozenset[str]:
        """What parts read that other systems have, and this one has not; but no bookkeeping of the model."""
        if original.name not in self._read_abroad:
            own = {part.name for part in parts(original.components)}
            others = (part for system in self.systems.values() for part in parts(system.components))
            self._read_abroad[original.name] = frozenset(
                n for part in others if part.name not in own for n, v in part.read.items() if not v.hidden
            )
        return self._read_abroad[original.name]

    def _stated(self, name: str) -> list[Property]:
        return [p for p in self.properties if p.on == name]

    def _known(self, name: str) -> list[Cone]:
        if name not in self._cones:
            self._cones[name] = cones(as_it_is(self.systems[name]), self._stated(name))
        return self._cones[name]

    def _has(self, name: str, wanted: Sequence[str]) -> bool:
        return set(wanted) <= {p.name for p in parts(self.systems[name].components)}

    def _made(self, name: str, part: str) -> dict[str, Mutant]:
        if (name, part) not in self._mutants:
            self._mutants[name, part] = {m.id: m for m in mutants(as_it_is(self.systems[name]), [part])}
        return self._mutants[name, part]


def rounds(planned: Sequence[PlannedMutant]) -> Iterator[Sequence[PlannedMutant]]:
    """A few from everywhere first: what kills them is tried on the next ones before anything is searched."""
    left = list(planned)
    for every in ROUNDS:
        if left:
            yield left[::every]
            left = [one for number, one in enumerate(left) if number % every]


def homes(
    systems: Mapping[str, System], among: Collection[str], wanted: Collection[str] | None = None
) -> dict[str, list[str]]:
    """For each system the parts that are made faulty in it: each in the smallest of ``among`` that has it.

    A system with fewer runs is the last choice, for what changes nothing in it may change other runs; so is
    one whose steps differ in length, for most properties are about others.  Only the ``wanted`` parts, if
    these are named.
    """

    def liking(name: str) -> tuple[bool, bool, int]:
        system = systems[name]
        return system.under, system.elapsed is not None, len(list(parts(system.components)))

    home: dict[str, str] = {}
    for name in sorted(among, key=liking):
        for part in parts(systems[name].components):
            if wanted is None or part.name in wanted:
                home.setdefault(part.name, name)
    return {name: [part for part, at in home.items() if at == name] for name in among}


__all__ = ["Plan", "PlannedMutant", "homes", "rounds"]
