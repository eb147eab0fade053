"""Which finding is graver, as hazards and requirements say."""

import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property

from rovercheck.checker.model import Model
from rovercheck.checker.results.gravity import Gravity, gravest_first
from rovercheck.checker.verify.checked import CheckedProperty
from rovercheck.properties.forms import Property, Reachable
from rovercheck.properties.hazards import Hazard, gravest_of
from rovercheck.spec_model.lang.system import System


@dataclass(frozen=True)
class FindingOrder:
    """What decides which of two findings is graver.

    ``hazards`` by id, the gravest first, as ``hazards_in`` gives them; ``requirements`` are ids, those first
    whose violation is gravest; ``systems`` by name.
    """

    hazards: Mapping[str, Hazard] = field(default_factory=dict)
    requirements: Sequence[str] = ()
    systems: Mapping[str, System] = field(default_factory=dict)

    def hazard(self, one: CheckedProperty) -> Hazard:
        """What may come of it if the property is broken."""
        return gravest_of(one.result.property.covers, self.hazards, one.expected.hazard)

    def gravity(self, one: CheckedProperty) -> Gravity:
        """How grave it is if the property is broken.

        Of one requirement a demand comes before a situation out of reach, then what is shown on more of the
        charts, then what a shorter run shows.
        """
        hazard, prop = self.hazard(one), one.result.property
        last = len(self.requirements)
        first = min((self._rank.get(id, last) for id in prop.covers), default=last)
        place = self._places.get(hazard.id, len(self.hazards))
        return Gravity(hazard.severity.rank, place, first, self._within(one, prop))

    @cached_property
    def _places(self) -> dict[str, int]:
        return {id: place for place, id in enumerate(self.hazards)}

    @cached_property
    def _rank(self) -> dict[str, int]:
        return {id: place for place, id in enumerate(self.requirements)}

    def ordered(self, found: Sequence[CheckedProperty]) -> list[CheckedProperty]:
        """The gravest first."""
        return gravest_first(found, self.gravity)

    def places(self, found: Sequence[CheckedProperty]) -> dict[str, int]:
        """The place of each property in that order, from 0, by id."""
        return {one.result.property.id: place for place, one in enumerate(self.ordered(found))}

    def _within(self, one: CheckedProperty, prop: Property) -> tuple[bool, int, int, str]:
        """What is graver of two findings about one requirement."""
        name = one.result.system
        charts = len(self.systems[name].charts) if name in self.systems else 0
        return isinstance(prop.form, Reachable), -charts, one.length or sys.maxsize, prop.id


def order_of(model: Model, systems: Mapping[str, System] | None = None) -> FindingOrder:
    """The order of the findings of a model, whose ``systems`` may be changed."""
    return FindingOrder(model.hazards, model.by_gravity, model.systems if systems is None else systems)
