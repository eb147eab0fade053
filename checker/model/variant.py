"""What is checked instead of the charts as specified: other interpretations, a repair, fewer assumptions.

It may also be a model of the user's own, which has no interpretations and no repairs.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from shlex import quote
from typing import TYPE_CHECKING, Protocol

from rovercheck.checker.model import Model, names_of
from rovercheck.checker.model.rover import rover
from rovercheck.properties.catalogue import read_by
from rovercheck.properties.expected import Expected
from rovercheck.properties.forms import Property, formulas
from rovercheck.spec_model.ambiguity import fixed
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.expr import Var
from rovercheck.spec_model.lang.redeclare import Redeclarer
from rovercheck.spec_model.lang.system import System
from rovercheck.spec_model.lang.walk import variables
from rovercheck.spec_model.repairs import Repair, repaired, touches
from rovercheck.spec_model.rover import systems

if TYPE_CHECKING:
    from rovercheck.spec_model.abstraction import Board


class SystemChanges(Protocol):
    """Changes of charts that some implementation was found to have."""

    @property
    def name(self) -> str:
        """``with variant.toml``, and what no system has of it."""

    @property
    def board_name(self) -> str:
        """``with variant.toml``: a whole board has all of it."""

    @property
    def options(self) -> str:
        """The option that makes a command be about the same charts."""

    @property
    def rows(self) -> tuple[tuple[str, ...], ...]:
        """The board that they are of, then each change as it is written."""

    def applied(self, board: "Board") -> "Board":
        """A board with those that are of it."""

    def touches(self, system: System) -> bool:
        """Whether one of them concerns a system."""

    def changed(self, system: System) -> System:
        """The system with them.  Raises ``ModelError`` where one cannot be made."""

    def notes(self) -> Iterator[str]:
        """Where they come from, and what no system shows of them."""


@dataclass(frozen=True)
class Variant:
    """Chosen interpretations, at most one repair, dropped assumptions; none means the charts as specified.

    ``own`` is the user's own model, None for the rover; ``changes`` are made last.
    """

    choices: Mapping[str, str]
    repair: Repair | None = None
    without: frozenset[str] = frozenset()
    own: Model | None = None
    changes: SystemChanges | None = None

    @property
    def model(self) -> Model:
        """What is changed: the user's own model, or the rover under the chosen interpretations."""
        return rover(self.choices) if self.own is None else self.own

    @property
    def name(self) -> str:
        """``under S43=AND with safety-critical-first``; empty for the charts as specified."""
        return self._named(self.changes.name if self.changes else "")

    @property
    def board_name(self) -> str:
        """As ``name``, of a whole board, which also has the changes that no system shows."""
        return self._named(self.changes.board_name if self.changes else "")

    def _named(self, changed: str) -> str:
        chosen = ", ".join(f"{id}={choice}" for id, choice in self.choices.items())
        repair = f"with {self.repair.name}" if self.repair else ""
        dropped = f"without {', '.join(sorted(self.without))}" if self.without else ""
        return " ".join(part for part in (chosen and f"under {chosen}", repair, dropped, changed) if part)

    @property
    def options(self) -> str:
        """What makes a command be about the same charts: ``--interpret S43=AND``, ``--model heater.py``."""
        given = [("--interpret", f"{id}={choice}") for id, choice in self.choices.items()]
        given += [("--repair", self.repair.name)] if self.repair else []
        given += [("--without", assumption) for assumption in sorted(self.without)]
        options = [f"{option} {quote(value)}" for option, value in given]
        changed = self.changes.options if self.changes else ""
        return " ".join(filter(None, [*options, changed, self.model.options]))

    def unchanged(self) -> Mapping[str, System]:
        """Every system by name, under the chosen interpretations alone."""
        return systems(self.choices) if self.own is None else self.own.systems

    def systems(self) -> Mapping[str, System]:
        """Every system by name, changed; one in which a change cannot be made raises ``ModelError``."""
        return self._systems

    @cached_property
    def _systems(self) -> Mapping[str, System]:
        found = self._repaired()
        return found if self.changes is None else _ChangedSystems(found, self.changes)

    def _repaired(self) -> Mapping[str, System]:
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
            edited = edited or (self.changes is not None and self.changes.touches(system))
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
        asked, left = list[Property](), list[str]()
        unmade: dict[str, list[str]] = {}
        for prop in properties:
            try:
                system = self._decided_on(prop.on)
            except ModelError as error:
                unmade.setdefault(str(error), []).append(prop.id)
                continue
            missing = sorted(_named(prop) - names_of(system))
            if missing:
                left.append(f"{prop.id} is left out: {self.name}, {prop.on} has no {', '.join(missing)}.")
            else:
                asked.append(self.asked(prop))
        left += [
            f"{', '.join(ids)} {'are' if ids[1:] else 'is'} left out: {why}" for why, ids in unmade.items()
        ]
        return asked, left

    def asked(self, prop: Property) -> Property:
        """A property as it is asked of its changed system.

        Raises ``ModelError`` where a change cannot be made there.
        """
        return prop if self.changes is None else as_declared(prop, self.systems()[prop.on])

    def _decided_on(self, name: str) -> System:
        """A changed system, also where a run on it is reproduced on another one.

        Raises ``ModelError`` where a change cannot be made in one of them.
        """
        system = self.systems()[name]
        if system.concrete in self.systems():
            self._decided_on(system.concrete)
        return system

    def expected(self, id: str) -> Expected:
        """The verdict to compare with: what the repair promises, else the verdict on record."""
        if self.repair is not None and id in self.repair.fixes:
            return Expected()
        if self.repair is not None and id in self.repair.gives_up:
            return Expected("violated", None, self.repair.gives_up[id])
        return self.model.expected(id)


def as_declared(prop: Property, system: System) -> Property:
    """A property of the variables as a system declares them: changed charts may need wider domains."""
    there = {**system.inputs, **system.written}
    anew = [there[n] for n, v in _variables(prop).items() if n in there and there[n].domain != v.domain]
    return replace(prop, form=Redeclarer(anew).parts_of(prop.form)) if anew else prop


class _ChangedSystems(Mapping[str, System]):
    """Systems by name, each changed when it is first asked for.

    One in which a change cannot be made is not listed; asking for it raises ``ModelError`` with the reason.
    """

    def __init__(self, drawn: Mapping[str, System], changes: SystemChanges) -> None:
        self._drawn, self._changes = drawn, changes
        self._made: dict[str, System | ModelError] = {}

    def __getitem__(self, name: str) -> System:
        made = self._changed(name)
        if isinstance(made, ModelError):
            raise made
        return made

    def _changed(self, name: str) -> System | ModelError:
        if name not in self._made:
            drawn = self._drawn[name]
            try:
                self._made[name] = self._changes.changed(drawn)
            except ModelError as error:
                self._made[name] = error
        return self._made[name]

    def __iter__(self) -> Iterator[str]:
        return (name for name in self._drawn if isinstance(self._changed(name), System))

    def __len__(self) -> int:
        return sum(1 for _ in self)


def _variables(prop: Property) -> dict[str, Var]:
    return variables(*formulas(prop.form))


def _named(prop: Property) -> set[str]:
    return set(_variables(prop))
