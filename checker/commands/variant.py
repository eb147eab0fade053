"""What is checked instead of the charts as specified: other readings, a repair, fewer assumptions."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from checker.certifying import Certifying
from checker.commands.codes import UsageError
from checker.commands.output import err
from checker.commands.select import pick
from properties.catalogue import Expected, expected, read_by, under
from properties.forms import Property, formulas
from spec_model.lang.system import Assumption, System
from spec_model.lang.walk import variables
from spec_model.readings import ANY, fixed, readings
from spec_model.repairs import Repair, proposals, repaired, touches
from spec_model.rover import systems


@dataclass(frozen=True)
class Variant:
    """Chosen readings, at most one repair, dropped assumptions; none means the charts as specified."""

    choices: Mapping[str, str]
    repair: Repair | None = None
    without: frozenset[str] = frozenset()

    @property
    def name(self) -> str:
        """``under S43=AND with safety-critical-first``; empty for the charts as specified."""
        chosen = ", ".join(f"{id}={choice}" for id, choice in self.choices.items())
        repair = f"with {self.repair.name}" if self.repair else ""
        dropped = f"without {', '.join(sorted(self.without))}" if self.without else ""
        return " ".join(part for part in (chosen and f"under {chosen}", repair, dropped) if part)

    def systems(self) -> Mapping[str, System]:
        """Every system by name, changed."""
        if not self.without and self.repair is None:
            return systems(self.choices)
        found = {name: system.without(self.without) for name, system in systems(self.choices).items()}
        if self.repair is None:
            return found
        fixing = fixed(self.choices)
        return {name: fixing.system(repaired(system, self.repair)) for name, system in found.items()}

    def properties(self) -> dict[str, Property]:
        """Every property by id, under the chosen readings."""
        return under(self.choices)

    def concerns(self) -> Callable[[Property], bool]:
        """Whether the variant can change the verdict on a property."""
        by_name = systems(self.choices)

        def concerned(prop: Property) -> bool:
            system = by_name[prop.on]
            edited = self.repair is not None and touches(system, self.repair)
            freed = not self.without.isdisjoint(a.id for a in system.assumptions)
            return edited or freed or not self.choices.keys().isdisjoint(read_by(prop))

        return concerned

    def askable(self, properties: Sequence[Property]) -> list[Property]:
        """The properties that speak of what the changed systems still have; says which do not.

        Under another reading a chart may no longer read or write a variable that a property names.
        """
        by_name = self.systems()
        asked: list[Property] = []
        for prop in properties:
            missing = sorted(_named(prop) - _known(by_name[prop.on]))
            if missing:
                lacks = f"{self.name}, {prop.on} has no {', '.join(missing)}"
                err.print(f"{prop.id} is left out: {lacks}.", markup=False)
            else:
                asked.append(prop)
        return asked

    def certifying(self, folder: Path | None, again: bool) -> Certifying:
        """What to do with the proofs, with a note of how the charts are changed."""
        repair = self.repair.name if self.repair else ""
        return Certifying(folder, again, dict(self.choices), repair, tuple(sorted(self.without)))

    def expected(self, id: str) -> Expected:
        """The verdict to compare with: what the repair promises, else the verdict on record."""
        if self.repair is not None and id in self.repair.fixes:
            return Expected()
        if self.repair is not None and id in self.repair.gives_up:
            return Expected("violated", None, self.repair.gives_up[id])
        return expected(id)


def _named(prop: Property) -> set[str]:
    return set(variables(*formulas(prop.form)))


def _known(system: System) -> set[str]:
    places = {v.name for chart in system.charts for v in (*chart.locations, chart.entered)}
    return places | {v.name for v in system.frozen} | system.written.keys() | system.inputs.keys()


def pick_variant(chosen: Sequence[str], repair: str | None, dropped: Sequence[str]) -> Variant:
    """The variant that the command line asks for.  Raises ``UsageError`` or ``ModelError``."""
    choices = _choices(chosen)
    without = frozenset(pick("assumption", id, _assumptions(choices)).id for id in dropped)
    if repair is None:
        return Variant(choices, None, without)
    found = pick("repair", repair, proposals())
    return Variant({**found.readings, **choices}, found, without)


def _assumptions(choices: Mapping[str, str]) -> dict[str, Assumption]:
    return {a.id: a for system in systems(choices).values() for a in system.assumptions}


def _choices(chosen: Sequence[str]) -> dict[str, str]:
    """Readings and their choices from ``ID=CHOICE``."""
    choices: dict[str, str] = {}
    for text in chosen:
        id, equals, choice = text.partition("=")
        one = pick("reading", id, readings())
        options = [c for c in one.choices if c not in one.not_modelled]
        if not equals or not choice:
            raise UsageError(f"{text!r} names no choice; write {id}= and one of {', '.join(options)}, {ANY}.")
        if choice != ANY:
            one.value(choice)
        choices[id] = choice
    return choices
