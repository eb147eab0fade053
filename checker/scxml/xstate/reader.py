"""Machines of XState in JSON: states and what is in them, or what has no meaning here, with its line."""

import re
from collections.abc import Collection, Iterator, Mapping
from math import gcd
from pathlib import Path

from rovercheck.checker.io.bounded import bounded_bytes
from rovercheck.checker.io.json_lines import JsonValue, parsed_json
from rovercheck.checker.scxml.records import OTHER, MachineState, StateKind, StateMachine
from rovercheck.checker.scxml.xstate.bindings import Bindings, bindings_path, read_bindings
from rovercheck.checker.scxml.xstate.content import XstateContent
from rovercheck.checker.scxml.xstate.targets import TransitionReader, in_order_of_javascript
from rovercheck.checker.scxml.xstate.version_4 import check_version_4
from rovercheck.spec_model.lang.errors import ModelError, brief, did_you_mean

LARGEST = 16 << 20
"""Bytes of a file."""
MOST_STATES = 2000
KINDS: Mapping[str, StateKind] = {
    "atomic": "state", "compound": "state", "parallel": "parallel", "final": "final", "history": "history"
}  # fmt: skip
SAID = frozenset({
    "key", "description", "meta", "tags", "version", "output", "data", "types", "tsTypes", "schema",
    "schemas", "predictableActionArguments", "preserveActionOrder", "order", "delimiter",
})  # fmt: skip
"""What changes nothing of what a machine does."""
KNOWN = frozenset({
    "id", "initial", "states", "on", "always", "after", "entry", "exit", "type", "history", "target",
    "onDone", "context",
})  # fmt: skip
REFUSED = {
    "invoke": "another actor. Write what it sends as events from outside (`on`)",
    "activities": "activities. Write what they send as events from outside (`on`)",
    "route": "routes. Write transitions",
    "strict": "a machine that throws for an event that it does not know. Remove it",
}


def read_xstate(path: Path) -> StateMachine:
    """The machine in a file, with the bindings beside it.

    Raises ``ModelError`` for what cannot be read or has no meaning, with lines.
    """
    data = bounded_bytes(path, LARGEST, "Name a machine of XState, JSON.stringify(machine.config).")
    return xstate_machine_of(data, path.name, read_bindings(bindings_path(path)))


def xstate_machine_of(data: bytes, place: str, bindings: Bindings) -> StateMachine:
    """The same of a text, which stands at ``place``."""
    root = parsed_json(data, place)
    if root.object is None or not root.object.keys() & {"states", "initial"}:
        raise ModelError(
            f"{place}, line {root.line}: this JSON is no machine of XState, an object with `states`. "
            "Write JSON.stringify(machine.config) to a file."
        )
    if {"key", "transitions", "order"} <= root.object.keys():
        raise ModelError(
            f"{place}, line {root.line}: this is machine.definition, in which XState 5 leaves out "
            "`always` and the context. Write JSON.stringify(machine.config) instead."
        )
    return _Reader(root, place, bindings).machine()


class _Reader:
    def __init__(self, root: JsonValue, place: str, bindings: Bindings) -> None:
        self.root, self.place = root, place
        self.states: list[MachineState] = []
        self.elements: list[tuple[MachineState, dict[str, JsonValue]]] = []
        self.content = XstateContent(place, bindings)
        self.content.version = self._version(bindings)
        self.pseudo = MachineState("", "state", None, 0, root.line)

    def _version(self, bindings: Bindings) -> int:
        """4 or 5; of a machine that does not say it, 5."""
        words = set(_words(self.root))
        four, five = words & {"cond", "internal"}, words & {"guard", "reenter"}
        if four and five:
            raise ModelError(
                f"{self.place}, line {self.root.line}: `{sorted(four)[0]}` is of XState 4, and "
                f"`{sorted(five)[0]}` of XState 5. Write one of both throughout."
            )
        said = 4 if four else 5 if five else None
        if said is not None and bindings.version not in (None, said):
            raise ModelError(f"{bindings.path}: version = {bindings.version}, but the machine is of {said}.")
        return said or bindings.version or 5

    def machine(self) -> StateMachine:
        content = self.content
        id = self.root.object["id"] if self.root.object and "id" in self.root.object else None
        name = "(machine)" if id is None or not id.text else id.text
        content.read_context(self.root)
        top = self._state(self.pseudo, name, self.root)
        if not self.states or not self.states[0].children:
            content.fault(self.root, "a machine without states. Write one")
        content.stop()
        assert top is not None
        content.states = frozenset(one.id for one in self.states)
        content.check_bindings()
        reader = TransitionReader(content, top, self.pseudo, self.states)
        for state, element in self.elements:
            self._begin(reader, state, element)
        for state, element in self.elements:
            self._fill(reader, state, element)
        content.stop()
        content.check_used()
        if content.version == 5:
            reader.check()
        else:
            check_version_4(content, self.states)
        content.stop()
        return self._made(name)

    def _made(self, name: str) -> StateMachine:
        content = self.content
        done = "xstate.done.state." if content.version == 5 else "done.state."
        own = {one.event for one in content.sends} | content.raised
        own |= {f"{done}{one.known_as}" for one in self.states if one.compound or one.kind == "parallel"}
        waited = list(dict.fromkeys(d for one in self.states for t in one.transitions for d in t.events))
        offered = {_offered(one) for one in waited} - own
        offered = {one for one in offered if not one.startswith(("xstate.", "done.", "error."))}
        eventless = any(not t.events for one in self.states for t in one.transitions)
        internal = sorted(own if eventless and content.version == 5 else _answered(own, waited))
        made = re.sub(r"\W+", "_", name).strip("_") or "Machine"
        return StateMachine(
            made, self.pseudo, tuple(self.states), content.data, tuple(content.sends), tuple(sorted(offered)),
            tuple(internal), gcd(*(one.delay for one in content.sends)), "xstate", content.version, done,
            tuple(content.free_guards), tuple(content.free_actions), f"XState {content.version}",
            tuple(content.notes()),
        )  # fmt: skip

    # --- states --------------------------------------------------------------------------------------------

    def _state(self, parent: MachineState, key: str, value: JsonValue) -> MachineState | None:
        content = self.content
        if value.object is None:
            content.fault(value, f"the state {brief(key)} is no object. Write {{}}")
            return None
        element = value.object
        if parent is not self.pseudo and not re.fullmatch(r"[^.#\\\x00-\x1f\x7f-\x9f]{1,100}", key):
            content.fault(value, f"the name of a state {brief(key)}. Write one without . # and \\")
            return None
        if len(self.states) >= MOST_STATES:
            raise ModelError(f"{self.place}, line {value.line}: more than {MOST_STATES} states are not read.")
        inner = self._inner(element)
        kind = self._kind(element, bool(inner), value)
        whole = key if parent is self.pseudo or parent.parent is self.pseudo else f"{parent.id}.{key}"
        made = MachineState(whole, kind, parent, len(self.states) + 1, value.line)
        above = "" if parent is self.pseudo else f"{parent.known_path}."
        made.known_path = f"{above}{key}"
        made.known_as = made.known_path
        if "id" in element and element["id"].text:
            made.known_as = element["id"].text or ""
        made.deep = "history" in element and element["history"].text == "deep"
        self.states.append(made)
        (parent.histories if kind == "history" else parent.children).append(made)
        self._known(element)
        self.elements.append((made, element))
        for name, one in in_order_of_javascript(inner):
            self._state(made, name, one)
        if parent is self.pseudo and any(one.id == made.id for one in self.states[1:]):
            made.id = f"{made.id} (machine)"
        return made

    def _inner(self, element: dict[str, JsonValue]) -> dict[str, JsonValue]:
        value = element.get("states")
        if value is None or value.null:
            return {}
        if value.object is None:
            self.content.fault(value, "`states`, which is no object. Write { NAME: {} }")
        return value.object or {}

    def _kind(self, element: dict[str, JsonValue], inner: bool, value: JsonValue) -> StateKind:
        said = element["type"].text if "type" in element else None
        if "type" in element and said not in KINDS:
            self.content.fault(element["type"], f"the type {brief(said)}. {did_you_mean(said or '', KINDS)}")
        history = "history" in element and element["history"].plain not in (None, False)
        kind = KINDS.get(said or "", "history" if history and not inner else "state")
        if inner and kind in ("final", "history"):
            self.content.fault(value, f"states in a {kind} state. Remove them")
        if not inner and said in ("parallel", "compound"):
            self.content.fault(value, f"a {said} state without states. Write one")
        return kind

    def _known(self, element: dict[str, JsonValue]) -> None:
        for key, value in element.items():
            empty = value.list == [] or value.object == {} or value.plain is False or value.null
            if key in REFUSED and not empty:
                self.content.fault(value, f"`{key}`: {REFUSED[key]}")
            elif key not in KNOWN and key not in SAID and key not in REFUSED:
                known = did_you_mean(key, KNOWN).rstrip(".")
                self.content.fault(value, f"`{brief(key)[1:-1]}`, which is no part of a state. {known}")

    def _begin(self, reader: TransitionReader, state: MachineState, element: dict[str, JsonValue]) -> None:
        """Where a compound state begins, and a history without a past."""
        if state.compound:
            state.initial = reader.initial(state, element.get("initial"))
        elif "initial" in element and not element["initial"].null and state.kind != "parallel":
            self.content.fault(element["initial"], "`initial` of a state without states. Remove it")
        elif "initial" in element and state.kind == "parallel" and not element["initial"].null:
            self.content.fault(
                element["initial"], "`initial` of a parallel state, which enters all. Remove it"
            )

    def _fill(self, reader: TransitionReader, state: MachineState, element: dict[str, JsonValue]) -> None:
        content = self.content
        if state.kind == "history":
            state.initial = reader.history(state, element.get("target"))
            return
        sends, cancels = reader.transitions(state, element)
        entry = content.actions(element.get("entry"))
        leave = content.actions(element.get("exit"))
        state.on_entry = tuple(filter(None, (entry, sends)))
        state.on_exit = tuple(filter(None, (leave, cancels)))


def _answered(own: Collection[str], waited: Collection[str]) -> Iterator[str]:
    """The events of a machine that one of its transitions waits for."""
    stems = [one.removesuffix(".*") for one in waited if one.endswith(".*")]
    for one in own:
        if "*" in waited or one in waited or any(one == s or one.startswith(f"{s}.") for s in stems):
            yield one


def _words(value: JsonValue) -> Iterator[str]:
    """The words of transitions in a machine."""
    waiting = [value]
    while waiting:
        one = waiting.pop()
        states = (one.object or {}).get("states")
        waiting += (states.object or {}).values() if states is not None else ()
        for key in ("on", "after"):
            part = (one.object or {}).get(key)
            for made in (part.object or {}).values() if part is not None else ():
                yield from _of(made)
        for key in ("always", "onDone"):
            if one.object and key in one.object:
                yield from _of(one.object[key])


def _of(made: JsonValue) -> Iterator[str]:
    for one in made.list if made.list is not None else [made]:
        yield from one.object or {}


def _offered(descriptor: str) -> str:
    if descriptor == "*":
        return OTHER
    return f"{descriptor[:-1]}{OTHER}" if descriptor.endswith(".*") else descriptor


__all__ = ["read_xstate", "xstate_machine_of"]
