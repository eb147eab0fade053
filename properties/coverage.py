"""Which properties stand for which requirement, and what is said of a requirement that none stands for."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

from properties.forms import Property, Reachable
from properties.requirements import Requirement, requirements
from spec_model.lang.errors import ModelError


@dataclass(frozen=True)
class Coverage:
    """A row of the matrix: a requirement and the properties that name it."""

    requirement: Requirement
    properties: tuple[Property, ...]

    @property
    def covered(self) -> bool:
        """Whether a property demands something: that a state can be reached is no demand on it."""
        return any(not isinstance(p.form, Reachable) for p in self.properties)

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
        return "reached" if self.properties else "open"


def matrix(
    properties: Iterable[Property], register: Mapping[str, Requirement] | None = None
) -> tuple[Coverage, ...]:
    """A row for every requirement of the register, by default that of the document, in its order.

    Raises ``ModelError`` for a reason why no property covers a requirement that one covers.
    """
    by: dict[str, list[Property]] = {}
    for prop in properties:
        for id in prop.covers:
            by.setdefault(id, []).append(prop)
    known = requirements() if register is None else register
    rows = tuple(Coverage(item, tuple(by.get(item.id, ()))) for item in known.values())
    for row in rows:
        if row.covered and row.requirement.reason:
            raise ModelError(
                f"requirements.toml says why no property covers {row.requirement.id}, "
                f"but {_shown(row.properties)} does; delete its reason."
            )
    return rows


def _shown(properties: Sequence[Property]) -> str:
    return next(p.id for p in properties if not isinstance(p.form, Reachable))
