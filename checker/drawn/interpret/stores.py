"""The data stores of a model at work: a value for each memory, which blocks and charts share."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass

from rovercheck.checker.drawn.faults import DrawnFault
from rovercheck.checker.drawn.interpret.memory import TypeTable, dimensions
from rovercheck.checker.drawn.interpret.values import (
    MatlabValue,
    NumberRules,
    array,
    each_converted,
    scalars,
    shape,
)
from rovercheck.checker.drawn.parsed import ParsedChart
from rovercheck.checker.drawn.records import DrawnBlock
from rovercheck.checker.drawn.store_order import READ
from rovercheck.checker.drawn.stores import DataStores


@dataclass
class SharedValue:
    """The value of a memory, whose type and size stay."""

    name: str
    value: MatlabValue

    def write(self, value: MatlabValue) -> None:
        """A new value.  Raises ``DrawnFault`` for one of another type or size."""
        if (value.kind, shape(value)) != (self.value.kind, shape(self.value)):
            raise DrawnFault(
                f"the data store {self.name} is of {_described(self.value)}, and its value of "
                f"{_described(value)}: give both one type"
            )
        self.value = value


class StoresAtWork:
    """All of a model."""

    def __init__(
        self, stores: DataStores, types: TypeTable, value_of: Callable[[str], MatlabValue]
    ) -> None:  # fmt: skip
        self.stores = stores
        self._cells = {
            path: SharedValue(memory.shown, _first(memory, stores.types[path], types, value_of))
            for path, memory in stores.memories.items()
        }

    def executed(self, block: DrawnBlock, values: list[MatlabValue]) -> list[MatlabValue]:
        """What a block does that reads or writes a memory, and what it gives."""
        cell = self._cells[self.stores.memory_of(block)]
        if block.kind == READ:
            return [cell.value]
        cell.write(values[0])
        return []

    @contextmanager
    def kept(self) -> Iterator[None]:
        """What is executed meanwhile changes none of them."""
        before = {path: cell.value for path, cell in self._cells.items()}
        try:
            yield
        finally:
            for path, value in before.items():
                self._cells[path].value = value

    def of(self, chart: ParsedChart) -> dict[int, SharedValue]:
        """The memories that the data of a chart stand for, by SSID."""
        return {one.ssid: self._cells[path] for one, path in self.stores.data_of(chart)}


def _first(
    memory: DrawnBlock, said: str, types: TypeTable, value_of: Callable[[str], MatlabValue]
) -> MatlabValue:
    """The initial value of a memory in its type and size."""
    text, parameters = memory.parameters.get("InitialValue", "0").strip(), memory.parameters
    kind, size = types.kind(said) if said else "", dimensions(parameters.get("Dimensions", "-1"))
    if kind.startswith("Bus:"):
        if text not in ("", "0"):
            raise DrawnFault(f"{memory.shown}: a bus begins as 0 here: write that")
        return types.initial(kind)
    value = value_of(text or "0")
    made = each_converted(value, kind or ("double" if value.kind == "literal" else value.kind), NumberRules())
    if shape(made) == (1, 1) != size:
        return array([one for one in scalars(made)] * (size[0] * size[1]), *size)
    return made


def _described(value: MatlabValue) -> str:
    rows, columns = shape(value)
    return value.kind if (rows, columns) == (1, 1) else f"{rows}x{columns} {value.kind}"


__all__ = ["SharedValue", "StoresAtWork"]
