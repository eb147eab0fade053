"""All mutants of a system, each with an id, its place and a sentence."""

from collections import Counter
from collections.abc import Callable, Collection, Iterator
from dataclasses import dataclass, field, replace
from functools import cached_property, partial

from rovercheck.checker.mutate.charts import block_faults, chart_faults
from rovercheck.checker.mutate.wiring import Wrong, kept, wiring_faults
from rovercheck.spec_model.lang.chart import Block, Chart, parts
from rovercheck.spec_model.lang.edit import in_system
from rovercheck.spec_model.lang.place import Place
from rovercheck.spec_model.lang.system import System


@dataclass(frozen=True, eq=False)
class Mutant:
    """A system with one fault.

    ``id`` is ``Relay/arrow/B1_actuating.1/guard-negated``; ``parts`` names the charts and blocks whose
    behaviour changes, ``meant`` is the guard that belongs to the place, if one does.
    """

    id: str
    operator: str
    text: str
    place: Place | None
    parts: tuple[str, ...]
    meant: str = ""
    make: Callable[[], System] = field(kw_only=True, repr=False)

    @property
    def part(self) -> str:
        """The chart or block in which the fault is."""
        return self.id.partition("/")[0]

    @cached_property
    def system(self) -> System:
        """The faulty system, with every variable of the original one."""
        return self.make()


def mutants(system: System, only: Collection[str] | None = None) -> list[Mutant]:
    """Every first-order mutant of a system, part by part; only those of some parts, if these are named.

    Ids are the same in every system that has the part.
    """
    seen: Counter[str] = Counter()
    found: list[Mutant] = []
    for one in _unnumbered(system, only):
        seen[one.id] += 1
        found.append(replace(one, id=f"{one.id}#{seen[one.id]}") if seen[one.id] > 1 else one)
    order = {part.name: number for number, part in enumerate(parts(system.components))}
    return sorted(found, key=lambda m: order[m.part])


def _unnumbered(system: System, only: Collection[str] | None) -> Iterator[Mutant]:
    for part in parts(system.components):
        if only is not None and part.name not in only:
            continue
        step_ms = system.step_ms
        faults = chart_faults(part, step_ms) if isinstance(part, Chart) else block_faults(part, step_ms)
        for f in faults:
            id, made = f"{part.name}/{f.site}/{f.operator}", _made(system, part, f.part)
            yield Mutant(id, f.operator, f.text, f.place, (part.name,), f.meant, make=made)
    for wrong in wiring_faults(system, only):
        id, made = f"{wrong.site}/{wrong.operator}", partial(_kept, system, wrong)
        yield Mutant(id, wrong.operator, wrong.text, wrong.place, wrong.concerned, make=made)


def _kept(system: System, wrong: Wrong) -> System:
    return kept(system, wrong.make())


def _made(system: System, old: Chart | Block, new: Chart | Block) -> Callable[[], System]:
    def made() -> System:
        changed = in_system(system, old.name, lambda _: new)
        nothing_lost = old.written.keys() <= new.written.keys() and old.read.keys() <= new.read.keys()
        return changed if nothing_lost else kept(system, changed)

    return made


__all__ = ["Mutant", "mutants"]
