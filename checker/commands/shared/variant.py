"""What is checked instead of the rover's charts as specified: other readings, a repair, fewer assumptions.

It may also be a model of the user's own, which has no readings and no repairs.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from shlex import quote
from typing import TYPE_CHECKING

from checker.commands.shared.codes import UsageError
from checker.commands.shared.output import err
from checker.commands.shared.select import pick
from checker.model import Model, names_of
from checker.model.load import load
from checker.model.rover import rover
from properties.catalogue import Expected, read_by
from properties.forms import Property, formulas
from spec_model.lang.system import Assumption, System
from spec_model.lang.walk import variables
from spec_model.readings import ANY, fixed, readings
from spec_model.repairs import Repair, proposals, repaired, touches
from spec_model.rover import systems

if TYPE_CHECKING:
    from checker.verify.certificates import Certification


@dataclass(frozen=True)
class Variant:
    """Chosen readings, at most one repair, dropped assumptions; none means the charts as specified.

    ``own`` is the user's own model, None for the rover.
    """

    choices: Mapping[str, str]
    repair: Repair | None = None
    without: frozenset[str] = frozenset()
    own: Model | None = None

    @property
    def model(self) -> Model:
        """What is changed: the user's own model, or the rover under the chosen readings."""
        return rover(self.choices) if self.own is None else self.own

    @property
    def name(self) -> str:
        """``under S43=AND with safety-critical-first``; empty for the charts as specified."""
        chosen = ", ".join(f"{id}={choice}" for id, choice in self.choices.items())
        repair = f"with {self.repair.name}" if self.repair else ""
        dropped = f"without {', '.join(sorted(self.without))}" if self.without else ""
        return " ".join(part for part in (chosen and f"under {chosen}", repair, dropped) if part)

    @property
    def options(self) -> str:
        """What a command needs to be about the same charts: ``--reading S43=AND``, ``--model heater.py``."""
        given = [("--reading", f"{id}={choice}") for id, choice in self.choices.items()]
        given += [("--repair", self.repair.name)] if self.repair else []
        given += [("--without", assumption) for assumption in sorted(self.without)]
        options = [f"{option} {quote(value)}" for option, value in given]
        return " ".join(filter(None, [*options, self.model.options]))

    def unchanged(self) -> Mapping[str, System]:
        """Every system by name, under the chosen readings alone."""
        return systems(self.choices) if self.own is None else self.own.systems

    def systems(self) -> Mapping[str, System]:
        """Every system by name, changed."""
        if not self.without and self.repair is None:
            return self.unchanged()
        found = {name: system.without(self.without) for name, system in self.unchanged().items()}
        if self.repair is None:
            return found
        fixing = fixed(self.choices)
        edited = {name: repaired(system, self.repair) for name, system in found.items()}
        return {n: s if s is found[n] else fixing.system(s) for n, s in edited.items()}

    def properties(self) -> dict[str, Property]:
        """Every property by id, under the chosen readings.  Raises ``ModelError`` if there is none."""
        return dict(self.model.stated())

    def concerns(self) -> Callable[[Property], bool]:
        """Whether the variant can change the verdict on a property."""
        by_name = self.unchanged()

        def concerned(prop: Property) -> bool:
            system = by_name[prop.on]
            edited = self.repair is not None and touches(system, self.repair)
            freed = not self.without.isdisjoint(a.id for a in system.assumptions)
            return edited or freed or (self.own is None and bool(self.choices.keys() & read_by(prop)))

        return concerned

    def promised(self) -> list[Property]:
        """What the repair repairs, also what takes long."""
        return [self.properties()[id] for id in self.repair.fixes] if self.repair else []

    def askable(self, properties: Sequence[Property]) -> list[Property]:
        """The properties that speak of what the changed systems still have; says which do not.

        Under another reading a chart may no longer read or write a variable that a property names.
        """
        by_name = self.systems()
        asked: list[Property] = []
        for prop in properties:
            missing = sorted(_named(prop) - names_of(by_name[prop.on]))
            if missing:
                lacks = f"{self.name}, {prop.on} has no {', '.join(missing)}"
                err.print(f"{prop.id} is left out: {lacks}.", markup=False)
            else:
                asked.append(prop)
        return asked

    def certifying(self, folder: Path | None, again: bool) -> "Certification":
        """What to do with the proofs, with a note of how the charts are changed."""
        from checker.verify.certificates import Certification

        repair = self.repair.name if self.repair else ""
        return Certification(folder, again, dict(self.choices), repair, tuple(sorted(self.without)))

    def expected(self, id: str) -> Expected:
        """The verdict to compare with: what the repair promises, else the expected verdict."""
        if self.repair is not None and id in self.repair.fixes:
            return Expected()
        if self.repair is not None and id in self.repair.gives_up:
            return Expected("violated", None, self.repair.gives_up[id])
        return self.model.expected(id)


def _named(prop: Property) -> set[str]:
    return set(variables(*formulas(prop.form)))


def pick_variant(
    chosen: Sequence[str], repair: str | None, dropped: Sequence[str], path: Path | None = None
) -> Variant:
    """The variant that the command line asks for, of the rover or of the model at a path.

    Raises ``UsageError`` or ``ModelError``.
    """
    if path is not None:
        return _own(load(path), chosen, repair, dropped)
    choices = _choices(chosen)
    without = _dropped(dropped, systems(choices))
    if repair is None:
        return Variant(choices, None, without)
    found = pick("repair", repair, proposals())
    return Variant({**found.readings, **choices}, found, without)


def _own(model: Model, chosen: Sequence[str], repair: str | None, dropped: Sequence[str]) -> Variant:
    for option in ["--reading"] * bool(chosen) + ["--repair"] * (repair is not None):
        raise UsageError(f"{option} changes the rover's charts, and {model.name} is a model of your own.")
    return Variant({}, None, _dropped(dropped, model.systems), model)


def _dropped(ids: Sequence[str], by_name: Mapping[str, System]) -> frozenset[str]:
    if not ids:
        return frozenset()
    known: dict[str, Assumption] = {a.id: a for s in by_name.values() for a in s.assumptions}
    return frozenset(pick("assumption", id, known).id for id in ids)


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
