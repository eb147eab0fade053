"""A machine of XState 4 as the program of its step."""

from collections.abc import Sequence
from functools import partial
from itertools import pairwise

from rovercheck.checker.drawn.lower.program import ProgramWriter
from rovercheck.checker.scxml.records import MachineState, MachineTransition, StateMachine
from rovercheck.checker.scxml.view import NONE, MachineView
from rovercheck.checker.scxml.xstate.lower import XstateWriter
from rovercheck.checker.scxml.xstate.version_4 import GOES_ON, NESTED, chain_to
from rovercheck.spec_model.lang.domain import boolean
from rovercheck.spec_model.lang.expr import FALSE, TRUE, Expr, Var, all_of


class Xstate4Writer(XstateWriter):
    """Writes the step of one machine of XState 4."""

    def __init__(
        self, machine: StateMachine, view: MachineView, data: dict[str, Var], writer: ProgramWriter
    ) -> None:
        super().__init__(machine, view, data, writer)
        for one in self.transitions:
            if one.internal and one.targets:
                self.domains[one] = self._deepest(chain_to(one.targets[0]))
        self.waits = writer.temporary("an event waits", boolean)

    def _deepest(self, path: Sequence[MachineState]) -> list[tuple[Expr, MachineState | None]]:
        """What is left by an internal transition: what is in the deepest active state of its path."""
        found: list[tuple[Expr, MachineState | None]] = [
            (all_of(self.active[one], ~self.active[inner]), one) for one, inner in pairwise(path)
        ]
        return [*found, (self.active[path[-1]], path[-1])]

    def _live(self, event: Var, begun: Var) -> None:
        self.writer.assign(self.waits, FALSE)
        super()._live(event, begun)

    def _again(self) -> Expr:
        return TRUE

    def _hierarchical(self, wanted: Sequence[MachineTransition]) -> bool:
        return True

    def _microstep(self) -> None:
        self.writer.assign(self.waits, self.internal[0] != NONE)
        super()._microstep()
        self.writer.choose(all_of(self.ended, self.waits), partial(self.writer.fault, GOES_ON))
        self.writer.assign(self.waits, FALSE)

    def _plans(self, one: MachineTransition) -> None:
        if one.internal and one.targets:
            for state in chain_to(one.targets[0]):
                self.writer.choose(
                    ~self.active[state], partial(self.writer.assign, self.entered[state], TRUE)
                )
            return
        super()._plans(one)

    def _complete(self, state: MachineState) -> None:
        parent = state.parent
        assert parent is not None and parent.parent is not None
        if parent.parent is self.machine.root:
            return
        self._push(self.internal, f"{self.machine.done}{parent.known_as}")
        around = parent.parent
        if around.kind == "parallel":
            whole = partial(self._push, self.internal, f"{self.machine.done}{around.known_as}")
            self.writer.choose(self._is_final(around), whole)

    def _push(self, queue: Sequence[Var], event: str) -> None:
        if queue is self.internal and event in self.view.event_names:
            self.writer.choose(self.waits, partial(self.writer.fault, NESTED))
        super()._push(queue, event)


__all__ = ["Xstate4Writer"]
