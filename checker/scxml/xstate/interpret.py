"""A machine of XState at work, by the algorithm of its version 5."""

from collections.abc import Mapping, Sequence

from rovercheck.checker.scxml.interpret import MachineRunner, Value
from rovercheck.checker.scxml.records import MachineState, MachineTransition, SendEvent, StateMachine


class XstateRunner(MachineRunner):
    """Runs a machine of XState; what can be asked of it is as of ``MachineRunner``.

    What differs from the standard: events come before eventless transitions, which are not asked again after
    one that changed nothing; a parallel state has a transition taken only if none of its regions has one; a
    transition to a descendant stays inside of its source; within a parallel state all regions are left.
    """

    def __init__(self, machine: StateMachine) -> None:
        super().__init__(machine)
        self._eventless, self._assigned = True, False
        self._due: list[SendEvent] = []
        self.at_once = 0
        """Delays that were over at the same time in the last step."""

    def _forget_last_step(self) -> None:
        super()._forget_last_step()
        self._eventless, self.at_once = not self._begun, 0

    def _pass_time(self) -> None:
        self._due = []
        for sent in self.machine.sends:
            if sent.number in self._waiting:
                self._waiting[sent.number] -= self.machine.tick
                if not self._waiting[sent.number]:
                    del self._waiting[sent.number]
                    self._due.append(sent)
        self.at_once = len(self._due)

    def _cancel(self, id: str) -> None:
        super()._cancel(id)
        self._due = [one for one in self._due if one.id != id]

    def _assign(self, name: str, value: Value) -> None:
        super()._assign(name, value)
        self._assigned = True

    def _unsettled(self) -> bool:
        waits = self._internal or self._external or self._due
        return bool(waits or (self._eventless and self._select(None)))

    def _turn(self) -> bool:
        enabled = self._select(None) if self._eventless else []
        if enabled:
            before, past = set(self.active), dict(self._past)
            self._assigned = False
            self._microstep(enabled)
            left = any(self._past.get(id) is not value for id, value in past.items())
            self._eventless = self._assigned or left or len(past) < len(self._past)
            self._eventless = self._eventless or set(self.active) != before
            return True
        if self._internal:
            event = self._internal.pop(0)
        elif self._external:
            event = self._external.pop(0)
        elif self._due:
            event = self._due.pop(0).event
        else:
            return False
        enabled = self._select(event)
        if enabled:
            self._microstep(enabled)
        self._eventless = True
        return True

    # --- which transitions ---------------------------------------------------------------------------------

    def _asks(self, word: str, event: str) -> bool:
        if word.endswith(".*"):
            return event == word[:-2] or event.startswith(word[:-1])
        return word in ("*", event)

    def _select(self, event: str | None) -> list[MachineTransition]:
        if event is not None:
            return self._without_conflicts(self._below(self.machine.root, event))
        found: list[MachineTransition] = []
        for state in self.active:
            one = self._first(state, None) if state.atomic else None
            if one is not None and one not in found:
                found.append(one)
        return self._without_conflicts(found)

    def _below(self, state: MachineState, event: str | None) -> list[MachineTransition]:
        """What the active states in a state choose; it chooses only if they do not."""
        found = [one for child in state.children if child in self.active for one in self._below(child, event)]
        if found:
            return found
        for one in state.transitions:
            asked = not one.events
            if event is not None:
                asked = any(self._asks(word, event) for word in one.events)
            if asked and (one.condition is None or self._value(one.condition)):
                return [one]
        return []

    # --- sets of states ------------------------------------------------------------------------------------

    def _effective(self, one: MachineTransition) -> list[MachineState]:
        return list(dict.fromkeys(super()._effective(one)))

    def _domain(self, one: MachineTransition) -> MachineState | None:
        root, targets = self.machine.root, self._effective(one)
        if not targets:
            return None
        if one.source is root:
            return root
        if one.internal and all(target is one.source or target.is_in(one.source) for target in targets):
            return one.source
        for state in targets[0].above():
            if all(other.is_in(state) for other in (*targets[1:], one.source)) and state is not root:
                return state
        return root.children[0] if one.internal else root

    # --- entering ------------------------------------------------------------------------------------------

    def _enter(self, enabled: Sequence[MachineTransition]) -> None:
        entry = _Entry(self._past)
        for one in enabled:
            domain = self._domain(one)
            for target in one.targets:
                stays = one.internal and one.source is target and one.source is domain
                if target.kind != "history" and not stays:
                    entry.add(target, begun=True)
                entry.down(target)
            for state in self._effective(one):
                assert domain is not None
                entry.up(state, domain, domain)
        completed: list[MachineState] = []
        for state in sorted(self._entered(entry.states), key=lambda one: one.number):
            if state not in self.active:
                self.active.append(state)
            self._handlers(state.on_entry)
            if state in entry.begun and state.initial is not None:
                self._run(state.initial.actions)
            if state.kind == "final":
                self._complete(state, completed)

    def _entered(self, states: Sequence[MachineState]) -> Sequence[MachineState]:
        """Of some states those that are entered: in version 5 also those that are active."""
        return states

    def _complete(self, final: MachineState, completed: list[MachineState]) -> None:
        parent = final.parent
        assert parent is not None and parent.parent is not None
        if parent.kind == "state":
            self._push(self._internal, f"{self.machine.done}{parent.known_as}")
        around = parent if parent.kind == "parallel" else parent.parent
        while around.kind == "parallel" and around not in completed and self._is_final(around):
            completed.append(around)
            self._push(self._internal, f"{self.machine.done}{around.known_as}")
            assert around.parent is not None
            around = around.parent
        if around is self.machine.root:
            self._running = False

    def _is_final(self, state: MachineState) -> bool:
        if state.kind == "parallel":
            return all(self._is_final(one) for one in state.children)
        inner = any(one.kind == "final" and one in self.active for one in state.children)
        return inner or state.kind == "final"


class _Entry:
    """The states that are entered, and those in which a beginning is."""

    def __init__(self, past: Mapping[str, list[MachineState]]) -> None:
        self.past = past
        self.states: list[MachineState] = []
        self.begun: list[MachineState] = []

    def add(self, state: MachineState, *, begun: bool = False) -> None:
        if state not in self.states:
            self.states.append(state)
        if begun and state not in self.begun:
            self.begun.append(state)

    def down(self, state: MachineState) -> None:
        if state.kind == "history":
            self._history(state)
        elif state.compound:
            assert state.initial is not None
            [child] = state.initial.targets
            self.add(child, begun=True)
            self.down(child)
        elif state.kind == "parallel":
            for region in state.children:
                if not any(one.is_in(region) for one in self.states):
                    self.add(region, begun=True)
                    self.down(region)

    def _history(self, state: MachineState) -> None:
        parent, initial = state.parent, state.initial
        assert parent is not None and initial is not None
        remembered = self.past.get(state.id)
        if remembered is None and initial is parent.initial and parent not in self.begun:
            self.begun.append(parent)
        found = initial.targets if remembered is None else remembered
        for one in found:
            self.add(one)
            self.down(one)
        for one in found:
            self.up(one, parent, None)

    def up(self, state: MachineState, top: MachineState, inside: MachineState | None) -> None:
        """What is around a state up to ``top``; a parallel ``inside`` has its other regions entered."""
        around = []
        if state is not top:
            for one in state.above():
                if one is top or one.parent is None:
                    break
                around.append(one)
        if inside is not None and inside.kind == "parallel":
            around.append(inside)
        for one in around:
            if one is not inside:
                self.add(one)
            if one.kind == "parallel":
                for region in one.children:
                    if not any(other.is_in(region) for other in self.states):
                        self.add(region)
                        self.down(region)


__all__ = ["XstateRunner"]
