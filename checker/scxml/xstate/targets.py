"""Transitions of XState: their targets as names lead to them, delays, and what may come together."""

import re
from collections.abc import Iterator, Mapping

from rovercheck.checker.io.json_lines import JsonValue
from rovercheck.checker.scxml.records import (
    CancelEvent,
    MachineState,
    MachineTransition,
    NamedAction,
    SendEvent,
)
from rovercheck.checker.scxml.xstate.content import XstateContent
from rovercheck.spec_model.lang.errors import brief, did_you_mean

KNOWN = frozenset({"target", "guard", "cond", "actions", "reenter", "internal"})
SAID = frozenset({"description", "meta"})


def in_order_of_javascript(members: Mapping[str, JsonValue]) -> list[tuple[str, JsonValue]]:
    """The members of an object as JavaScript goes through them: first names that are numbers, by size."""
    numbers = [one for one in members if re.fullmatch(r"0|[1-9][0-9]{0,9}", one) and int(one) < (1 << 32) - 1]
    names = [*sorted(numbers, key=int), *(one for one in members if one not in numbers)]
    return [(one, members[one]) for one in names]


class TransitionReader:
    """Reads the transitions of a machine whose states are known."""

    def __init__(
        self, content: XstateContent, top: MachineState, pseudo: MachineState, states: list[MachineState]
    ) -> None:
        self.content, self.top, self.states = content, top, states
        self.ids: dict[str, MachineState] = {}
        self.children: dict[MachineState, dict[str, MachineState]] = {one: {} for one in states}
        for one in states:
            if one.known_as in self.ids:
                content.fault(_at(one.line), f"the id {brief(one.known_as)} a second time. Give each its own")
            self.ids[one.known_as] = one
            if one.parent is not None and one.parent is not pseudo:
                self.children[one.parent][one.known_path.rpartition(".")[2]] = one
        pseudo.initial = MachineTransition(pseudo, targets=(top,), line=top.line)

    # --- where something begins ----------------------------------------------------------------------------

    def initial(self, state: MachineState, value: JsonValue | None) -> MachineTransition:
        """Where a compound state begins."""
        inner = (value.object or {}) if value is not None else {}
        if inner and self.content.version == 4:
            self.content.fault(_at(state.line), f"an `initial` of {state.id} with actions, of XState 5")
        name = inner.get("target", value) if inner else value
        if name is not None and name.list is not None and len(name.list) == 1:
            name = name.list[0]
        child = self.children[state].get(name.text or "") if name is not None else None
        if child is None or child.kind == "history" or value is None:
            at = value or _at(state.line)
            said = "no `initial`" if value is None else "an `initial` that is none of its states"
            self.content.fault(at, f"the state {state.id} has {said}. Name one that is no history")
            child = next(iter(state.children))
        actions = self.content.actions(inner.get("actions"))
        return MachineTransition(state, targets=(child,), actions=actions, line=state.line)

    def history(self, state: MachineState, value: JsonValue | None) -> MachineTransition:
        """Where a history begins that has no past."""
        parent = state.parent
        assert parent is not None
        if value is not None and not value.null:
            targets = self._targets(parent, value, of_history=True)
            if any(one.kind == "history" for one in targets):
                self.content.fault(value, "a history that begins in a history. Name a state")
            elif not all(one.is_in(parent) for one in targets):
                self.content.fault(value, f"a history that begins outside of {parent.id}. Name a state in it")
            return MachineTransition(state, targets=targets, line=state.line)
        if parent.kind == "parallel":
            return MachineTransition(state, targets=(parent,), line=state.line)
        assert parent.initial is not None
        return parent.initial

    # --- transitions ---------------------------------------------------------------------------------------

    def transitions(
        self, state: MachineState, element: Mapping[str, JsonValue]
    ) -> tuple[tuple[SendEvent, ...], tuple[CancelEvent, ...]]:
        """Read the transitions of a state, and return what its delays do at entry and exit."""
        found: list[tuple[str, JsonValue]] = []
        eventless: list[MachineTransition] = []
        for descriptor, value in self._members(element, "on"):
            if descriptor == "" and self.content.version == 4:
                eventless += self._each("", value, state)
            elif not self._fit(descriptor):
                self.content.fault(value, f"the event {brief(descriptor)}. Write a name, `*`, or `name.*`")
            else:
                found.append((descriptor, value))
        if "always" in element:
            eventless += self._each("", element["always"], state)
        if "onDone" in element:
            done = "xstate.done.state." if self.content.version == 5 else "done.state."
            found.append((f"{done}{state.known_as}", element["onDone"]))
        sends: list[SendEvent] = []
        for name, value in self._members(element, "after"):
            sent = self._delay(state, name, value)
            if sent is not None:
                sends.append(sent)
                found.append((sent.event, value))
        late = {one.event for one in sends} if self.content.version == 4 else set()  # after `*` there
        found.sort(key=lambda one: (one[0] in late, _wild(one[0]), -len(one[0]) if _wild(one[0]) else 0))
        state.transitions = eventless
        for descriptor, value in found:
            state.transitions += self._each(descriptor, value, state)
        for number, one in enumerate(state.transitions, start=1):
            one.order = number
        return tuple(sends), tuple(CancelEvent(one.id) for one in sends)

    def _fit(self, descriptor: str) -> bool:
        stem = descriptor.removesuffix(".*") if self.content.version == 5 else descriptor
        return descriptor == "*" or bool(re.fullmatch(r"[^*\x00-\x1f\x7f-\x9f()]{1,200}", stem))

    def _members(self, element: Mapping[str, JsonValue], key: str) -> list[tuple[str, JsonValue]]:
        value = element.get(key)
        if value is None or value.null:
            return []
        if value.object is None:
            self.content.fault(value, f"`{key}`, which is no object. Write {{ NAME: 'target' }}")
            return []
        return in_order_of_javascript(value.object)

    def _delay(self, state: MachineState, name: str, value: JsonValue) -> SendEvent | None:
        content = self.content
        content.used.add(("delay", name))
        delay = int(name) if re.fullmatch(r"[0-9]{1,9}", name) else content.bindings.delays.get(name)
        if not delay:
            said = "which comes after the step. Write `always`" if delay == 0 else (
                f"which has no length here. Write it below [delays] in {content.bindings.path.name}"
            )  # fmt: skip
            content.fault(value, f"the delay {brief(name)}, {said}")
            return None
        form = "xstate.after.{}.{}" if content.version == 5 else "xstate.after({})#{}"
        event = form.format(name, state.known_as)
        made = SendEvent(len(content.sends) + 1, event, delay, event, value.line)
        content.sends.append(made)
        return made

    def _each(self, descriptor: str, value: JsonValue, state: MachineState) -> Iterator[MachineTransition]:
        for one in value.list if value.list is not None else [value]:
            yield self._transition(descriptor, one, state)

    def _transition(self, descriptor: str, value: JsonValue, state: MachineState) -> MachineTransition:
        content = self.content
        events = (descriptor,) if descriptor else ()
        if value.object is None:
            targets = self._targets(state, value)
            return MachineTransition(
                state, events, targets=targets, internal=self._inside(value, None, state), line=value.line
            )
        inner = value.object
        for key, one in inner.items():
            if key not in KNOWN | SAID:
                content.fault(one, f"`{brief(key)[1:-1]}` of a transition. {did_you_mean(key, KNOWN)}")
        for key in ("reenter", "internal"):
            if key in inner and not isinstance(inner[key].plain, bool):
                content.fault(inner[key], f"`{key}` that is not true or false")
        guard = inner.get("guard", inner.get("cond"))
        target = inner.get("target")
        targets = () if target is None else self._targets(state, target)
        made = MachineTransition(
            state, events, content.guard(guard), content.label(guard), targets,
            self._inside(target, inner.get("reenter", inner.get("internal")), state),
            content.actions(inner.get("actions")), line=value.line,
        )  # fmt: skip
        if not targets and "actions" not in inner:
            content.idle.append(f"{state.id} {descriptor or 'always'} (line {value.line})")
        return made

    def _inside(self, target: JsonValue | None, said: JsonValue | None, state: MachineState) -> bool:
        """Whether its source is not left where all targets are in it."""
        if self.content.version == 5:
            return said is None or said.plain is not True
        if said is not None:
            return said.plain is True
        names = [] if target is None else target.list if target.list is not None else [target]
        return not names or any((one.text or "").startswith(".") for one in names)

    # --- targets -------------------------------------------------------------------------------------------

    def _targets(
        self, state: MachineState, value: JsonValue, *, of_history: bool = False
    ) -> tuple[MachineState, ...]:
        if value.text == "":
            return ()
        found: list[MachineState] = []
        for one in value.list if value.list is not None else [value]:
            name = one.text
            target = None if not name else self._target(state, name, of_history)
            if target is None:
                known = [other.known_path.rpartition(".")[2] for other in self.states]
                self.content.fault(
                    one, f"the target {brief(name or 'null')} of {state.id}, which is no state. "
                    f"{did_you_mean(name or '', known)}"
                )  # fmt: skip
            elif target not in found:
                found.append(target)
        self._together(value, found)
        return tuple(found)

    def _target(self, state: MachineState, name: str, of_history: bool) -> MachineState | None:
        if name.startswith("#"):
            id, _, rest = name[1:].partition(".")
            if name[1:] in self.ids:
                return self.ids[name[1:]]
            return self._walk(self.ids.get(id), rest)
        if of_history:
            return self._walk(state, name)
        if state is self.top:
            if not name.startswith(".") and self.content.version == 5:
                return None
            return self._walk(state, name.removeprefix("."))
        if name.startswith("."):
            return self._walk(state, name[1:])
        assert state.parent is not None
        return self._walk(state.parent, name)

    def _walk(self, state: MachineState | None, path: str) -> MachineState | None:
        for name in path.split(".") if path else ():
            state = None if state is None else self.children[state].get(name)
        return state

    def _together(self, value: JsonValue, targets: list[MachineState]) -> None:
        for place, one in enumerate(targets):
            for other in targets[:place]:
                lines = [one, *one.above()], [other, *other.above()]
                common = next(a for a in lines[0] if any(a is b for b in lines[1]))
                if common.kind != "parallel" or common in (one, other):
                    self.content.fault(
                        value, f"the targets {other.id} and {one.id} together, which exclude each other"
                    )

    # --- order ---------------------------------------------------------------------------------------------

    def check(self) -> None:
        """Tell what XState does in no way that could be relied on."""
        self._histories()
        self._orders()

    def _histories(self) -> None:
        """A history of a parallel state that begins with the state itself is entered from outside."""
        for state in self.states:
            for one in state.transitions:
                for target in filter(_begins_with_parent, one.targets):
                    parent = target.parent
                    if parent is not None and (state is parent or state.is_in(parent)):
                        self.content.fault(
                            _at(one.line), f"the target {target.id} from inside of {parent.id}, where XState "
                            "leaves states that it does not enter again. Give the history a target"
                        )  # fmt: skip

    def _orders(self) -> None:
        """In XState the order of `always` in two regions is that in which they were entered last."""
        found = [state for state in self.states if any(_matters(one) for one in state.transitions)]
        for place, one in enumerate(found):
            other = next((two for two in found[:place] if _at_once(one, two)), None)
            if other is not None:
                self.content.fault(
                    _at(one.line), f"`always` of {other.id} and {one.id} may be taken at once, in the "
                    "order in which their regions were entered. Let one of them only name actions without "
                    "a binding, and stay in its region"
                )  # fmt: skip


def _begins_with_parent(target: MachineState) -> bool:
    begun = () if target.kind != "history" or target.initial is None else target.initial.targets
    return any(one is target.parent for one in begun)


def _wild(descriptor: str) -> bool:
    return descriptor == "*" or descriptor.endswith(".*")


def _at(line: int) -> JsonValue:
    return JsonValue(line)


def _at_once(a: MachineState, b: MachineState) -> bool:
    """Whether both may take a transition: they are in two regions, or one is around a parallel state."""
    for inner, outer in ((a, b), (b, a)):
        if inner.is_in(outer):
            between = [state for state in inner.above() if state is outer or state.is_in(outer)]
            return any(state.kind == "parallel" for state in between)
    lines = [a, *a.above()], [b, *b.above()]
    return next(x for x in lines[0] if any(x is y for y in lines[1])).kind == "parallel"


def _matters(one: MachineTransition) -> bool:
    """Whether the order of an eventless one can be seen: it changes data, raises, or leaves its region."""
    if one.events:
        return False
    if any(not isinstance(action, NamedAction) for action in one.actions):
        return True
    region = next((state for state in (one.source, *one.source.above()) if _is_region(state)), None)
    return region is None or not all(_stays(target, region) for target in one.targets)


def _is_region(state: MachineState) -> bool:
    return state.parent is not None and state.parent.kind == "parallel"


def _stays(target: MachineState, region: MachineState) -> bool:
    return target is not region and target.is_in(region)


__all__ = ["TransitionReader", "in_order_of_javascript"]
