"""The types of a model: which values a datum of each may have, and which it has at first."""

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property

from rovercheck.checker.drawn.lower.symbols import (
    INTEGERS,
    LOGICAL,
    REALS,
    NotLowered,
    Symbolic,
    SymbolicScalar,
    SymbolicStructure,
    matrix,
    number,
    truth,
)
from rovercheck.checker.drawn.records import DrawnBus, DrawnEnumeration, DrawnModel
from rovercheck.checker.drawn.type_names import plain_type
from rovercheck.spec_model.lang.domain import Domain, boolean, enumeration, integer
from rovercheck.spec_model.lang.expr import FALSE, Const

_ENUM, _BUS = "Enum: ", "Bus: "
_SIZE = re.compile(r"\d+")


@dataclass(frozen=True)
class KindTable:
    """The enumerations and buses of a model by name."""

    enumerations: Mapping[str, DrawnEnumeration] = field(default_factory=dict)
    buses: Mapping[str, DrawnBus] = field(default_factory=dict)

    @staticmethod
    def of(model: DrawnModel) -> "KindTable":
        """Those of a model."""
        return KindTable(
            {one.name: one for one in model.enumerations}, {one.name: one for one in model.buses}
        )

    def kind(self, written: str) -> str:
        """A type as written, in one way; empty where it is inherited.  Raises ``NotLowered``."""
        text = plain_type(written)
        if text.startswith("Inherit") or not text:
            return ""
        if text in ("boolean", LOGICAL):
            return LOGICAL
        if text in INTEGERS or text in REALS:
            return text
        kinds: tuple[tuple[str, Mapping[str, object]], ...] = (
            (_ENUM, self.enumerations), (_BUS, self.buses)
        )  # fmt: skip
        for prefix, known in kinds:
            name = text.removeprefix(prefix.strip()).strip()
            if name in known:
                return prefix + name
            if text.startswith(prefix.strip()):
                raise NotLowered(f"the type {name} is not there: name the file that defines it with --beside")
        raise NotLowered(f"the type {text!r} is not known")

    @cached_property
    def _domains(self) -> dict[str, Domain]:
        return {}

    def domain(self, kind: str) -> Domain | None:
        """The values that a type has; None for real numbers, and for integers of 64 bits."""
        if kind not in self._domains:
            if kind == LOGICAL:
                self._domains[kind] = boolean
            elif kind in INTEGERS and not kind.endswith("64"):
                self._domains[kind] = integer(*INTEGERS[kind])
            elif is_member(kind):
                one, first = self.enumerations[kind.removeprefix(_ENUM)], dict[int, str]()
                for name, value in one.members.items():  # of two members with one number the first
                    first.setdefault(value, name)
                self._domains[kind] = enumeration(one.name, {name: value for value, name in first.items()})
            else:
                return None
        return self._domains[kind]

    def member(self, name: str, owner: str = "") -> SymbolicScalar | None:
        """A member of an enumeration; without its owner it must be in one of them only."""
        found = [one for one in self.enumerations.values() if name in one.members and owner in ("", one.name)]
        if len(found) > 1:
            raise NotLowered(f"{name} is in {' and in '.join(one.name for one in found)}: write which")
        if not found:
            return None
        kind = _ENUM + found[0].name
        domain = self.domain(kind)
        assert domain is not None
        return SymbolicScalar(kind, Const(found[0].members[name], domain.sort))

    def first_value(self, kind: str, rows: int = 1, columns: int = 1) -> Symbolic:
        """What a datum of a type is before anything is written to it."""
        if kind.startswith(_BUS):
            bus = self.buses[kind.removeprefix(_BUS)]
            inner = {
                one.name: self.first_value(self.kind(one.type), *sizes(one.dimensions))
                for one in bus.elements
            }
            return SymbolicStructure(kind, inner)
        if kind == LOGICAL:
            one = truth(FALSE)
        elif is_member(kind):
            named = self.enumerations[kind.removeprefix(_ENUM)]
            found = self.member(named.default, named.name)
            if found is None:
                raise NotLowered(f"{named.name} has no member {named.default}, which is its default")
            one = found
        else:
            one = number(kind, 0)
        return matrix([one] * (rows * columns), rows, columns, kind)


def is_member(kind: str) -> bool:
    """Whether values of a type are members of an enumeration."""
    return kind.startswith(_ENUM)


def is_structure(kind: str) -> bool:
    """Whether values of a type are structures."""
    return kind.startswith(_BUS)


def sizes(text: str) -> tuple[int, int]:
    """Rows and columns of a size as written: ``[1 3]``, ``3``, ``-1``.  Raises ``NotLowered``."""
    if text.strip() in ("", "-1"):
        return 1, 1
    found = [int(one) for one in _SIZE.findall(text)]
    if len(found) == 1:
        return found[0], 1
    if len(found) == 2:
        return found[0], found[1]
    raise NotLowered(f"a size of {text!r}: matrices have two dimensions here")


__all__ = ["KindTable", "is_member", "is_structure", "sizes"]
