"""The context, guards and actions of a machine of XState, by the bindings beside it."""

from collections.abc import Iterator

from rovercheck.checker.io.json_lines import JsonValue
from rovercheck.checker.scxml.expressions import parsed_expression
from rovercheck.checker.scxml.records import (
    AssignDatum,
    DatumName,
    Executable,
    FreeGuard,
    NamedAction,
    Operation,
    RaiseEvent,
    ScxmlExpression,
    SendEvent,
    ValueKind,
)
from rovercheck.checker.scxml.xstate.bindings import RAISE, Bindings
from rovercheck.spec_model.lang.errors import ModelError, brief, did_you_mean

LOST = "was a function, which no JSON holds. Give it a name in setup() or in the options of the machine"
MOST_SHOWN = 30
"""Faults in a message."""


class XstateContent:
    """Reads the context, guards and actions; what has no meaning is appended to the faults."""

    def __init__(self, place: str, bindings: Bindings) -> None:
        self.place, self.bindings, self.version = place, bindings, 5
        self.faults: list[str] = []
        self.data: dict[str, bool | int] = {}
        self.others: list[str] = []
        self.idle: list[str] = []
        """Transitions with neither target nor actions."""
        self.sends: list[SendEvent] = []
        self.raised: set[str] = set()
        self.states: frozenset[str] = frozenset()
        self.free_guards: dict[str, None] = {}
        self.free_actions: dict[str, None] = {}
        self.used: set[tuple[str, str]] = set()
        self.bound: dict[str, tuple[Executable, ...]] = {}
        self.conditions: dict[str, ScxmlExpression] = {}

    def fault(self, value: JsonValue, what: str) -> None:
        """Note that something has no meaning here."""
        said = what if what.endswith((".", "?")) else f"{what}."
        self.faults.append(f"{self.place}, line {value.line}: {said}")

    def stop(self) -> None:
        """Raise ``ModelError`` if there are faults."""
        if self.faults:
            found = list(dict.fromkeys(self.faults))
            more = [f"{len(found) - MOST_SHOWN} more are not shown."] if len(found) > MOST_SHOWN else []
            raise ModelError("\n".join([*found[:MOST_SHOWN], *more]))

    def notes(self) -> Iterator[str]:
        """What is read in another way than it is written, and what the export may have lost."""
        if self.free_guards:
            yield (
                "Guards without a binding are inputs, the same in all of a step: "
                f"{', '.join(self.free_guards)}."
            )
        if self.free_actions and self.data:
            yield f"Actions without a binding change no data: {', '.join(self.free_actions)}."
        assigned = {one.name for made in self.bound.values() for one in made if isinstance(one, AssignDatum)}
        if kept := [name for name in self.data if name not in assigned]:
            yield f"No action assigns {', '.join(kept)}, which keeps its first value."
        if self.idle:
            yield (
                "These transitions do nothing; an action that was written as a function is lost in JSON: "
                f"{', '.join(self.idle)}."
            )
        if self.others:
            yield f"Of the context these are no numbers or truth values: {', '.join(self.others)}."
        if len(self.sends) > 1:
            yield "Delays that are over at the same time come in the order of the machine."

    # --- the context ---------------------------------------------------------------------------------------

    def read_context(self, root: JsonValue) -> None:
        """The data with their first values."""
        context = (root.object or {}).get("context")
        if context is None or context.null:
            return
        if context.object is None:
            self.fault(context, "a context that is no object. Write { count: 0 }")
            return
        for name, value in context.object.items():
            plain = value.plain
            whole = isinstance(plain, int) and abs(plain) < 1 << 53
            if name.isidentifier() and name.isascii() and whole and name not in ("In", "true", "false"):
                assert isinstance(plain, int)
                self.data[name] = plain
            else:
                self.others.append(brief(name)[1:-1])

    @property
    def kinds(self) -> dict[str, ValueKind]:
        """The kinds of all data."""
        return {name: "boolean" if isinstance(one, bool) else "integer" for name, one in self.data.items()}

    # --- bindings ------------------------------------------------------------------------------------------

    def check_bindings(self) -> None:
        """Read what guards and actions are bound to."""
        bound = self.bindings
        for name, text in bound.guards.items():
            found = self._expression(f"the guard {brief(name)}", text, "boolean")
            if found is not None:
                self.conditions[name] = found
        for name, made in bound.actions.items():
            self.bound[name] = tuple(self._action(name, made))

    def _action(self, name: str, made: "dict[str, str] | object") -> Iterator[Executable]:
        assert isinstance(made, dict)
        assigned: list[str] = []
        for target, text in made.items():
            what = f"the action {brief(name)}"
            if target == RAISE and target not in self.data:
                self.raised.add(text)
                yield RaiseEvent(text)
            elif target not in self.data:
                known = did_you_mean(target, [*self.data, RAISE])
                self._bound_fault(
                    f"{what} assigns {brief(target)}, which is no datum of the context. {known}"
                )
            else:
                value = self._expression(what, text, self.kinds[target])
                if value is None:
                    continue
                if any(one in assigned for one in _read(value)):
                    self._bound_fault(
                        f"{what} reads a datum that it assigns before. XState reads all of them first: write "
                        "the line that reads it above the one that assigns it"
                    )
                assigned.append(target)
                yield AssignDatum(target, value)

    def _expression(self, what: str, text: str, kind: ValueKind) -> ScxmlExpression | None:
        try:
            return parsed_expression(text, self.kinds, self.states, kind)
        except ModelError as error:
            self._bound_fault(f"{what}: {error}")
            return None

    def _bound_fault(self, what: str) -> None:
        said = what if what.endswith((".", "?")) else f"{what}."
        self.faults.append(f"{self.bindings.path}: {said}")

    def check_used(self) -> None:
        """What is bound has a name in the machine."""
        bound = self.bindings
        for kind, names in (("guard", bound.guards), ("action", bound.actions), ("delay", bound.delays)):
            known = sorted(name for of, name in self.used if of == kind)
            for name in names:
                if name not in known:
                    self._bound_fault(f"the machine has no {kind} {brief(name)}. {did_you_mean(name, known)}")

    # --- guards and actions --------------------------------------------------------------------------------

    def guard(self, value: JsonValue | None) -> ScxmlExpression | None:
        """A guard: what it is bound to, or an input."""
        if value is None or value.null:
            return None
        name = self._named(value, "guard")
        if name is None:
            return None
        self.used.add(("guard", name))
        if name in self.conditions or name in self.bindings.guards:
            return self.conditions.get(name)
        self.free_guards[name] = None
        return FreeGuard(name)

    def label(self, value: JsonValue | None) -> str:
        """A guard in a line."""
        if value is None or value.null:
            return ""
        faults = list(self.faults)
        name = self._named(value, "guard") or ""
        self.faults = faults
        return name

    def _named(self, value: JsonValue, what: str) -> str | None:
        if value.text:
            return value.text
        inner = value.object or {}
        kind = inner["type"].text if "type" in inner else None
        if kind == "xstate.guard" and "name" in inner:  # of XState 4
            kind, inner = inner["name"].text, {"type": inner["name"]}
        if not kind or kind.startswith("xstate.") or len(kind) > 200:
            self.fault(value, f"{what}: {LOST if not kind else f'{brief(kind)} {LOST}'}")
            return None
        if "params" in inner and set(inner) <= {"type", "params"}:
            inner = inner["params"].object or {}
        rest = ", ".join(f"{key}: {_shown(one)}" for key, one in inner.items() if key != "type")
        return f"{kind}({rest[:200]})" if rest else kind

    def actions(self, value: JsonValue | None) -> tuple[Executable, ...]:
        """Actions in their order: what they are bound to, or that they ran."""
        if value is None or value.null:
            return ()
        found: list[Executable] = []
        for one in value.list if value.list is not None else [value]:
            found += self._one_action(one)
        return tuple(found)

    def _one_action(self, value: JsonValue) -> tuple[Executable, ...]:
        inner = value.object or {}
        kind = inner["type"].text if "type" in inner else None
        if kind in ("xstate.raise", "xstate.send") and self._raised(value, kind) is not None:
            event = self._raised(value, kind) or ""
            self.raised.add(event)
            if kind == "xstate.raise":
                return (RaiseEvent(event),)
            made = SendEvent(len(self.sends) + 1, event, 0, "", value.line)
            self.sends.append(made)
            return (made,)
        if self.version == 4 and kind == "xstate.log":  # changes nothing
            return ()
        if self.version == 4 and kind == "xstate.send":
            self.fault(value, "`send` with a delay, or to another machine. Write `after`, or a named action")
            return ()
        name = self._named(value, "action")
        if name is None:
            return ()
        self.used.add(("action", name))
        if name in self.bindings.actions:
            return self.bound.get(name, ())
        self.free_actions[name] = None
        return (NamedAction(name),)

    def _raised(self, value: JsonValue, kind: str) -> str | None:
        """The event that XState 4 writes for `raise`, and for `send` to the machine itself without delay."""
        inner = value.object or {}
        if self.version != 4 or any(not inner[k].null for k in ("to", "delay") if k in inner):
            return None
        event = inner.get("event")
        if event is None or (kind == "xstate.send" and event.object is None):
            return None
        said = event.text or (event.object["type"].text if event.object and "type" in event.object else None)
        return said or None


def _read(value: ScxmlExpression) -> Iterator[str]:
    if isinstance(value, DatumName):
        yield value.name
    if isinstance(value, Operation):
        for one in value.operands:
            yield from _read(one)


def _shown(value: JsonValue) -> str:
    """A value in a few letters."""
    if value.object is not None or value.list is not None:
        return "{}" if value.object is not None else "[]"
    if value.plain is None or isinstance(value.plain, bool):
        return {None: "null", True: "true", False: "false"}[value.plain]
    return str(value.plain)[:40]


__all__ = ["LOST", "XstateContent"]
