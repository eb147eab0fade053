"""Files of SCXML: states, transitions and executable content, or what has no meaning here, with its line."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import replace
from math import gcd
from pathlib import Path

from rovercheck.checker.io.bounded import bounded_bytes
from rovercheck.checker.scxml.content import ContentReader
from rovercheck.checker.scxml.records import (
    OTHER,
    MachineState,
    MachineTransition,
    StateKind,
    StateMachine,
    matches,
)
from rovercheck.checker.scxml.walk import event_data
from rovercheck.checker.simulink.xml import XmlElement, parsed
from rovercheck.spec_model.lang.errors import ModelError, brief, did_you_mean

LARGEST = 16 << 20
"""Bytes of a file."""
MOST_STATES = 2000
AGAIN = "Write plain SCXML, without a <!DOCTYPE>."
SPACE = "{http://www.w3.org/2005/07/scxml}"
STATES: Mapping[str, StateKind] = {
    "state": "state", "parallel": "parallel", "final": "final", "history": "history"
}  # fmt: skip
REFUSED = {
    "invoke": "another machine or service. Model what it sends as events",
    "script": "a script. Write <assign> elements",
    "foreach": "a loop over data of any length. Write its turns",
    "donedata": "data of an event. Assign a datum",
}
INSIDE = {
    "scxml": (*STATES, "datamodel"),
    "state": (*STATES, "initial", "onentry", "onexit", "transition", "datamodel"),
    "parallel": (*STATES, "onentry", "onexit", "transition", "datamodel"), "final": ("onentry", "onexit"),
    "history": ("transition",),
}  # fmt: skip
_ID = re.compile(r"[A-Za-z_][\w.-]{0,200}")
_EVENT = re.compile(r"[A-Za-z_][\w:-]*(?:\.[\w:-]+)*(?:\.\*|\.)?|\*")


def read_scxml(path: Path) -> StateMachine:
    """The machine in a file.  Raises ``ModelError`` for what cannot be read or has no meaning, with lines."""
    return machine_of(bounded_bytes(path, LARGEST, "Name a machine in SCXML."), path.name)


def machine_of(data: bytes, place: str) -> StateMachine:
    """The same of a text, which stands at ``place``."""
    root, _ = parsed(data, place, again=AGAIN)
    return _Reader(root, place).machine()


class _Reader:
    def __init__(self, root: XmlElement, place: str) -> None:
        self.root, self.place, self.faults = root, place, list[str]()
        self.states: dict[str, MachineState] = {}
        self.elements: list[tuple[MachineState, XmlElement]] = []
        self.content = ContentReader(place, self.faults)

    def machine(self) -> StateMachine:
        if _tag(self.root) != "scxml":
            raise ModelError(
                f"{self.place}, line {self.root.line}: <{brief(_tag(self.root))}> is no machine; the "
                "outermost element of SCXML is <scxml>."
            )
        top = MachineState("", "state", None, 0, self.root.line)
        self._level(top, self.root)
        if not top.children:
            self._fault(self.root, "a machine without a state. Draw one")
        self.content.states = frozenset(self.states)
        self._stop()
        for state, element in self.elements:
            self._fill(state, element)
        self._stop()
        self._check()
        self._stop()
        name = self.root.attributes.get("name", "") or Path(self.place).stem
        own = {one.event for one in self.content.sends} | self.content.raised
        own |= {
            f"done.state.{one.id}" for one in self.states.values() if one.compound or one.kind == "parallel"
        }
        waited = {d for one in self.states.values() for t in one.transitions for d in t.events}
        offered = sorted({OTHER if d == "*" else d for d in waited} - own)
        offered = [one for one in offered if not one.startswith(("done.", "error"))]
        internal = sorted(one for one in own if any(matches(d, one) for d in waited))
        self._check_event_data(internal)
        self._stop()
        return StateMachine(
            re.sub(r"\W+", "_", name).strip("_") or "Machine", top,
            tuple(self.states.values()), self.content.data, tuple(self.content.sends), tuple(offered),
            tuple(internal), gcd(*(one.delay for one in self.content.sends)), carried=self.content.carried,
        )  # fmt: skip

    def _fault(self, element: XmlElement, what: str) -> None:
        self.content.fault(element, what)

    def _stop(self) -> None:
        if self.faults:
            raise ModelError("\n".join(dict.fromkeys(self.faults)))

    # --- states --------------------------------------------------------------------------------------------

    def _level(self, state: MachineState, element: XmlElement) -> None:
        self.elements.append((state, element))
        if state.parent is None:
            model = element.attributes.get("datamodel", "null")
            if model not in ("null", "ecmascript"):
                self._fault(
                    element, f"the data model {brief(model)}. Write ecmascript, of which a part is known"
                )
            if element.attributes.get("binding", "early") != "early":
                self._fault(element, "late binding of data. Write binding='early', and assign on entry")
        kind = "scxml" if state.parent is None else state.kind
        for one in element.children:
            tag = _tag(one)
            if tag in REFUSED:
                self._fault(one, REFUSED[tag])
            elif tag not in INSIDE[kind]:
                self._fault(one, f"an element that stands in no <{kind}>. Remove it")
            elif tag == "datamodel":
                self.content.read_data(one)
            elif tag in STATES:
                self._state(state, one, tag)

    def _state(self, parent: MachineState, element: XmlElement, tag: str) -> None:
        number = len(self.states) + 1
        id = element.attributes.get("id", f"unnamed_{number}")
        if not _ID.fullmatch(id):
            self._fault(element, f"the id {brief(id)}. Write letters, digits, _ - and .")
            return
        if id in self.states:
            self._fault(element, f"the id {id} a second time. Give each state its own")
            return
        if number > MOST_STATES:
            raise ModelError(
                f"{self.place}, line {element.line}: more than {MOST_STATES} states are not read."
            )
        made = MachineState(id, STATES[tag], parent, number, element.line)
        made.deep = element.attributes.get("type", "shallow") == "deep"
        self.states[id] = made
        (parent.histories if tag == "history" else parent.children).append(made)
        self._level(made, element)

    def _fill(self, state: MachineState, element: XmlElement) -> None:
        """What a state does, and where it leads."""
        for one in element.children:
            tag = _tag(one)
            if tag in ("onentry", "onexit"):
                found = self.content.actions(one)
                if tag == "onentry":
                    state.on_entry += (found,)
                else:
                    state.on_exit += (found,)
            elif tag == "transition" and state.kind == "history":
                state.initial = self._begin(state, one)
            elif tag == "transition":
                state.transitions.append(self._transition(state, one, len(state.transitions) + 1))
            elif tag == "initial":
                inner = next((c for c in one.children if _tag(c) == "transition"), None)
                if inner is None or "initial" in element.attributes:
                    self._fault(one, "one <transition> is in it, and the state has no attribute of this name")
                else:
                    state.initial = self._begin(state, inner)
        if state.compound and state.initial is None:
            targets = self._targets(element, "initial")
            state.initial = MachineTransition(state, targets=targets or (state.children[0],), line=state.line)
        if state.kind == "history" and state.initial is None:
            self._fault(element, "a history without a <transition> to where it begins. Write one")

    def _begin(self, state: MachineState, element: XmlElement) -> MachineTransition:
        if "event" in element.attributes or "cond" in element.attributes:
            self._fault(element, "a condition or an event where a state begins. Remove it")
        targets = self._targets(element, "target")
        if not targets:
            self._fault(element, "no target where a state begins. Write one")
        return MachineTransition(
            state, targets=targets, actions=self.content.actions(element), line=element.line
        )

    def _targets(self, element: XmlElement, attribute: str) -> tuple[MachineState, ...]:
        found = []
        for id in element.attributes.get(attribute, "").split():
            if id in self.states:
                found.append(self.states[id])
            else:
                known = did_you_mean(id, self.states)
                self._fault(element, f"{brief(id)}, which is no state. {known}".rstrip("."))
        return tuple(found)

    def _transition(self, state: MachineState, element: XmlElement, order: int) -> MachineTransition:
        events = []
        for one in element.attributes.get("event", "").split():
            if not _EVENT.fullmatch(one):
                self._fault(element, f"the event {brief(one)}. Write names with dots between them, or *")
            events.append(one.removesuffix(".*").removesuffix(".") if one != "*" else one)
        text = element.attributes.get("cond", "")
        made = MachineTransition(
            state, tuple(events), self.content.condition(element) if text else None, " ".join(text.split()),
            self._targets(element, "target"), element.attributes.get("type", "external") == "internal",
            self.content.actions(element), order, element.line,
        )  # fmt: skip
        if not events and not text and not made.targets:
            self._fault(element, "a transition without event, condition and target. Write one of them")
        return made

    # --- whether it is a chart -----------------------------------------------------------------------------

    def _check(self) -> None:
        for state, element in self.elements:
            if state.kind == "parallel" and not state.children:
                self._fault(element, "a <parallel> without regions. Draw one")
            if state.kind == "parallel" and any(one.kind == "final" for one in state.children):
                self._fault(element, "a <final> as a region. Put it into a <state>")
            if state.initial is not None:
                holder = state.parent if state.kind == "history" else state
                assert holder is not None
                for one in state.initial.targets:
                    if not one.is_in(holder) or one is state:
                        self._fault(
                            element, f"{one.id} as its beginning, which is not in {holder.id or 'it'}"
                        )
                if state.kind == "history" and not state.deep:
                    self._shallow(state, holder, element)
                self._together(element, state.initial.targets)
            for transition in state.transitions:
                self._together(element, transition.targets)
        self._cycles()

    def _check_event_data(self, internal: Sequence[str]) -> None:
        """Data of events are read where the event can only be one from outside."""
        say = "Assign it to a datum in the transition of its event"
        for state, element in self.elements:
            begins = () if state.initial is None else state.initial.actions
            for one in event_data([a for h in (*state.on_entry, *state.on_exit, begins) for a in h]):
                where = f"where {state.id or 'the machine'} begins or ends, whatever the event is"
                self._fault(element, f"{one.written} {where}. {say}")
            for transition in state.transitions:
                own = [one for one in internal if any(matches(d, one) for d in transition.events)]
                if own or not transition.events:
                    at = replace(element, tag="transition", line=transition.line)
                    for one in event_data(transition.actions, transition.condition):
                        where = f"where the event may be {own[0] if own else 'any'}, which carries nothing"
                        self._fault(at, f"{one.written} {where}. {say}")

    def _shallow(self, state: MachineState, holder: MachineState, element: XmlElement) -> None:
        assert state.initial is not None
        if any(one.parent is not holder for one in state.initial.targets):
            self._fault(element, "a shallow history that begins in no child of its parent. Write type='deep'")

    def _together(self, element: XmlElement, targets: tuple[MachineState, ...]) -> None:
        """Several targets are in different regions."""
        for place, one in enumerate(targets):
            for other in targets[:place]:
                lines = [one, *one.above()], [other, *other.above()]
                common = next(a for a in lines[0] if any(a is b for b in lines[1]))
                if common.kind != "parallel" or one is other:
                    self._fault(
                        element, f"the targets {other.id} and {one.id} together, which exclude each other"
                    )

    def _cycles(self) -> None:
        """A history that begins in a history."""
        for state, element in self.elements:
            begun = () if state.kind != "history" or state.initial is None else state.initial.targets
            if any(one.kind == "history" for one in begun):
                self._fault(element, "a history that begins in a history. Name a state")


def _tag(element: XmlElement) -> str:
    return element.tag.rpartition(":")[2]


__all__ = ["machine_of", "read_scxml"]
