"""Which mutants are made, and which properties are asked about each, in which systems."""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field

from checker.mutate.asked import Cone, as_it_is, concerned, cones
from checker.mutate.judging import Case
from checker.mutate.mutants import Mutant, mutants
from properties.forms import Property, formulas
from spec_model.lang.chart import parts
from spec_model.lang.system import System
from spec_model.lang.walk import variables


@dataclass(frozen=True)
class Planned:
    """A mutant, and the cases in which it is looked at, its own system first."""

    mutant: Mutant
    cases: tuple[Case, ...]


@dataclass
class Plan:
    """What is known of systems and properties; ``proved`` holds what was found out of the originals.

    ``recorded`` tells of a property whether it is proved, as far as that is on record, None if it is neither
    proved nor violated.
    """

    systems: Mapping[str, System]
    properties: Sequence[Property]
    proved: Mapping[str, bool]
    recorded: Mapping[str, bool | None]
    _cones: dict[str, list[Cone]] = field(default_factory=dict)
    _mutants: dict[tuple[str, str], dict[str, Mutant]] = field(default_factory=dict)

    def own(self, mutant: Mutant, name: str) -> Planned:
        """The mutant of the system of that name, in this system."""
        return Planned(mutant, (self._case(mutant, name, sure=True),))

    def elsewhere(self, mutant: Mutant, name: str) -> Planned:
        """The same fault in all other systems with the part, those with the smallest cones first."""
        found: list[tuple[int, Case]] = []
        for other in self.systems:
            if other == name or not self._stated(other) or not self._has(other, mutant.parts):
                continue
            same = self._made(other, mutant.part).get(mutant.id)
            if same is not None and same.text == mutant.text:
                case = self._case(same, other, sure=False)
                if case.properties:
                    first = next(c.bits for c in self._known(other) if c.property.id == case.properties[0].id)
                    found.append((first, case))
        return Planned(mutant, tuple(case for _, case in sorted(found, key=lambda pair: pair[0])))

    def _case(self, mutant: Mutant, name: str, sure: bool) -> Case:
        original = as_it_is(self.systems[name])
        proved = {p.id: self.proved.get(p.id, self.recorded[p.id]) for p in self._stated(name)}
        known = {
            id: is_so for id, is_so in proved.items() if is_so is not None and (id in self.proved or not sure)
        }
        asked = concerned({name: self._known(name)}, original, mutant.system, mutant.parts)
        properties = tuple(c.property for c in asked if c.property.id in known)
        named = frozenset(n for p in self._stated(name) for n in variables(*formulas(p.form)))
        return Case(original, mutant.system, mutant.parts, properties, known, sure, named)

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


def homes(systems: Mapping[str, System], named: Collection[str]) -> dict[str, list[str]]:
    """For each system the parts that are made faulty in it: each in the smallest named system that has it."""
    sizes = {name: len(list(parts(systems[name].components))) for name in named}
    home: dict[str, str] = {}
    for name in sorted(sizes, key=lambda n: sizes[n]):
        for part in parts(systems[name].components):
            home.setdefault(part.name, name)
    return {name: [part for part, at in home.items() if at == name] for name in named}


__all__ = ["Plan", "Planned", "homes"]
