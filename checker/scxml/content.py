"""Executable content of SCXML and its data."""

import re
from fractions import Fraction

from rovercheck.checker.scxml.expressions import parsed_expression
from rovercheck.checker.scxml.records import (
    AssignDatum,
    CancelEvent,
    Choose,
    Constant,
    Executable,
    RaiseEvent,
    ScxmlExpression,
    SendEvent,
    ValueKind,
)
from rovercheck.checker.simulink.xml import XmlElement
from rovercheck.spec_model.lang.errors import ModelError, brief, did_you_mean

EXECUTABLE = ("raise", "send", "cancel", "assign", "log", "if")
_NAME = re.compile(r"[A-Za-z_][\w.:-]*")
REFUSED = {
    "script": "a script. Write <assign> elements",
    "foreach": "a loop over data of any length. Write its turns",
}


class ContentReader:
    """Reads data and actions; what has no meaning is appended to ``faults``."""

    def __init__(self, place: str, faults: list[str]) -> None:
        self.place, self.faults = place, faults
        self.data: dict[str, bool | int] = {}
        self.sends: list[SendEvent] = []
        self.raised: set[str] = set()
        self.carried: dict[str, ValueKind] = {}
        self.states: frozenset[str] = frozenset()

    def fault(self, element: XmlElement, what: str) -> None:
        """Note that an element has no meaning here."""
        tag = element.tag.rpartition(":")[2]
        said = what if what.endswith((".", "?")) else f"{what}."
        self.faults.append(f"{self.place}, line {element.line}: <{tag[:40]}>: {said}")

    @property
    def kinds(self) -> dict[str, ValueKind]:
        """The kinds of all data."""
        return {name: "boolean" if isinstance(one, bool) else "integer" for name, one in self.data.items()}

    def read_data(self, element: XmlElement) -> None:
        """The data of ``<datamodel>``."""
        for one in element.children:
            name, text = one.attributes.get("id", ""), one.attributes.get("expr", one.text.strip())
            if one.tag.rpartition(":")[2] != "data" or not re.fullmatch(r"[A-Za-z_]\w*", name):
                self.fault(one, f"{brief(name)} as a datum. Write <data id='name' expr='0'/>")
            elif name in self.data:
                self.fault(one, f"the datum {name} a second time. Give each its own name")
            elif "src" in one.attributes:
                self.fault(one, "data in another file. Write its value")
            else:
                self._first(one, name, text)

    def _first(self, element: XmlElement, name: str, text: str) -> None:
        try:
            value = parsed_expression(text, {}, ())
        except ModelError as error:
            self.fault(element, f"{name} begins with a whole number, true or false: {error}")
            return
        if isinstance(value, Constant):
            self.data[name] = value.value
        else:
            self.fault(element, f"{name} begins with `{brief(text)}`. Write a number, true or false")

    def condition(self, element: XmlElement) -> ScxmlExpression | None:
        """The condition of a transition or a branch."""
        return self._expression(element, "cond", "boolean")

    def _expression(self, element: XmlElement, attribute: str, kind: ValueKind) -> ScxmlExpression | None:
        text = element.attributes.get(attribute, "")
        try:
            return parsed_expression(text, self.kinds, self.states, kind, self.carried)
        except ModelError as error:
            self.fault(element, str(error))
            return None

    def actions(self, element: XmlElement) -> tuple[Executable, ...]:
        """The actions in an element, in their order."""
        found: list[Executable] = []
        for one in element.children:
            tag = one.tag.rpartition(":")[2]
            if tag not in EXECUTABLE:
                self.fault(one, REFUSED.get(tag, "no executable content that is known. Remove it"))
                continue
            made = getattr(self, f"_{tag}")(one)
            found += [] if made is None else [made]
        return tuple(found)

    def _log(self, _: XmlElement) -> None:
        """What is logged changes nothing."""

    def _raise(self, element: XmlElement) -> RaiseEvent | None:
        event = self._event(element)
        self.raised |= {event} - {""}
        return RaiseEvent(event) if event else None

    def _event(self, element: XmlElement) -> str:
        event = element.attributes.get("event", "")
        if not _NAME.fullmatch(event):
            self.fault(element, f"the event {brief(event)}. Write its name")
            return ""
        return event

    def _send(self, element: XmlElement) -> Executable | None:
        target = element.attributes.get("target", "")
        for word in ("eventexpr", "delayexpr", "targetexpr", "typeexpr", "idlocation", "namelist"):
            if word in element.attributes:
                self.fault(element, f"{word}, which is computed. Write the value itself")
                return None
        if element.children:
            self.fault(element, "data of an event. Assign a datum before it")
            return None
        if target == "#_internal":
            return self._raise(element)
        if target not in ("", "#_scxml"):
            self.fault(element, f"the target {brief(target)}, another machine. Assign a datum that says it")
            return None
        delay = milliseconds(element.attributes.get("delay", "0s"))
        event = self._event(element)
        if delay is None:
            self.fault(
                element, f"the delay {brief(element.attributes['delay'])}. Write whole ms, as in 250ms or 2s"
            )
        if not event or delay is None:
            return None
        made = SendEvent(
            len(self.sends) + 1, event, delay, element.attributes.get("id", ""), element.line
        )  # fmt: skip
        self.sends.append(made)
        return made

    def _cancel(self, element: XmlElement) -> CancelEvent | None:
        id = element.attributes.get("sendid", "")
        if not id:
            self.fault(element, "no sendid. Write that of a <send>")
            return None
        return CancelEvent(id)

    def _assign(self, element: XmlElement) -> AssignDatum | None:
        name = element.attributes.get("location", "")
        if name not in self.data:
            self.fault(element, f"{brief(name)}, which is no datum. {did_you_mean(name, self.data)}")
            return None
        if "expr" not in element.attributes:
            self.fault(element, "no expr. Write the value there")
            return None
        value = self._expression(element, "expr", self.kinds[name])
        return None if value is None else AssignDatum(name, value)

    def _if(self, element: XmlElement) -> Choose:
        branches, last, part = [], element, list[XmlElement]()
        for one in [*element.children, None]:
            if one is None or one.tag.rpartition(":")[2] in ("elseif", "else"):
                inner = XmlElement(element.tag, {}, last.line, part)
                condition = None if last.tag.rpartition(":")[2] == "else" else self.condition(last)
                branches.append((condition, self.actions(inner)))
                if one is not None:
                    if last.tag.rpartition(":")[2] == "else":
                        self.fault(one, "a branch after <else>. Put it before")
                    last, part = one, []
            else:
                part.append(one)
        return Choose(tuple(branches))


def milliseconds(text: str) -> int | None:
    """A delay as ``<send>`` has it: ``2s``, ``1.5s``, ``250ms``; nothing for what is none."""
    found = re.fullmatch(r"\s*(\d{0,9}(?:\.\d{1,9})?)\s*(ms|s)\s*", text)
    if found is None or not found[1]:
        return None
    exact = Fraction(found[1]) * (1000 if found[2] == "s" else 1)
    return int(exact) if exact.denominator == 1 else None


__all__ = ["ContentReader", "milliseconds"]
