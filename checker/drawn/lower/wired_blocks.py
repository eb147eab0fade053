"""The blocks of one system, what feeds each of them, and what delays remember."""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field

from rovercheck.checker.drawn.calls import Port, rate_said
from rovercheck.checker.drawn.faults import DrawnFault
from rovercheck.checker.drawn.lower.blocks import either
from rovercheck.checker.drawn.lower.context import LoweringContext
from rovercheck.checker.drawn.lower.conversions import IntegerRules, each_converted
from rovercheck.checker.drawn.lower.kinds import sizes
from rovercheck.checker.drawn.lower.program import ProgramWriter
from rovercheck.checker.drawn.lower.symbols import (
    INTEGERS,
    LOGICAL,
    REALS,
    UNTYPED,
    NotLowered,
    Symbolic,
    SymbolicScalar,
    folded,
    leaves,
    matrix,
    number,
    single_of,
    size_of,
    truth,
)
from rovercheck.checker.drawn.lower.view import plain_name
from rovercheck.checker.drawn.merges import UNSAID, merged
from rovercheck.checker.drawn.parameters import rate_of, same_number
from rovercheck.checker.drawn.records import DrawnBlock, DrawnSystem
from rovercheck.checker.drawn.wiring import SystemWiring, number_of, wired
from rovercheck.spec_model.lang.chart import Block, Component
from rovercheck.spec_model.lang.expr import FALSE, const
from rovercheck.spec_model.lang.walk import variables


@dataclass
class BlockNode:
    """A block with what feeds it, and what it gives."""

    block: DrawnBlock
    inputs: list[Port | None]
    control: str = ""
    fed: Port | None = None
    outputs: list[Symbolic] = field(default_factory=list)
    memory: Symbolic | None = None
    marks: list[tuple[SymbolicScalar, int]] = field(default_factory=list)
    """Of a subsystem the data of Merge blocks that say which was executed last, and its own number there."""
    anew: list[Component] = field(default_factory=list)
    """Of a subsystem its outputs that have their first value while it is disabled."""


class WiredBlocks:
    """The blocks of one system.  ``path`` is where it stands in the model, for names."""

    def __init__(self, system: DrawnSystem, context: LoweringContext, path: str) -> None:
        self.context, self._path = context, path
        try:
            self._wiring: SystemWiring = wired(system, context.stores.stores.used)
        except DrawnFault as fault:
            raise NotLowered(str(fault)) from fault
        self.nodes = [self._node(block) for block in self._wiring.order]
        self._by_id = {node.block.id: node for node in self.nodes}
        self.remembered: list[tuple[str, Symbolic, Symbolic]] = []
        """The memories of delays here and in subsystems that run in every step, and what they get."""
        self.own: set[str] = set()
        """The data of charts here and in subsystems, by name."""
        found = [node for node in self.nodes if node.block.kind == "Outport"]
        self.ends = sorted(found, key=lambda node: number_of(node.block))

    def _node(self, block: DrawnBlock) -> BlockNode:
        feeds = self._wiring.feeds
        node = BlockNode(block, self._wiring.inputs_of(block))
        control = [port for target, port in feeds if target == block.id and not port.isdigit()]
        if control:
            node.control, node.fed = control[0], feeds[block.id, control[0]]
        rate = rate_said(block)
        if block.chart:
            chart = self.context.chart(block.chart).drawn
            rate = chart.sample_time.strip() or "-1" if chart.update == "discrete" else rate
        rate = rate_of(rate, self.context.named)
        if rate not in ("-1", "0", "inf") and not same_number(rate, self.context.step):
            raise NotLowered(
                f"the block {block.path} runs every {rate} s, and the model every {self.context.step} s: "
                "give them one rate"
            )
        return node

    def kind_wanted(self, port: DrawnBlock) -> tuple[str, int, int] | None:
        """The type and size of the chart's datum that an Inport feeds."""
        for (target, to), (source, _) in self._wiring.feeds.items():
            node = self._by_id.get(target)
            if source != port.id or node is None or not to.isdigit() or not node.block.chart:
                continue
            data = self.context.chart(node.block.chart).root.data.values()
            wanted = [one for one in data if one.scope == "input"][int(to) - 1 :][:1]
            for one in wanted:
                if kind := self.context.table.kinds.kind(one.type):
                    return kind, *sizes(one.size)
        return None

    def _values(self, node: BlockNode) -> list[Symbolic]:
        """Of its inputs; one that is not connected is 0, in the type of the first that is."""
        found = [None if port is None else self._value(port) for port in node.inputs]
        kind = next((one.kind for one in found if one is not None), "double")
        plain = kind in INTEGERS or kind in REALS
        zero = truth(FALSE) if kind == LOGICAL else number(kind if plain else "double", 0)
        return [zero if one is None else one for one in found]

    def _value(self, port: Port) -> Symbolic:
        node = self._by_id.get(port[0])
        if node is None:
            raise NotLowered(f"the block {port[0]}, which feeds it, is not there")
        if node.memory is not None:
            return node.memory
        if not 0 < port[1] <= len(node.outputs):
            raise NotLowered(f"output {port[1]} of {node.block.path} is not there")
        return node.outputs[port[1] - 1]

    def _named(self, block: DrawnBlock) -> str:
        return self.context.names.of_block(block, plain_name(f"{self._path}_{block.name}"))

    @staticmethod
    @contextmanager
    def _told(node: BlockNode) -> Iterator[None]:
        """What has no formula is told with its block."""
        try:
            yield
        except NotLowered as error:
            where, text = node.block.shown_path, str(error)
            raise NotLowered(text if text.startswith(where) else f"{where}: {text}") from error

    # --- merges --------------------------------------------------------------------------------------------

    def _mark(self, node: BlockNode) -> None:
        """Have the subsystems that feed a Merge block say which was executed last.  Raises ``NotLowered``."""
        try:
            ports = merged(node.block, node.inputs, {name: one.block for name, one in self._by_id.items()})
        except DrawnFault as fault:
            raise NotLowered(str(fault)) from fault
        name = f"{self._named(node.block)}.last"
        cell = self.context.table.declared(
            name, number("uint8", 0), doc=f"what {node.block.path} gives: 0, none"
        )
        node.marks = [(single_of(cell), 0)]
        for mark, (source, _) in enumerate(ports, 1):
            self._by_id[source].marks.append((single_of(cell), mark))

    def _marked(self, node: BlockNode) -> list[Component]:
        """The end of a step of a subsystem that a Merge block merges."""
        writer = ProgramWriter(plain_name(f"{self._path}_{node.block.name}_last".strip("_")))
        for cell, mark in node.marks:
            self.context.table.write(writer, cell, const(mark))
        return [Block(writer.name, writer.written(), text="Executed last.")] if node.marks else []

    def _merged(self, node: BlockNode) -> Symbolic:
        """What the subsystem gives that was executed last."""
        values = [self._value(port) for port in node.inputs if port is not None]
        if len({one.kind for one in values}) > 1:
            raise NotLowered("its inputs have several types: give them one")
        text = node.block.parameters.get("InitialOutput", UNSAID).strip()
        kinds, [(cell, _)] = self.context.table.kinds, node.marks
        made = values[0]
        if text != UNSAID:
            made = each_converted(self.context.value_of(text), made.kind, IntegerRules(), kinds)
        for mark, value in enumerate(values, 1):
            made = either(folded(cell.expr == const(mark)), value, made, kinds)
        return made

    # --- delays --------------------------------------------------------------------------------------------

    def _remembered(self, node: BlockNode, first: Symbolic) -> Symbolic:
        """The memory of a delay, in the type that was seen to come in; `0` begins any type of numbers."""
        name = self._named(node.block)
        seen = self.context.table.kind_of(name)
        if isinstance(first, SymbolicScalar) and first.kind == "double" and not seen:
            begins = first.constant
            if begins is not None and begins.denominator == 1:
                first = number(UNTYPED, begins)
        kind, rows, columns = seen or (first.kind, *size_of(first))
        made = each_converted(first, kind, IntegerRules(), self.context.table.kinds)
        if size_of(made) == (1, 1) != (rows, columns):
            made = matrix([single_of(made)] * (rows * columns), rows, columns)
        return self.context.table.declared(name, made, doc=f"what {node.block.path} gives")

    def _remember(self) -> None:
        for node in self.nodes:
            if node.memory is not None:
                [value] = self._values(node) or [number("double", 0)]
                name = self._named(node.block)
                self.context.table.saw_delay(name, value.kind, size_of(value), node.memory.kind == UNTYPED)
                self.remembered.append((name, node.memory, value))

    def delays(self) -> list[Component]:
        """All delays get their new values together, once nothing reads the old ones any more."""
        table, pairs = self.context.table, list[tuple[SymbolicScalar, SymbolicScalar]]()
        writer = ProgramWriter(plain_name(f"{self._path}_Delays".strip("_")))
        for name, memory, value in self.remembered:
            for (_, cell), (_, new) in zip(leaves(memory, name), leaves(value, name), strict=True):
                made = single_of(each_converted(new, cell.kind, IntegerRules(), table.kinds))
                reads_other = any(one in self.context.memories for one in variables(made.expr))
                pairs.append((cell, writer.kept("next", made) if reads_other else made))
        for cell, new in pairs:
            table.write(writer, cell, new.expr)
        if not pairs:
            return []
        statements = writer.written()
        temporaries = tuple(writer.temporaries.values())
        return [Block(writer.name, statements, text="What delays remember.", temporaries=temporaries)]


__all__ = ["BlockNode", "WiredBlocks"]
