"""The inputs of a tick that are worth telling: those that lead to the next node, whatever the others are."""

from collections.abc import Callable, Mapping
from itertools import islice

from checker.system.partition import Partition
from checker.verify.reachable import ticks
from spec_model.lang.system import TransitionSystem

TOGETHER = 64
"""Ways through a tick that are tried to see whether an input matters."""
BUDGET = 20_000
"""Ticks tried for one graph: few enough not to be waited for, and counted so that it is always the same."""

Same = Callable[[Mapping[str, int]], bool]
"""Whether a valuation is behind the node in question."""


class Telling:
    """Leaves out inputs of example ticks that do not matter, as long as the budget lasts."""

    def __init__(
        self, system: TransitionSystem, cells: Mapping[str, Partition], budget: int = BUDGET
    ) -> None:
        self.system, self.budget = system, budget
        self.cells = {name: tuple(c.value for c in p.cells) for name, p in cells.items()}

    def told(self, before: Mapping[str, int], inputs: Mapping[str, int], same: Same) -> dict[str, int]:
        """Inputs with which every tick from the valuation ends behind the same node.

        More than these only where too many ways through the tick would have to be tried.
        """
        left = dict(inputs)
        for name in inputs:
            fewer = {n: raw for n, raw in left.items() if n != name}
            if self._enough(before, fewer, same):
                left = fewer
        return left

    def _enough(self, before: Mapping[str, int], fixed: Mapping[str, int], same: Same) -> bool:
        """Whether all ticks with the fixed inputs end behind the same node."""
        cells = {name: (fixed[name],) if name in fixed else own for name, own in self.cells.items()}
        most = min(TOGETHER, self.budget)
        for number, (after, _) in enumerate(islice(ticks(self.system, before, cells), most + 1), start=1):
            self.budget -= 1
            if number > most or not same(after):
                return False
        return self.budget > 0
