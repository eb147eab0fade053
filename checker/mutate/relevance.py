"""Which properties can notice a fault of a part, the cheapest first."""

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from rovercheck.checker.mutate.product import same
from rovercheck.checker.mutate.wiring import written_by
from rovercheck.checker.system.cone import depends_on
from rovercheck.checker.system.lowering_cache import lowered
from rovercheck.properties.forms import Property
from rovercheck.spec_model.lang.action import writes
from rovercheck.spec_model.lang.chart import parts
from rovercheck.spec_model.lang.system import System, TransitionSystem


@dataclass(frozen=True)
class Cone:
    """What the verdict on a property depends on: the names that its slice writes, and the bits it stores."""

    property: Property
    written: frozenset[str]
    bits: int


def as_it_is(system: System) -> System:
    """The system, of which every run counts, also one that a system with fewer runs does not have."""
    return replace(system, over=False, concrete="")


def changed(
    original: TransitionSystem, mutant: TransitionSystem, properties: Sequence[Property]
) -> Iterator[Property]:
    """The properties whose slices are not written alike in both; of the others the verdicts are the same."""
    for prop in properties:
        if not same(depends_on(original, prop), depends_on(mutant, prop)):
            yield prop


def cones(system: System, properties: Sequence[Property]) -> list[Cone]:
    """The cone of influence of each property of a system, the smallest first."""
    found: list[Cone] = []
    whole = lowered(system)
    for prop in properties:
        part = depends_on(whole, prop)
        bits = sum((len(v.domain) - 1).bit_length() for v in part.variables)
        found.append(Cone(prop, frozenset(writes(part.step)), bits))
    return sorted(found, key=lambda cone: (cone.bits, cone.property.id))


def concerned(
    known: Mapping[str, Sequence[Cone]], original: System, mutant: System, names: Collection[str]
) -> list[Cone]:
    """The properties of a system whose cone holds what some parts write, in the original or the mutant."""
    own = {
        n for s in (original, mutant) for p in parts(s.components) if p.name in names for n in written_by(p)
    }
    return [cone for cone in known[original.name] if cone.written & own]


__all__ = ["Cone", "as_it_is", "changed", "concerned", "cones", "depends_on"]
