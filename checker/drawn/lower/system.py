"""One system of blocks, in the order of their execution, with the subsystems in it."""

from collections.abc import Mapping, Sequence
from dataclasses import replace

from rovercheck.checker.drawn.calls import GENERATOR, is_called
from rovercheck.checker.drawn.faults import BY_ZERO
from rovercheck.checker.drawn.free import FREE_BLOCK
from rovercheck.checker.drawn.lower.blocks import BLOCKS
from rovercheck.checker.drawn.lower.called_blocks import CalledBlockWriter
from rovercheck.checker.drawn.lower.conversions import IntegerRules, each_converted
from rovercheck.checker.drawn.lower.program import ProgramWriter
from rovercheck.checker.drawn.lower.symbols import (
    NotLowered,
    Symbolic,
    SymbolicScalar,
    filled,
    folded,
    leaves,
    number,
    size_of,
)
from rovercheck.checker.drawn.lower.view import plain_name
from rovercheck.checker.drawn.lower.wired_blocks import BlockNode
from rovercheck.checker.drawn.records import DrawnBlock, DrawnSystem
from rovercheck.checker.drawn.refused import FREE
from rovercheck.checker.drawn.resets import begins_anew, is_reset, resets_refused
from rovercheck.checker.drawn.store_order import MEMORY, READ, WRITE
from rovercheck.checker.drawn.wiring import CONTROL, DELAYS, number_of
from rovercheck.spec_model.lang.action import Assign, If
from rovercheck.spec_model.lang.chart import Block, Component, Enabled, parts
from rovercheck.spec_model.lang.domain import boolean
from rovercheck.spec_model.lang.expr import FALSE, TRUE, Const, Expr, Var, any_of, const
from rovercheck.spec_model.lang.programmed import FAULT, ProgrammedBlock, ProgrammedChart, is_fault


class SystemWriter(CalledBlockWriter):
    """The components of one system."""

    def lowered(self, given: Sequence[Symbolic]) -> tuple[tuple[Component, ...], list[Symbolic]]:
        """The components in order, and the outputs."""
        components: list[Component] = []
        for node in self.nodes:
            if node.block.kind in DELAYS:
                first = self.context.value_of(node.block.parameters.get("InitialCondition", "0"))
                node.memory = self._remembered(node, first)
                leaf_vars = (one.expr for _, one in leaves(node.memory, ""))
                self.context.memories |= {var.name: var for var in leaf_vars if isinstance(var, Var)}
            if node.block.kind == "Merge":
                with self._told(node):
                    self._mark(node)
        for node in self.nodes:
            if node.block.id not in self._wiring.called:
                with self._told(node):
                    components += self._component(node, given)
        self._remember()
        return tuple(components), [(self._values(node) or [number("double", 0)])[0] for node in self.ends]

    def _component(self, node: BlockNode, given: Sequence[Symbolic]) -> list[Component]:
        block = node.block
        if block.kind == "Inport":
            node.outputs = [given[number_of(block) - 1]]
        elif node.memory is not None or block.kind in ("Outport", MEMORY, *CONTROL):
            return []
        elif block.kind == GENERATOR:
            return self._generated(node)
        elif block.kind == READ:
            read, component = self.context.stores.read(block, self._named(block))
            node.outputs = [read]
            self.own |= component.written.keys()
            return [component]
        elif block.kind == WRITE:
            return [self.context.stores.write(block, self._named(block), self._values(node)[0])]
        elif block.chart:
            return self._chart(node)
        elif block.kind == "SubSystem" and block.system is not None:
            return self._subsystem(node, block.system)
        elif block.kind == "Merge":
            node.outputs = [self._merged(node)]
        elif block.kind == FREE_BLOCK:
            node.outputs = [
                SymbolicScalar(self.context.table.kinds.kind(kind), self.context.inputs[name])
                for name, kind in block.parameters.items()
            ]
        elif block.kind in BLOCKS:
            try:
                types = self.context.types
                node.outputs = BLOCKS[block.kind](block, self._values(node), types)
                outside, divided = types.take_outside(), self._divided(block, types.take_zeros())
                return [*divided, *self._outside(block, types.rules(block), outside)]
            except (IndexError, KeyError, ValueError) as error:  # as a Gain without an input
                raise NotLowered("its inputs and parameters do not fit each other") from error
        else:
            raise NotLowered(f"{block.kind} blocks are not known here; name it under {FREE}")
        return []

    def _divided(self, block: DrawnBlock, zeros: Sequence[Expr]) -> list[Component]:
        """Note the steps in which a block divides by 0."""
        if not zeros:
            return []
        name = self._named(block)
        fault = Var(f"{name}.fault", FAULT, 0, f"{block.shown_path} {BY_ZERO}", hidden=True)
        noted = If(folded(any_of(*zeros)), (Assign(fault, const(1)),))
        return [Block(name, [noted], text=f"What {block.path} divides by.")]

    def _outside(
        self, block: DrawnBlock, rules: IntegerRules, conditions: Mapping[str, Expr]
    ) -> list[Component]:
        """Tell where integers that a block computes are more than their types hold."""
        if not conditions:
            return []
        name = self._named(block)
        told = {
            f"{name}.overflow {n}": (f"{block.shown_path} {rules.left(kind)}", condition)
            for n, (kind, condition) in enumerate(conditions.items(), 1)
        }
        rows = [
            If(condition, (Assign(Var(marker, boolean, 0, hidden=True), TRUE),))
            for marker, (_, condition) in told.items()
        ]
        texts = {marker: text for marker, (text, _) in told.items()}
        return [ProgrammedBlock(name, tuple(rows), texts, text=f"What {block.path} computes.")]

    def _subsystem(self, node: BlockNode, system: DrawnSystem) -> list[Component]:
        block = node.block
        if not node.control and not is_called(block):
            inner = self._inner(block.name, system)
            components, ends = inner.lowered(self._values(node))
            self.own |= inner.own
            node.outputs = list(ends)
            self.remembered += inner.remembered
            return list(components)
        by: Expr = FALSE
        after: list[Component] = []
        resets = False
        if is_called(block):
            pass  # and nothing calls it
        elif node.control == "enable":
            by = folded(any_of(*(folded(one > 0) for one in self._control(node))))
            resets = is_reset(system)
        elif node.control == "trigger":
            ports = [one for one in system.blocks if one.kind == "TriggerPort"]
            kind = ports[0].parameters.get("TriggerType", "rising") if ports else "rising"
            count = len(self._control(node))
            by, after = folded(any_of(*self._edge_conditions(node, [kind] * count))), self._edges(node)
        else:
            raise NotLowered(f"a subsystem that is controlled by {node.control}")
        inside = self._inside(node, system)
        name = plain_name(block.name)
        anew = [Enabled(folded(~by), *node.anew, name=f"{name}_disabled")] if node.anew else []
        if resets:
            on = Var(f"{self._named(block)}.enabled", boolean, 0, f"whether {block.path} was enabled", True)
            inside = [self._first_of_all(name, on, inside), *(_entered_anew(one, on) for one in inside)]
            after = [Block(f"{name}_was", [Assign(on, by)], text=f"Whether {block.path} was enabled.")]
        return [*anew, *([Enabled(by, *inside, name=name)] if inside else []), *after]

    def _first_of_all(self, name: str, on: Var, components: Sequence[Component]) -> Block:
        """All data that some components write are as before the first step, unless ``on`` holds."""
        every = {one: var for part in parts(components) for one, var in part.written.items()}
        first = tuple(_at_first(var) for var in every.values() if not is_fault(var))
        return Block(f"{name}_anew", [If(folded(~on), first)], text="All begins anew.")

    def _inner(self, name: str, system: DrawnSystem) -> "SystemWriter":
        return type(self)(system, self.context, f"{self._path}_{name}".strip("_"))

    def _inside(self, node: BlockNode, system: DrawnSystem) -> list[Component]:
        if said := resets_refused(system):
            raise NotLowered(said)
        inner = self._inner(node.block.name, system)
        components, ends = inner.lowered(self._values(node))
        self.own |= inner.own
        held, node.outputs = self._held(node, inner, ends, components)
        return [*components, *held, *inner.delays(), *self._marked(node)]

    def _held(
        self,
        node: BlockNode,
        inner: "SystemWriter",
        ends: Sequence[Symbolic],
        components: Sequence[Component],
    ) -> tuple[list[Component], list[Symbolic]]:
        """The outputs of a subsystem that does not run in every step: data that stay as they are."""
        table, outputs, held = self.context.table, list[Symbolic](), list[Component]()
        written = {name for part in parts(components) for name in part.written} | inner.own
        cells_ = (one.expr for _, memory, _ in inner.remembered for _, one in leaves(memory, ""))
        memories = {var.name: var for var in cells_ if isinstance(var, Var)}
        for end, value in zip(inner.ends, ends, strict=True):
            text = end.block.parameters.get("InitialOutput", "[]").strip()
            own = (isinstance(one.expr, Var) and one.expr.name in written for _, one in leaves(value, ""))
            if text == "[]" and all(own):
                outputs.append(value)
                continue
            name = inner._named(end.block)
            first = table.kinds.first_value(value.kind, *size_of(value))
            remembered = [memories.get(str(one.expr)) for _, one in leaves(value, "")]
            if text != "[]":
                first = each_converted(self.context.value_of(text), value.kind, IntegerRules(), table.kinds)
            elif all(one is not None for one in remembered):
                begun = (Const(var.init, var.sort) for var in remembered if var is not None)
                kinds = (one.kind for _, one in leaves(value, ""))
                first = filled(value, map(SymbolicScalar, kinds, begun))
            cells = table.declared(name, first, doc=f"the output {end.block.path}")
            writer = ProgramWriter(name)
            for (_, cell), (_, new) in zip(leaves(cells, name), leaves(value, name), strict=True):
                table.write(writer, cell, new.expr)
            held.append(Block(name, writer.written(), text=f"The output {end.block.path}."))
            if begins_anew(end.block):
                writer = ProgramWriter(f"{name}_anew")
                for (_, cell), (_, begin) in zip(leaves(cells, name), leaves(first, name), strict=True):
                    table.write(writer, cell, begin.expr)
                node.anew.append(
                    Block(writer.name, writer.written(), text=f"The output {end.block.path}, anew.")
                )
            outputs.append(cells)
        return held, outputs


def _entered_anew(one: Component, on: Var) -> Component:
    """A chart in which no state is active where it begins, unless ``on`` holds; others stay."""
    if not isinstance(one, ProgrammedChart):
        return one
    program, first = one.program, tuple(map(_at_first, (one.entered, *one.locations)))
    return one.with_program(replace(program, statements=(If(folded(~on), first), *program.statements)))


def _at_first(var: Var) -> Assign:
    return Assign(var, Const(var.init, var.sort))


__all__ = ["SystemWriter"]
