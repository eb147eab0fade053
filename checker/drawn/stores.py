"""Data stores: which Data Store Memory each block and chart of a model reads or writes.

A memory is seen in the system that it is drawn in and in all that are in that; a nearer one of its name hides
it.
"""

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

from rovercheck.checker.drawn.faults import DrawnFault
from rovercheck.checker.drawn.grammar.actions import NameDeclaration
from rovercheck.checker.drawn.grammar.syntax import Name, parts
from rovercheck.checker.drawn.grammar.trees import assigned_names, expressions_of
from rovercheck.checker.drawn.parsed import ParsedChart
from rovercheck.checker.drawn.records import DrawnBlock, DrawnData, DrawnSystem
from rovercheck.checker.drawn.store_order import MEMORY, READ, WRITE, StoreUse
from rovercheck.checker.drawn.type_names import plain_type

DATA_STORE = "data store"
"""The scope of such data of a chart."""
INHERITED = "Inherit: auto"
CHANGES_OF_STORES = (
    "changes of a data store, which others write within a step, are not seen here: keep what it was in a "
    "datum of the chart"
)
NO_GLOBAL = "it is no data store of the function: pass the value"
_NUMBERS = re.compile(r"[-+\d.eE\s\[\],;]*")


@dataclass
class DataStores:
    """The memories of a model by their paths, and the paths of what uses them.

    ``of_data``: which memory a datum of a chart stands for, by the path of the chart and the name.
    """

    memories: dict[str, DrawnBlock] = field(default_factory=dict)
    used: dict[str, list[StoreUse]] = field(default_factory=dict)
    of_data: dict[tuple[str, str], str] = field(default_factory=dict)
    types: dict[str, str] = field(default_factory=dict)
    """The types that memories or the data of charts say, as written; none: that of the initial value."""

    def memory_of(self, block: DrawnBlock) -> str:
        """The memory of a block that reads or writes one."""
        return self.used[block.path][0].memory

    def data_of(self, chart: ParsedChart) -> Iterator[tuple[DrawnData, str]]:
        """The data of a chart that stand for memories, with these."""
        for one in chart.root.data.values():
            if one.scope == DATA_STORE:
                yield one, self.of_data[chart.drawn.path, one.name]


def data_stores(system: DrawnSystem, charts: Mapping[str, ParsedChart]) -> DataStores:
    """The data stores of a model.  Raises ``DrawnFault`` for what uses one that is not there."""
    found = DataStores()
    _read(found, system, charts, {})
    for path, memory in found.memories.items():
        written = memory.parameters.get("OutDataTypeStr", INHERITED)
        types = {plain_type(one) for one in _said(found, charts, path)}
        types |= set() if written.startswith("Inherit") else {plain_type(written)}
        if len(types) > 1:
            raise DrawnFault(
                f"{memory.shown_path}: it is of {' and of '.join(sorted(types))}: give it one type"
            )
        users = [one for one, uses in found.used.items() if any(use.memory == path for use in uses)]
        typed = types or any(one not in charts for one in users)
        if not typed and not _NUMBERS.fullmatch(memory.parameters.get("InitialValue", "0")):
            raise DrawnFault(f"{memory.shown_path}: its type follows from nothing: give it one, as int32")
        found.types[path] = next(iter(types), "")
    return found


def _said(found: DataStores, charts: Mapping[str, ParsedChart], memory: str) -> Iterator[str]:
    """The types that the data of charts have which stand for a memory, without those that inherit it."""
    for (chart, name), path in found.of_data.items():
        said = charts[chart].root.data[name].type
        if path == memory and said and not said.startswith("Inherit"):
            yield said


def _read(
    found: DataStores,
    system: DrawnSystem,
    charts: Mapping[str, ParsedChart],
    around: Mapping[str, str],
) -> None:
    own = [one for one in system.blocks if one.kind == MEMORY]
    names = [_store(one) for one in own]
    for name in {one for one in names if names.count(one) > 1}:
        raise DrawnFault(f"two Data Store Memory blocks beside each other are called {name}: rename one")
    found.memories |= {one.path: one for one in own}
    seen = {**around, **{_store(one): one.path for one in own}}
    for block in system.blocks:
        if block.kind in (READ, WRITE):
            path = _found(seen, _store(block), block.shown_path)
            found.used[block.path] = [StoreUse(path, block.kind == WRITE)]
        elif block.chart and block.chart in charts:
            _read_chart(found, charts[block.chart], seen)
        for inner in block.systems():
            _read(found, inner, charts, seen)


def _read_chart(found: DataStores, chart: ParsedChart, seen: Mapping[str, str]) -> None:
    data = [one for one in chart.root.data.values() if one.scope == DATA_STORE]
    if not data:
        return
    if chart.drawn.at_initialization:
        raise DrawnFault(
            f"{chart.drawn.path}: it is entered before the first step, and uses the data store "
            f"{data[0].name}: enter it in the first step"
        )
    written = set(_written(chart))
    for one in data:
        if chart.drawn.kind == "MATLAB function" and (name := _undeclared(chart, one.name)):
            raise DrawnFault(
                f"{chart.drawn.path}: {name} uses the data store {one.name}, and does not say so: write "
                f"`global {one.name}` in its first line"
            )
        path = _found(seen, one.name, chart.drawn.path)
        found.of_data[chart.drawn.path, one.name] = path
        found.used.setdefault(chart.drawn.path, []).append(StoreUse(path, one.name in written))


def _undeclared(chart: ParsedChart, name: str) -> str:
    """The function of a block that uses a data store without a declaration; empty if none does."""
    for function in chart.root.functions.values():
        for one in function.script:
            every = (part for text in expressions_of(one.body) for part in parts(text))
            used = {part.name for part in every if isinstance(part, Name)}
            said = {n for row in one.body if isinstance(row, NameDeclaration) for n in row.names}
            if name in used and name not in said:
                return one.signature.name
    return ""


def _found(seen: Mapping[str, str], name: str, where: str) -> str:
    if name not in seen:
        raise DrawnFault(
            f"{where}: no Data Store Memory block {name} is drawn around it, and a signal of the workspace "
            "is not read: draw one"
        )
    return seen[name]


def _written(chart: ParsedChart) -> Iterator[str]:
    """The names that the texts of a chart may assign to."""
    yield from assigned_names([one.label for one in chart.transitions])
    for node in chart.root.every():
        yield from assigned_names(node.sections, node.on_events)
        for function in node.functions.values():
            yield from assigned_names(function.script)
            yield from assigned_names(
                [] if function.flow is None else [t.label for t in function.flow.defaults]
            )


def _store(block: DrawnBlock) -> str:
    return block.parameters.get("DataStoreName", "A").strip()


__all__ = ["CHANGES_OF_STORES", "DATA_STORE", "NO_GLOBAL", "DataStores", "data_stores"]
