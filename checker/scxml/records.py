"""A machine as SCXML or XState has it: states in document order, transitions, executable content."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import Literal, Union

StateKind = Literal["state", "parallel", "final", "history"]
ValueKind = Literal["boolean", "integer"]
Rules = Literal["scxml", "xstate"]
"""By whose algorithm a machine runs."""
MOST_MICROSTEPS = 12
"""Turns of the main event loop in one step, each a microstep or an event without an answer; a run that needs
more is told in place of a verdict."""
MOST_WAITING = 6
"""Events that wait in each of the two queues."""
EVENT_DATA = "_event.data."
"""What the names of data of events begin with."""
OTHER = "(other)"
"""An event that only ``*`` matches."""


@dataclass(frozen=True)
class Constant:
    """A truth value or a whole number."""

    value: bool | int


@dataclass(frozen=True)
class DatumName:
    """The value of a datum."""

    name: str
    kind: ValueKind


@dataclass(frozen=True)
class EventDatum:
    """``_event.data.name``: what the event of a step carries; ``kind`` is empty until its use says it."""

    name: str
    kind: ValueKind | Literal[""]

    @property
    def written(self) -> str:
        """As it stands in a file."""
        return f"{EVENT_DATA}{self.name}"


@dataclass(frozen=True)
class InState:
    """``In('id')``: whether a state is active."""

    state: str


@dataclass(frozen=True)
class Operation:
    """An operator, as ECMAScript writes it, with its operands; ``?`` has three."""

    operator: str
    operands: tuple["ScxmlExpression", ...]
    kind: ValueKind


@dataclass(frozen=True)
class FreeGuard:
    """A guard that is known by name only: an input, which holds or does not in each step."""

    name: str


ScxmlExpression = Union[Constant, DatumName, EventDatum, InState, Operation, FreeGuard]


@dataclass(frozen=True)
class RaiseEvent:
    """``<raise>``, or ``<send target="#_internal">``."""

    event: str


@dataclass(frozen=True)
class SendEvent:
    """``<send>`` to the machine itself.  ``number`` is that of the element, ``delay`` in ms."""

    number: int
    event: str
    delay: int
    id: str
    line: int


@dataclass(frozen=True)
class CancelEvent:
    """``<cancel sendid>``."""

    id: str


@dataclass(frozen=True)
class AssignDatum:
    """``<assign>``."""

    name: str
    value: ScxmlExpression


@dataclass(frozen=True)
class Choose:
    """``<if>``: branches with their conditions, ``None`` for ``<else>``."""

    branches: tuple[tuple[ScxmlExpression | None, tuple["Executable", ...]], ...]


@dataclass(frozen=True)
class NamedAction:
    """An action that is known by name only: that it ran in a step can be seen."""

    name: str


Executable = Union[RaiseEvent, SendEvent, CancelEvent, AssignDatum, Choose, NamedAction]


@dataclass(eq=False)
class MachineTransition:
    """A transition; without ``events`` it is eventless, without ``targets`` it leaves nothing."""

    source: "MachineState"
    events: tuple[str, ...] = ()
    condition: ScxmlExpression | None = None
    written_condition: str = ""
    targets: tuple["MachineState", ...] = ()
    internal: bool = False
    actions: tuple[Executable, ...] = ()
    order: int = 0
    """Its number among those of its source, from 1."""
    line: int = 0


@dataclass(eq=False)
class MachineState:
    """A state; the root, of kind ``state``, has no parent.  ``number`` is its place in document order."""

    id: str
    kind: StateKind
    parent: "MachineState | None"
    number: int
    line: int
    deep: bool = False
    known_as: str = ""
    """What its ``done`` event ends with, where that is not ``id``: in XState its id."""
    known_path: str = ""
    """In XState the names from the machine to it."""
    children: list["MachineState"] = field(default_factory=list)
    """Without history states."""
    histories: list["MachineState"] = field(default_factory=list)
    initial: MachineTransition | None = None
    """Of a compound state where it begins, of a history where it begins without a past."""
    on_entry: tuple[tuple[Executable, ...], ...] = ()
    on_exit: tuple[tuple[Executable, ...], ...] = ()
    transitions: list[MachineTransition] = field(default_factory=list)

    @property
    def compound(self) -> bool:
        """Whether one of its children is active when it is."""
        return self.kind == "state" and bool(self.children)

    @property
    def atomic(self) -> bool:
        """Whether it has no children: also a final state."""
        return self.kind == "final" or (self.kind == "state" and not self.children)

    def above(self) -> Iterator["MachineState"]:
        """The states that it is in, from the inside to the root."""
        one = self.parent
        while one is not None:
            yield one
            one = one.parent

    def is_in(self, other: "MachineState") -> bool:
        """Whether it is a descendant of another state."""
        return any(one is other for one in self.above())


@dataclass(frozen=True)
class StateMachine:
    """A machine.  ``states`` are all but the root, in document order; ``data`` have their first values."""

    name: str
    root: MachineState
    states: tuple[MachineState, ...]
    data: Mapping[str, bool | int]
    sends: tuple[SendEvent, ...]
    offered: tuple[str, ...]
    """Events from outside: what transitions wait for and the machine does not send itself."""
    internal: tuple[str, ...]
    """Events that the machine may send itself, ``done.state.*`` too, of those that a transition matches."""
    tick: int
    """Milliseconds of a step in which time passes: all delays are multiples of it; 0 without delays."""
    rules: Rules = "scxml"
    version: int = 5
    """Of XState."""
    done: str = "done.state."
    """What events of states that are done begin with."""
    guards: tuple[str, ...] = ()
    """Guards that are known by name only."""
    actions: tuple[str, ...] = ()
    """Actions that are known by name only."""
    format: str = "SCXML"
    """What people call the language it is written in."""
    notes: tuple[str, ...] = ()
    """What is read in another way than it is written."""
    carried: Mapping[str, ValueKind] = field(default_factory=dict)
    """Data that events from outside carry, with their kinds."""

    @property
    def named(self) -> Mapping[str, MachineState]:
        """The states by their ids."""
        return {one.id: one for one in self.states}


def carried_name(name: str) -> str:
    """The name of what an event carries, among those of a model."""
    return f"event.{name}"


def matches(descriptor: str, event: str) -> bool:
    """Whether an event descriptor, without ``.*`` at its end, matches the name of an event.

    >>> matches("door", "door.open"), matches("door", "doors"), matches("*", "any")
    (True, False, True)
    """
    return descriptor in ("*", event) or event.startswith(f"{descriptor}.")


__all__ = [
    "EVENT_DATA", "MOST_MICROSTEPS", "MOST_WAITING", "OTHER", "AssignDatum", "CancelEvent", "Choose",
    "Constant", "DatumName", "EventDatum", "Executable", "FreeGuard", "InState",
    "MachineState", "MachineTransition", "NamedAction", "Operation", "RaiseEvent", "Rules",
    "ScxmlExpression", "SendEvent",
    "StateKind", "StateMachine", "ValueKind", "carried_name", "matches",
]  # fmt: skip
