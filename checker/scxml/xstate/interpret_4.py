"""A machine of XState 4 at work, where the algorithm of that version has a plain meaning."""

from collections.abc import Sequence

from rovercheck.checker.drawn.faults import DrawnFault
from rovercheck.checker.scxml.records import MachineState, MachineTransition, StateMachine
from rovercheck.checker.scxml.xstate.interpret import XstateRunner
from rovercheck.checker.scxml.xstate.version_4 import GOES_ON, NESTED


class Xstate4Runner(XstateRunner):
    """Runs a machine of XState 4.

    What differs from version 5: an internal transition leaves and enters only what differs; regions take
    eventless transitions as they take events; a parallel state around one that is done is not done by it.
    """

    def __init__(self, machine: StateMachine) -> None:
        super().__init__(machine)
        self._waits = False

    def _turn(self) -> bool:
        found = super()._turn()
        self._eventless = self._eventless or found
        return found

    def _select(self, event: str | None) -> list[MachineTransition]:
        return self._without_conflicts(self._below(self.machine.root, event))

    def _domain(self, one: MachineTransition) -> MachineState | None:
        if not one.internal or not one.targets:
            return super()._domain(one)
        state = one.targets[0]
        while state not in self.active:
            assert state.parent is not None
            state = state.parent
        while state.compound and state.initial is not None and state.initial.targets[0] in self.active:
            if not (state is one.targets[0] or state.is_in(one.targets[0])):
                break
            state = state.initial.targets[0]
        return state

    def _microstep(self, enabled: Sequence[MachineTransition]) -> None:
        self._waits = bool(self._internal)
        super()._microstep(enabled)
        if self._is_final(self.machine.root.children[0]):
            if self._waits:
                raise DrawnFault(GOES_ON)
            self._running = False
        self._waits = False

    def _entered(self, states: Sequence[MachineState]) -> Sequence[MachineState]:
        return [one for one in states if one not in self.active]

    def _complete(self, final: MachineState, completed: list[MachineState]) -> None:
        parent = final.parent
        assert parent is not None and parent.parent is not None
        if parent.parent is self.machine.root:
            return
        self._push(self._internal, f"{self.machine.done}{parent.known_as}")
        around = parent.parent
        if around.kind == "parallel" and self._is_final(around):
            self._push(self._internal, f"{self.machine.done}{around.known_as}")

    def _push(self, queue: list[str], event: str) -> None:
        if queue is self._internal and self._waits and self._awaited(event):
            raise DrawnFault(NESTED)
        super()._push(queue, event)


__all__ = ["Xstate4Runner"]
