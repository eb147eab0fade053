"""What is checked instead of the charts as specified: other interpretations, a repair, fewer assumptions.

It may also be a model of the user's own, which has no interpretations and no repairs.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from shlex import quote

from rovercheck.checker.model import Model, names_of
from rovercheck.checker.model.rover import rover
from rovercheck.properties.catalogue import read_by
from rovercheck.properties.expected import Expected
from rovercheck.properties.forms import Property, formulas
from rovercheck.spec_model.ambiguity import fixed
from rovercheck.spec_model.lang.system import System
from rovercheck.spec_model.lang.walk import variables
from rovercheck.spec_model.repairs import Repair, repaired, touches
from rovercheck.spec_model.rover import systems


@dataclass(frozen=True)
class Variant:
    """Chosen interpretations, at most one repair, dropped assumptions; none means the charts as specified.

    ``own`` is the user's own model, None for the rover.
    """

    choices: Mapping[str, str]
    repair: Repair | None = None
    without: frozenset[str] = frozenset()
    own: Model | None = None

    @property
    def model(self) -> Model:
        """What is changed: the user's own model, or the rover under the chosen interpretations."""
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
        """What makes a command be about the same charts: ``--interpret S43=AND``, ``--model heater.py``."""
        given = [("--interpret", f"{id}={choice}") for id, choice in self.choices.items()]
        given += [("--repair", self.repair.name)] if self.repair else []
        given += [("--without", assumption) for assumption in sorted(self.without)]
        options = [f"{option} {quote(value)}" for option, value in given]
        return " ".join(filter(None, [*options, self.model.options]))

    def unchanged(self) -> Mapping[str, System]:
        """Every system by name, under the chosen interpretations alone."""
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

    def properties(self) -> Mapping[str, Property]:
        """Every property by id, under the chosen interpretations.  Raises ``ModelError`` if there is none."""
        return self.model.stated()

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

    def askable(self, properties: Sequence[Property]) -> tuple[list[Property], list[str]]:
        """The properties that speak of what the changed systems still have; of each other, why not.

        Under another interpretation a chart may no longer read or write a variable that a property names.
        """
        by_name = self.systems()
        asked, left = list[Property](), list[str]()
        for prop in properties:
            missing = sorted(_named(prop) - names_of(by_name[prop.on]))
            if missing:
                left.append(f"{prop.id} is left out: {self.name}, {prop.on} has no {', '.join(missing)}.")
            else:
                asked.append(prop)
        return asked, left

    def expected(self, id: str) -> Expected:
        """The verdict to compare with: what the repair promises, else the verdict on record."""
        if self.repair is not None and id in self.repair.fixes:
            return Expected()
        if self.repair is not None and id in self.repair.gives_up:
            return Expected("violated", None, self.repair.gives_up[id])
        return self.model.expected(id)


def _named(prop: Property) -> set[str]:
    return set(variables(*formulas(prop.form)))
