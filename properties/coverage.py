"""Which properties stand for which requirement, and what is said of a requirement that none stands for."""

from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass

from rovercheck.properties.forms import Property, Reachable
from rovercheck.properties.requirements import Requirement, requirements
from rovercheck.spec_model.lang.errors import ModelError


@dataclass(frozen=True)
class RequirementCoverage:
    """A row of the matrix: a requirement and the properties that name it.

    ``noticing`` are the properties known to notice that something is wrong: a fault put into the charts, or
    the charts as they are.  None: that was not measured.
    """

    requirement: Requirement
    properties: tuple[Property, ...]
    noticing: Collection[str] | None = None

    @property
    def stated(self) -> bool:
        """Whether a property demands something: that a state can be reached is no demand on it."""
        return any(not isinstance(p.form, Reachable) for p in self.properties)

    @property
    def covered(self) -> bool:
        """Whether a property demands something, and notices a fault as far as that was measured."""
        known = self.noticing
        return self.stated and (known is None or any(p.id in known for p in self.properties))

    @property
    def open(self) -> bool:
        """Whether neither a property nor a reason speaks for the requirement."""
        return not self.covered and not self.requirement.reason

    def state(self, verdicts: Mapping[str, str]) -> str:
        """One word: the worst verdict if covered, else what there is instead."""
        if self.covered:
            words = {verdicts[p.id] for p in self.properties}
            return next((w for w in ("violated", "unknown") if w in words), "proved")
        if self.requirement.reason:
            return "reason"
        if self.stated:
            return "stated"
        return "reached" if self.properties else "open"


def matrix(
    properties: Iterable[Property],
    register: Mapping[str, Requirement] | None = None,
    noticing: Collection[str] | None = None,
) -> tuple[RequirementCoverage, ...]:
    """A row for every requirement of the register, by default that of the document, in its order.

    Raises ``ModelError`` for a reason why no property covers a requirement that one covers.
    """
    by: dict[str, list[Property]] = {}
    for prop in properties:
        for id in prop.covers:
            by.setdefault(id, []).append(prop)
    known = requirements() if register is None else register
    rows = tuple(RequirementCoverage(item, tuple(by.get(item.id, ())), noticing) for item in known.values())
    for row in rows:
        if row.stated and row.requirement.reason:
            raise ModelError(
                f"requirements.toml says why no property covers {row.requirement.id}, "
                f"but {_shown(row.properties)} does; delete its reason."
            )
    return rows


def _shown(properties: Sequence[Property]) -> str:
    return next(p.id for p in properties if not isinstance(p.form, Reachable))
