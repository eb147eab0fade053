"""Which finding is graver: the order in which every output tells findings."""

import sys
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from rovercheck.checker.model import Model
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

    def ordered(self, found: Sequence[CheckedProperty]) -> list[CheckedProperty]:
        """The gravest first: by severity, then by hazard in the order of the file.

        Of one hazard: for each requirement the gravest, in the order of the requirements, then for each
        the next, and so on.  Of one requirement a demand comes before a situation out of reach, then what is
        shown on more of the charts, then what a shorter run shows.
        """
        places = {id: place for place, id in enumerate(self.hazards)}
        rank = {id: place for place, id in enumerate(self.requirements)}
        turns = Counter[tuple[str, int]]()
        keyed = []
        for one in sorted(found, key=self._within):
            hazard = self.hazard(one)
            first = min((rank.get(id, len(rank)) for id in one.result.property.covers), default=len(rank))
            turn = turns[hazard.id, first]
            turns[hazard.id, first] += 1
            keyed.append(((hazard.severity.rank, places.get(hazard.id, len(places)), turn, first), one))
        return [one for _, one in sorted(keyed, key=lambda pair: pair[0])]

    def places(self, found: Sequence[CheckedProperty]) -> dict[str, int]:
        """The place of each property in that order, from 0, by id."""
        return {one.result.property.id: place for place, one in enumerate(self.ordered(found))}

    def _within(self, one: CheckedProperty) -> tuple[bool, int, int, str]:
        """What is graver of two findings about one requirement."""
        prop: Property = one.result.property
        name = one.result.system
        charts = len(self.systems[name].charts) if name in self.systems else 0
        return isinstance(prop.form, Reachable), -charts, one.length or sys.maxsize, prop.id


def order_of(model: Model, systems: Mapping[str, System] | None = None) -> FindingOrder:
    """The order of the findings of a model, whose ``systems`` may be changed."""
    return FindingOrder(model.hazards, model.by_gravity, model.systems if systems is None else systems)
