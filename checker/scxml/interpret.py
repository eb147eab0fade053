"""A machine at work, by the algorithm that the standard prints (appendix D), on numbers."""

from collections.abc import Callable, Mapping, Sequence

from rovercheck.checker.drawn.faults import DrawnFault
from rovercheck.checker.scxml.records import (
    MOST_MICROSTEPS,
    MOST_WAITING,
    OTHER,
    AssignDatum,
    CancelEvent,
    Choose,
    Constant,
    DatumName,
    EventDatum,
    Executable,
    FreeGuard,
    InState,
    MachineState,
    MachineTransition,
    NamedAction,
    Operation,
    RaiseEvent,
    ScxmlExpression,
    SendEvent,
    StateMachine,
)

Value = bool | int
_OPERATORS: Mapping[str, Callable[..., Value]] = {
    "+": lambda a, b: a + b, "-": lambda a, b: a - b, "*": lambda a, b: a * b, "neg": lambda a: -a,
    "!": lambda a: not a, "==": lambda a, b: a == b, "!=": lambda a, b: a != b, "<": lambda a, b: a < b,
    "<=": lambda a, b: a <= b, ">": lambda a, b: a > b, ">=": lambda a, b: a >= b,
    "&&": lambda a, b: a and b, "||": lambda a, b: a or b, "?": lambda a, b, c: b if a else c,
    "abs": abs, "max": max, "min": min, "floor": lambda a, b: a // b,
    "%": lambda a, b: a % b if a >= 0 else -(-a % b),
}  # fmt: skip


class MachineRunner:
    """Runs a machine.  The first step enters it; each step takes one event, or lets time pass.

    ``active`` are the states that are active, ``data`` the values, ``fired`` the transitions of the last
    step, ``ran`` the actions in it that are known by name only.  A step without a meaning raises
    ``DrawnFault``: an event that no queue holds, more than ``most`` microsteps.
    """

    def __init__(self, machine: StateMachine, most: int = MOST_MICROSTEPS) -> None:
        self.machine, self._most = machine, most
        self.data: dict[str, Value] = dict(machine.data)
        self.active: list[MachineState] = []
        self.fired: list[MachineTransition] = []
        self.ran: set[str] = set()
        self._guards: Mapping[str, bool] = {}
        self._carried: Mapping[str, Value] = {}
        self._past: dict[str, list[MachineState]] = {}
        self._internal: list[str] = []
        self._external: list[str] = []
        self._waiting: dict[int, int] = {}
        self._begun, self._running = False, True

    def step(
        self,
        event: str = "",
        guards: Mapping[str, bool] | None = None,
        carried: Mapping[str, Value] | None = None,
    ) -> None:
        """One step: everything that follows from an event; an empty one lets time pass.

        The first step enters the machine before it takes its event, with the data that it has ``carried``.
        ``guards`` are those that are known by name only, and hold in this step; the others do not.
        """
        self._guards, self._carried = guards or {}, carried or {}
        self._forget_last_step()
        if not self._running:
            return
        begun, self._begun = self._begun, True
        if not begun:
            initial = self.machine.root.initial
            assert initial is not None
            self._enter([initial])
        elif not event:
            self._pass_time()
        if event:
            self._external.append(event)
        for _ in range(self._most):
            if not self._running or not self._turn():
                break
        else:
            if self._running and self._unsettled():
                raise DrawnFault(f"a step needs more than {self._most} microsteps")
        if not self._running:
            self._exit_interpreter()

    def _forget_last_step(self) -> None:
        self.fired, self.ran = [], set()

    def _pass_time(self) -> None:
        for number in sorted(self._waiting):
            self._waiting[number] -= self.machine.tick
            if not self._waiting[number]:
                del self._waiting[number]
                self._push(self._external, self.machine.sends[number - 1].event)

    def _unsettled(self) -> bool:
        return bool(self._internal or self._external or self._select(None))

    def _turn(self) -> bool:
        """One turn of the main loop; whether there was anything to do."""
        enabled = self._select(None)
        if not enabled:
            if self._internal:
                event = self._internal.pop(0)
            elif self._external:
                event = self._external.pop(0)
            else:
                return False
            enabled = self._select(event)
        if enabled:
            self._microstep(enabled)
        return True

    # --- which transitions ---------------------------------------------------------------------------------

    def _select(self, event: str | None) -> list[MachineTransition]:
        found: list[MachineTransition] = []
        for state in sorted(self.active, key=lambda one: one.number):
            if state.atomic:
                one = self._first(state, event)
                if one is not None and one not in found:
                    found.append(one)
        return self._without_conflicts(found)

    def _first(self, atomic: MachineState, event: str | None) -> MachineTransition | None:
        for state in (atomic, *atomic.above()):
            for one in state.transitions:
                if event is None and one.events:
                    continue
                if event is not None and not any(self._asks(word, event) for word in one.events):
                    continue
                if one.condition is None or self._value(one.condition):
                    return one
        return None

    def _without_conflicts(self, enabled: Sequence[MachineTransition]) -> list[MachineTransition]:
        kept: list[MachineTransition] = []
        for one in enabled:
            removed, preempted = [], False
            for other in kept:
                if any(state in self._exits([other]) for state in self._exits([one])):
                    if one.source.is_in(other.source):
                        removed.append(other)
                    else:
                        preempted = True
                        break
            if not preempted:
                kept = [other for other in kept if other not in removed] + [one]
        return kept

    # --- sets of states ------------------------------------------------------------------------------------

    def _effective(self, one: MachineTransition) -> list[MachineState]:
        found: list[MachineState] = []
        for target in one.targets:
            if target.kind != "history":
                found.append(target)
            elif target.id in self._past:
                found += self._past[target.id]
            else:
                assert target.initial is not None
                found += self._effective(target.initial)
        return found

    def _domain(self, one: MachineTransition) -> MachineState | None:
        targets = self._effective(one)
        if not targets:
            return None
        if one.internal and one.source.compound and all(target.is_in(one.source) for target in targets):
            return one.source
        for state in one.source.above():
            if (state.compound or state.parent is None) and all(target.is_in(state) for target in targets):
                return state
        return self.machine.root

    def _exits(self, enabled: Sequence[MachineTransition]) -> list[MachineState]:
        found: list[MachineState] = []
        for one in enabled:
            domain = self._domain(one)
            if domain is not None:
                found += [state for state in self.active if state.is_in(domain) and state not in found]
        return found

    # --- a microstep ---------------------------------------------------------------------------------------

    def _microstep(self, enabled: Sequence[MachineTransition]) -> None:
        self.fired += enabled
        leaving = sorted(self._exits(enabled), key=lambda one: -one.number)
        for state in leaving:
            for history in state.histories:
                self._past[history.id] = [
                    one for one in self.active
                    if (one.atomic and one.is_in(state) if history.deep else one.parent is state)
                ]  # fmt: skip
        for state in leaving:
            self._handlers(state.on_exit)
            self.active.remove(state)
        for one in enabled:
            self._run(one.actions)
        self._enter(enabled)

    def _enter(self, enabled: Sequence[MachineTransition]) -> None:
        entry = _EntrySet(self._past)
        for one in enabled:
            if not one.targets:
                continue
            domain = self.machine.root if one.source is self.machine.root else self._domain(one)
            for target in one.targets:
                entry.add_descendants(target)
            for target in self._effective(one):
                entry.add_ancestors(target, domain)
        for state in sorted(entry.states, key=lambda one: one.number):
            if state not in self.active:  # a history may enter what was not left
                self.active.append(state)
            self._handlers(state.on_entry)
            if state in entry.by_default and state.initial is not None:
                self._run(state.initial.actions)
            self._run(entry.history_content.get(state.id, ()))
            if state.kind == "final":
                self._done(state)

    def _done(self, final: MachineState) -> None:
        parent = final.parent
        assert parent is not None
        if parent.parent is None:
            self._running = False
            return
        self._push(self._internal, f"done.state.{parent.id}")
        above = parent.parent
        if above.kind == "parallel" and all(self._is_final(one) for one in above.children):
            self._push(self._internal, f"done.state.{above.id}")

    def _is_final(self, state: MachineState) -> bool:
        if state.compound:
            return any(one.kind == "final" and one in self.active for one in state.children)
        return state.kind == "parallel" and all(self._is_final(one) for one in state.children)

    def _exit_interpreter(self) -> None:
        """The machine has ended: everything is left, and what was active stays to be seen.

        Only a final state of the machine is active then, so that nothing sees whether it is removed.
        """
        for state in sorted(self.active, key=lambda one: -one.number):
            self._handlers(state.on_exit)
        self._internal, self._external, self._waiting = [], [], {}

    # --- executable content --------------------------------------------------------------------------------

    def _handlers(self, handlers: Sequence[Sequence[Executable]]) -> None:
        for one in handlers:
            self._run(one)

    def _run(self, actions: Sequence[Executable]) -> None:
        for one in actions:
            match one:
                case RaiseEvent(event):
                    self._push(self._internal, event)
                case SendEvent(_, event, 0):
                    self._push(self._external, event)
                case SendEvent(number, event, delay):
                    if number in self._waiting:
                        raise DrawnFault(f"{event} is sent again (line {one.line}) before its delay is over")
                    self._waiting[number] = delay
                case CancelEvent(id):
                    self._cancel(id)
                case NamedAction(name):
                    self.ran.add(name)
                case AssignDatum(name, value):
                    self._assign(name, self._value(value))
                case Choose(branches):
                    for condition, inner in branches:
                        if condition is None or self._value(condition):
                            self._run(inner)
                            break

    def _cancel(self, id: str) -> None:
        for sent in self.machine.sends:
            if sent.id == id:
                self._waiting.pop(sent.number, None)

    def _assign(self, name: str, value: Value) -> None:
        self.data[name] = value

    def _asks(self, word: str, event: str) -> bool:
        """Whether a descriptor matches the name of an event."""
        if word == "*":
            return True
        words, names = word.split("."), event.split(".")
        return event != OTHER and words == names[: len(words)]

    def _awaited(self, event: str) -> bool:
        return any(
            self._asks(word, event)
            for state in self.machine.states for one in state.transitions for word in one.events
        )  # fmt: skip

    def _push(self, queue: list[str], event: str) -> None:
        if event not in self.machine.internal and not self._awaited(event):
            return
        if len(queue) == MOST_WAITING:
            raise DrawnFault(f"more than {MOST_WAITING} events wait at once")
        queue.append(event)

    def _value(self, one: ScxmlExpression) -> Value:
        match one:
            case Constant(value):
                return value
            case DatumName(name):
                return self.data[name]
            case EventDatum(name):
                return self._carried[name]
            case InState(id):
                return any(state.id == id for state in self.active)
            case FreeGuard(name):
                return self._guards.get(name, False)
            case Operation(operator, operands):
                return _OPERATORS[operator](*(self._value(inner) for inner in operands))


class _EntrySet:
    """The states that are entered, and which of them by default."""

    def __init__(self, past: Mapping[str, list[MachineState]]) -> None:
        self.past = past
        self.states: list[MachineState] = []
        self.by_default: list[MachineState] = []
        self.history_content: dict[str, tuple[Executable, ...]] = {}

    def _add(self, state: MachineState) -> None:
        if state not in self.states:
            self.states.append(state)

    def add_descendants(self, state: MachineState) -> None:
        if state.kind == "history":
            assert state.parent is not None and state.initial is not None
            if state.id not in self.past:
                self.history_content[state.parent.id] = state.initial.actions
            targets = self.past.get(state.id, state.initial.targets)
            self._all(targets, state.parent)
            return
        self._add(state)
        if state.compound:
            assert state.initial is not None
            if state not in self.by_default:
                self.by_default.append(state)
            self._all(state.initial.targets, state)
        elif state.kind == "parallel":
            self._regions(state)

    def _all(self, targets: Sequence[MachineState], above: MachineState) -> None:
        for one in targets:
            self.add_descendants(one)
        for one in targets:
            self.add_ancestors(one, above)

    def _regions(self, state: MachineState) -> None:
        for child in state.children:
            if not any(one.is_in(child) for one in self.states):
                self.add_descendants(child)

    def add_ancestors(self, state: MachineState, domain: MachineState | None) -> None:
        for one in state.above():
            if one is domain or one.parent is None:
                return
            self._add(one)
            if one.kind == "parallel":
                self._regions(one)


__all__ = ["MachineRunner"]
