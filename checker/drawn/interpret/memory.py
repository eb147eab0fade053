"""The data of a chart while it runs: their types, their values, and what they were at the start of steps."""

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Protocol

from rovercheck.checker.drawn.faults import DrawnFault
from rovercheck.checker.drawn.interpret.values import (
    FALSE,
    LITERAL,
    TYPES,
    MatlabValue,
    NumberRules,
    Scalar,
    Structure,
    array,
    each_converted,
    scalars,
    shape,
)
from rovercheck.checker.drawn.parameters import expanded, seen_in
from rovercheck.checker.drawn.parsed import ParsedChart, StateNode
from rovercheck.checker.drawn.records import DrawnBlock, DrawnBus, DrawnData, DrawnEnumeration, DrawnModel
from rovercheck.checker.drawn.type_names import plain_type

ENUM, BUS = "Enum:", "Bus:"
_SIZE = re.compile(r"\d{1,6}")


@dataclass(frozen=True)
class TypeTable:
    """The types of a model by their names."""

    enumerations: Mapping[str, DrawnEnumeration] = field(default_factory=dict)
    buses: Mapping[str, DrawnBus] = field(default_factory=dict)

    @staticmethod
    def of(model: DrawnModel) -> "TypeTable":
        """Those of a model."""
        enumerations = {one.name: one for one in model.enumerations}
        return TypeTable(enumerations, {one.name: one for one in model.buses})

    def kind(self, written: str) -> str:
        """A type as values have it; empty where it is inherited.  Raises ``DrawnFault``."""
        text = plain_type(written)
        if text.startswith("Inherit"):
            return ""
        if text in ("boolean", "logical"):
            return "logical"
        if text in TYPES:
            return text
        for prefix, names in ((ENUM, self.enumerations), (BUS, self.buses)):
            name = text.removeprefix(prefix).strip()
            if text.startswith(prefix) or name in names:
                if name not in names:
                    raise DrawnFault(f"the type {name} is not there: name the file that defines it")
                return f"{prefix} {name}"
        raise DrawnFault(f"the type {text!r} is not known")

    def initial(self, kind: str, rows: int = 1, columns: int = 1) -> MatlabValue:
        """The value of a type that nobody has written to: 0, false, the default member."""
        if kind.startswith(BUS):
            bus = self.buses[kind.removeprefix(BUS).strip()]
            elements = {
                one.name: self.initial(self.kind(one.type), *dimensions(one.dimensions))
                for one in bus.elements
            }
            return Structure(kind, elements)
        one = Scalar(kind, 0.0 if kind in ("double", "single") else 0)
        if kind.startswith(ENUM):
            enumeration = self.enumerations[kind.removeprefix(ENUM).strip()]
            one = Scalar(kind, enumeration.members[enumeration.default])
        elif kind == "logical":
            one = FALSE
        return array([one] * (rows * columns), rows, columns, kind)

    def member(self, name: str, owner: str = "") -> Scalar | None:
        """A member of an enumeration, by its name alone if that is in one only."""
        found = [
            one
            for one in self.enumerations.values()
            if name in one.members and (not owner or one.name == owner)
        ]
        if len(found) > 1:
            told = " and ".join(one.name for one in found)
            raise DrawnFault(f"{name} is in {told}: write {found[0].name}.{name}")
        return Scalar(f"{ENUM} {found[0].name}", found[0].members[name]) if found else None


def dimensions(text: str) -> tuple[int, int]:
    """Rows and columns of a size as written: ``[1 3]``, ``3``, ``-1``."""
    if text.strip() in ("", "-1"):
        return 1, 1
    sizes = [int(size) for size in _SIZE.findall(text)]
    if len(sizes) == 1:
        return sizes[0], 1
    if len(sizes) != 2:
        raise DrawnFault(f"a size of {text!r}: matrices have two dimensions here")
    return sizes[0], sizes[1]


@dataclass
class FreeValues:
    """What is free: its values in this step, by name, and the names of functions and expressions."""

    texts: Mapping[str, str] = field(default_factory=dict)
    values: dict[str, float] = field(default_factory=dict)

    def of_block(self, block: DrawnBlock, types: TypeTable) -> list[MatlabValue]:
        """The outputs of a free block, in their types."""
        every = ((Scalar("double", self.values[name]), types.kind(k)) for name, k in block.parameters.items())
        return [each_converted(value, kind, NumberRules()) for value, kind in every]


class SharedCell(Protocol):
    """A value that a chart shares with other blocks."""

    value: MatlabValue

    def write(self, value: MatlabValue) -> None:
        """A new value.  Raises ``DrawnFault`` for one of another type or size."""


class ChartMemory:
    """The values of a chart's data; one of an inherited type has that of its first value.

    ``shared`` are those that stand elsewhere, by SSID.
    """

    def __init__(
        self, types: TypeTable, rules: NumberRules, free: FreeValues | None = None,
        shared: Mapping[int, SharedCell] | None = None,
    ) -> None:  # fmt: skip
        self.types, self.rules, self.shared = types, rules, shared or {}
        self.free = free or FreeValues()
        self._data: dict[int, DrawnData] = {}
        self._kinds: dict[int, str] = {}
        self._initial: dict[int, MatlabValue] = {}
        self.values: dict[int, MatlabValue] = {}
        self.start: dict[int, MatlabValue] = {}
        """What the data were at the start of this step."""
        self.before: dict[int, MatlabValue] = {}
        """And at the start of the step before, if there was one."""

    def declare_all(
        self, chart: ParsedChart, named: Mapping[str, str], value_of: Callable[[str], MatlabValue]
    ) -> None:
        """All data of a chart; ``named`` are values of parameters, as written.  Raises ``DrawnFault``."""
        for node in chart.root.every():
            for data in (node.data, *(function.data for function in node.functions.values())):
                for one in data.values():
                    self.declare(one, _initial_of(one, chart, named), value_of)

    def declare(self, one: DrawnData, initial: str, value_of: Callable[[str], MatlabValue]) -> None:
        """A datum with its initial value, as written.  Raises ``DrawnFault``."""
        if one.ssid in self.shared:
            self._data[one.ssid] = one
            return
        kind = self.types.kind(one.type)
        rows, columns = dimensions(one.size)
        self._data[one.ssid], self._kinds[one.ssid] = one, kind
        value = self.types.initial(kind or "double", rows, columns)
        if initial.strip():
            value = self._fitted(value_of(initial), kind, (rows, columns))
        self.values[one.ssid] = self._initial[one.ssid] = value

    def _fitted(self, value: MatlabValue, kind: str, size: tuple[int, int]) -> MatlabValue:
        made = each_converted(value, kind, self.rules) if kind else value
        if size != (1, 1) and shape(made) == (1, 1):
            [one] = scalars(made)
            return array([one] * (size[0] * size[1]), *size)
        return made

    def receive(self, ssid: int, value: MatlabValue) -> None:
        """A signal: an inherited size is that of what comes, and a vector fits in either direction."""
        size, came, kind = shape(self._initial[ssid]), shape(value), self._kinds[ssid]
        if kind and inherits_size(self._data[ssid]) and not isinstance(value, Structure):
            self._initial[ssid] = self.types.initial(kind, *came)
        elif came == size[::-1] != size and 1 in size:
            value = array(scalars(value), *size)
        self.write(ssid, value)

    def write(self, ssid: int, value: MatlabValue) -> None:
        """A new value, in the type of the datum; one without a type takes that of its first value."""
        if ssid in self.shared:
            cell = self.shared[ssid]
            self._kinds[ssid], self._initial[ssid] = cell.value.kind, cell.value
        kind = self._kinds[ssid]
        if not kind:
            kind = self._kinds[ssid] = "double" if value.kind == LITERAL else value.kind
            if inherits_size(self._data[ssid]) and not isinstance(value, Structure):
                self._initial[ssid] = self.types.initial(kind, *shape(value))
        if isinstance(value, Structure) or kind.startswith(BUS):
            if value.kind != kind:
                raise DrawnFault(f"{self._data[ssid].name} is of {kind}, and its value of {value.kind}")
            self._put(ssid, value)
            return
        size = shape(self._initial[ssid])
        made = self._fitted(value, kind, size)
        if shape(made) != size:
            told = "x".join(map(str, shape(made)))
            raise DrawnFault(f"{self._data[ssid].name} is of {size[0]}x{size[1]}, and its value of {told}")
        self._put(ssid, made)

    def _put(self, ssid: int, value: MatlabValue) -> None:
        if ssid in self.shared:
            self.shared[ssid].write(value)
        else:
            self.values[ssid] = value

    def read(self, ssid: int) -> MatlabValue:
        """The value of a datum."""
        return self.shared[ssid].value if ssid in self.shared else self.values[ssid]

    def reset(self, ssid: int) -> None:
        """Its initial value again."""
        self.values[ssid] = self._initial[ssid]

    def reset_all(self) -> None:
        """All of them, and there was no step before."""
        self.values |= self._initial
        self.before, self.start = {}, {}

    def note_start(self) -> None:
        """A step begins."""
        self.before, self.start = self.start, dict(self.values)


def _initial_of(one: DrawnData, chart: ParsedChart, named: Mapping[str, str]) -> str:
    """The initial value of a datum, as written; that of a parameter has its name."""
    if one.scope != "parameter" and not one.from_workspace:
        return expanded(one.initial, seen_in(chart.drawn, named))
    if one.name not in named:
        raise DrawnFault(
            f"{chart.drawn.path}: the value of {one.name} stands in no file: name a script that says "
            f"`{one.name} = ...`"
        )
    return named[one.name]


def inherits_size(one: DrawnData) -> bool:
    """Whether the size of a datum is that of its signal."""
    return one.size.strip() in ("", "-1")


def datum_of(node: StateNode, name: str) -> DrawnData | None:
    """The datum that a name means in a state: that of the nearest state around it."""
    return next((one.data[name] for one in node.lineage() if name in one.data), None)


__all__ = ["BUS", "ENUM", "ChartMemory", "SharedCell", "TypeTable", "datum_of", "dimensions"]
