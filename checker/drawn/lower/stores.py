"""The data stores of a model as variables, which blocks and charts share."""

from collections.abc import Mapping
from functools import cached_property
from typing import Protocol

from rovercheck.checker.drawn.lower.conversions import IntegerRules, each_converted
from rovercheck.checker.drawn.lower.data import DataTable
from rovercheck.checker.drawn.lower.kinds import is_structure, sizes
from rovercheck.checker.drawn.lower.model_names import ModelNames
from rovercheck.checker.drawn.lower.program import ProgramWriter
from rovercheck.checker.drawn.lower.symbols import (
    UNTYPED,
    NotLowered,
    Symbolic,
    SymbolicScalar,
    filled,
    leaves,
    matrix,
    single_of,
    size_of,
)
from rovercheck.checker.drawn.lower.view import plain_name
from rovercheck.checker.drawn.parsed import ParsedChart
from rovercheck.checker.drawn.records import DrawnBlock
from rovercheck.checker.drawn.stores import DataStores
from rovercheck.spec_model.lang.chart import Block
from rovercheck.spec_model.lang.expr import Const, Expr, Var


class StoreContext(Protocol):
    """What they need of the model that is lowered."""

    table: DataTable
    names: ModelNames
    data: dict[str, Expr]

    def value_of(self, text: str) -> Symbolic:
        """The value of a parameter.  Raises ``NotLowered``."""


class StoreVariables:
    """All of a model."""

    def __init__(self, context: StoreContext, stores: DataStores) -> None:
        self._context, self.stores = context, stores

    @cached_property
    def _cells(self) -> Mapping[str, Symbolic]:
        return {path: self._declared(path, memory) for path, memory in self.stores.memories.items()}

    def _declared(self, path: str, memory: DrawnBlock) -> Symbolic:
        table, parameters = self._context.table, memory.parameters
        name = self._context.names.of_block(memory, plain_name(parameters.get("DataStoreName", "A")))
        said, text = self.stores.types[path], parameters.get("InitialValue", "0").strip() or "0"
        kind, size = table.kinds.kind(said) if said else "", sizes(parameters.get("Dimensions", "-1"))
        if kind and is_structure(kind):
            if text != "0":
                raise NotLowered(f"{memory.shown}: a bus begins as 0 here: write that")
            first = table.kinds.first_value(kind)
        else:
            value = self._context.value_of(text)
            kind = kind or ("double" if value.kind == UNTYPED else value.kind)
            first = each_converted(value, kind, IntegerRules(), table.kinds)
            if size_of(first) == (1, 1) != size:
                first = matrix([single_of(first)] * (size[0] * size[1]), *size)
        made = table.declared(name, first, doc=f"the data store {memory.path}")
        self._context.data |= {leaf: one.expr for leaf, one in leaves(made, name)}
        return made

    def of(self, chart: ParsedChart) -> dict[int, Symbolic]:
        """The variables of the data of a chart that stand for memories, by SSID."""
        return {one.ssid: self._cells[path] for one, path in self.stores.data_of(chart)}

    def read(self, block: DrawnBlock, name: str) -> tuple[Symbolic, Block]:
        """What a block gives that reads a memory: its value when the block is executed, not later."""
        cells, table = self._cells[self.stores.memory_of(block)], self._context.table
        pairs = zip(leaves(cells, name), leaves(_first(cells, table), name), strict=True)
        made = filled(cells, iter([_kept(leaf, cell, first) for (leaf, cell), (_, first) in pairs]))
        return made, self._copied(name, made, cells, f"What {block.path} reads.")

    def write(self, block: DrawnBlock, name: str, value: Symbolic) -> Block:
        """What a block does that writes a memory.  Raises ``NotLowered`` for another type or size."""
        cells = self._cells[self.stores.memory_of(block)]
        if (value.kind, size_of(value)) != (cells.kind, size_of(cells)):
            store = self.stores.memories[self.stores.memory_of(block)].shown
            raise NotLowered(
                f"the data store {store} is of {_described(cells)}, and its value of {_described(value)}: "
                "give both one type"
            )
        return self._copied(name, cells, value, f"What {block.path} writes.")

    def _copied(self, name: str, target: Symbolic, value: Symbolic, text: str) -> Block:
        writer = ProgramWriter(name)
        for (_, cell), (_, new) in zip(leaves(target, name), leaves(value, name), strict=True):
            self._context.table.write(writer, cell, new.expr)
        return Block(name, writer.written(), text=text)


def _first(cells: Symbolic, table: DataTable) -> Symbolic:
    """What is read before anything is: 0, false, the default member."""
    return table.kinds.first_value(cells.kind, *size_of(cells))


def _kept(name: str, cell: SymbolicScalar, first: SymbolicScalar) -> SymbolicScalar:
    """A variable with the values of a cell."""
    assert isinstance(cell.expr, Var) and isinstance(first.expr, Const)
    domain, raw = cell.expr.domain, first.expr.value
    return SymbolicScalar(cell.kind, Var(name, domain, raw if raw in domain else cell.expr.init, hidden=True))


def _described(value: Symbolic) -> str:
    rows, columns = size_of(value)
    return value.kind if (rows, columns) == (1, 1) else f"{rows}x{columns} {value.kind}"


__all__ = ["StoreVariables"]
