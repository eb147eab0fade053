"""Signals that control a chart or a subsystem: enabled while above 0, or triggered by their edges."""

from collections.abc import Sequence

from rovercheck.checker.drawn.lower.conversions import as_number
from rovercheck.checker.drawn.lower.symbols import NotLowered, flat, folded
from rovercheck.checker.drawn.lower.wired_blocks import BlockNode, WiredBlocks
from rovercheck.spec_model.lang.action import Assign
from rovercheck.spec_model.lang.chart import Block, Component
from rovercheck.spec_model.lang.domain import boolean
from rovercheck.spec_model.lang.expr import TRUE, Expr, Var, all_of


class TriggerWriter(WiredBlocks):
    """The controlled blocks of one system."""

    def _control(self, node: BlockNode) -> list[Expr]:
        return [] if node.fed is None else [as_number(one) for one in flat(self._value(node.fed))]

    def _before(self, node: BlockNode) -> list[tuple[Var, Var]]:
        """Of each signal of a trigger: whether it was above 0 a step before, and whether there was one."""
        name, doc = self._named(node.block), f"the trigger of {node.block.path}"
        return [
            (
                Var(f"{name}.trigger{n}.above", boolean, 0, doc, True),
                Var(f"{name}.trigger{n}.seen", boolean, 0, doc, True),
            )
            for n, _ in enumerate(self._control(node), 1)
        ]

    def _edge_conditions(self, node: BlockNode, kinds: Sequence[str]) -> list[Expr]:
        """Whether each signal of a trigger rises or falls through 0; in its first step it does neither."""
        found = []
        signals = zip(kinds, self._control(node), self._before(node), strict=False)
        for kind, now, (above, seen) in signals:
            if kind in ("function call", "function-call"):
                raise NotLowered("an event that is a function call: give the chart a rising edge")
            rises = folded(all_of(seen, ~above, folded(now > 0)))
            falls = folded(all_of(seen, above, folded(now <= 0)))
            found.append({"rising": rises, "falling": falls}.get(kind, folded(rises | falls)))
        return found

    def _edges(self, node: BlockNode) -> list[Component]:
        """What remembers the signals of a trigger."""
        do = []
        for now, (above, seen) in zip(self._control(node), self._before(node), strict=True):
            do += [Assign(above, folded(now > 0)), Assign(seen, TRUE)]
        name = f"{self._named(node.block)}_trigger"
        return [Block(name, do, text=f"The trigger of {node.block.path}.")]


__all__ = ["TriggerWriter"]
