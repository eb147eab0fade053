"""Actions of labels, and whole labels: event, guard, condition action and transition action."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from typing import TypeVar

from lark import Token

from rovercheck.spec_model.lang.action import Action, assign, send, when
from rovercheck.spec_model.lang.domain import Bool, Sort
from rovercheck.spec_model.lang.errors import did_you_mean
from rovercheck.spec_model.lang.expr import (
    Expr,
    Operand,
    Temporal,
    Var,
    When,
    all_of,
    as_number,
    const,
    linear,
)
from rovercheck.spec_model.lang.operators import Op
from rovercheck.spec_model.lang.stateflow.meaning import Formulas, located
from rovercheck.spec_model.lang.stateflow.message import Extent, LabelError
from rovercheck.spec_model.lang.stateflow.names import LabelNames
from rovercheck.spec_model.lang.stateflow.quantities import subtrees
from rovercheck.spec_model.lang.stateflow.syntax import Node, Start, check_text, parsed, span

T = TypeVar("T")


@dataclass(frozen=True)
class TransitionParts:
    """What a label of a transition says."""

    event: str | None
    guard: Expr | None
    do: tuple[Action, ...]
    then: tuple[Action, ...]


@dataclass(frozen=True)
class StateParts:
    """What the text of a state says."""

    entry: tuple[Action, ...]
    during: tuple[Action, ...]
    exit: tuple[Action, ...]


def transition_of(text: str, names: LabelNames) -> TransitionParts:
    """What ``event [guard] {condition action} / transition action`` says.

    Raises ``LabelError``; one of ``errors_of`` for each part that has no meaning.
    """
    return _whole(text, "transition", names).transition()


def state_of(text: str, names: LabelNames) -> StateParts:
    """What ``entry: ... during: ... exit: ...`` says.  Raises ``LabelError``."""
    return _whole(text, "state", names).state()


def actions_of(text: str, names: LabelNames) -> tuple[Action, ...]:
    """The actions of a text, as between the braces of a label.  Raises ``LabelError``."""
    reader = _whole(text, "actions", names)
    made = reader.actions(reader.tree)
    reader.check()
    return made


class LabelErrors(LabelError):
    """What has no meaning in a label, part by part."""

    def __init__(self, errors: Sequence[LabelError]) -> None:
        super().__init__(errors[0].said, errors[0].at)
        self.errors = tuple(errors)


def errors_of(error: LabelError) -> tuple[LabelError, ...]:
    """Each error of a label."""
    return error.errors if isinstance(error, LabelErrors) else (error,)


def _whole(text: str, start: Start, names: LabelNames) -> "_Label":
    check_text(text)
    masked, strange = names.mask(text)
    return _Label(text, parsed(text, start, masked), Formulas(names, strange))


class _Label:
    """A text on its way to what it means; what is wrong is kept until the end."""

    def __init__(self, text: str, tree: Node, formulas: Formulas) -> None:
        self.text, self.tree, self.formulas = text, tree, formulas
        self.names = formulas.names
        self.errors: list[LabelError] = []

    def check(self) -> None:
        """Raises what was found wrong."""
        if self.errors:
            raise self.errors[0] if len(self.errors) == 1 else LabelErrors(self.errors)

    def transition(self) -> TransitionParts:
        event, guards = self._events()
        do, then = list[Action](), list[Action]()
        for part in subtrees(self.tree):
            match part.data:
                case "guard":
                    guards += (
                        g for f in subtrees(part) if (g := self._kept(self.formulas.condition, f)) is not None
                    )
                case "block":
                    do += self.actions(part)
                case "then":
                    then += self.actions(part)
        self.check()
        return TransitionParts(event, all_of(*guards) if guards else None, tuple(do), tuple(then))

    def _events(self) -> tuple[str | None, list[Expr]]:
        """The local event, and what a temporal event such as ``after(3, sec)`` asks."""
        event, guards = None, list[Expr]()
        found = [one for part in subtrees(self.tree) if part.data == "events" for one in subtrees(part)]
        if len(found) > 1:
            self.errors.append(
                LabelError("two events on one transition; draw a transition for each.", span(found[1]))
            )
        for one in found[:1]:
            name = str(one.children[0])
            if one.data == "plain_event":
                event = name
                if name in self.names.values:
                    said = f"`{name}` is a datum, no event; a condition stands in brackets: `[{name}]`."
                    self.errors.append(LabelError(said, span(one)))
            elif name == "after":
                given = [n for part in subtrees(one) for n in subtrees(part)]
                length = self._kept(partial(self.formulas.span_of, given=given), one)
                guards += [Temporal(When.AFTER, None, length)] if length is not None else []
            else:
                said = f"`{name}(...)` is no event here; write a condition in brackets: `[...]`."
                self.errors.append(LabelError(said, span(one)))
        return event, guards

    def state(self) -> StateParts:
        found: dict[str, list[Action]] = {"entry": [], "during": [], "exit": []}
        for part in subtrees(self.tree):
            if part.data == "statements":
                found["entry"] += self.actions(part)
                continue
            words, body = subtrees(part)
            for kind in self._kinds(words):
                found[kind] += self.actions(body)
        self.check()
        return StateParts(*(tuple(found[kind]) for kind in ("entry", "during", "exit")))

    def _kinds(self, words: Node) -> Iterator[str]:
        if words.data == "on_event":
            said = "actions on an event have no meaning here; draw a transition from the state to itself."
            self.errors.append(LabelError(said, span(words)))
        for token in words.children:
            if isinstance(token, Token) and token.type == "SECTION":
                word = self.text[token.start_pos : token.end_pos]
                if word == "bind":
                    self.errors.append(LabelError("`bind` has no meaning here; leave it out.", span(token)))
                else:
                    yield next(kind for kind in ("entry", "during", "exit") if kind.startswith(word[:2]))

    # --- actions ---------------------------------------------------------------------------------------

    def actions(self, node: Node) -> tuple[Action, ...]:
        """The actions of a list, of which each is looked at."""
        while node.data != "statements":
            node = subtrees(node)[-1]
        made: list[Action] = []
        before: Extent | None = None
        for part in subtrees(node):
            at = span(part)
            if before is not None and not set(self.text[before.end : at.start]) & set(";,\n"):
                self.errors.append(LabelError("a `;` is missing before this.", at))
            before = at
            found = self._kept(self._action, part)
            made += found or ()
        return tuple(made)

    def _kept(self, make: Callable[[Node], T], node: Node) -> T | None:
        """What is made of a part, or nothing if it has no meaning, which is kept."""
        try:
            with located(node):
                return make(node)
        except LabelError as error:
            self.errors += errors_of(error)
            return None

    def _action(self, node: Node) -> tuple[Action, ...]:
        match node.data:
            case "assignment":
                return (self._assign(subtrees(node)[0], subtrees(node)[1]),)
            case "change":
                target, value = subtrees(node)
                [sign] = (part for part in node.children if isinstance(part, Token))
                return (self._change(target, sign, value),)
            case "step":
                by = const(1 if str(node.children[1]) == "++" else -1)
                return (self._changed(subtrees(node)[0], lambda old: linear(Op.ADD, old, _like(by, old))),)
            case "conditional" | "chained":
                return (self._conditional(node),)
            case "procedure":
                return self._procedure(node)
        name = str(node.children[0])
        if name in self.names.functions:
            raise LabelError(f"write `{self.names.functions[name].call}`.", span(node))
        raise LabelError(
            f"`{name}` does nothing; write an assignment, such as `x = 1`, or send an event to a state: "
            f"`send({name}, STATE)`.",
            span(node),
        )

    def _conditional(self, node: Node) -> Action:
        parts = subtrees(node)
        test = self._kept(self.formulas.condition, parts[0])
        then = self.actions(parts[1])
        otherwise: tuple[Action, ...] = ()
        for other in parts[2:]:
            if other.data == "chained":
                otherwise = (self._conditional(other),)
            elif (inner := subtrees(other)[0]).data == "conditional":
                otherwise = (self._conditional(inner),)
            else:
                otherwise = self.actions(inner)
        return when(const(True) if test is None else test, then, otherwise)

    def _procedure(self, node: Node) -> tuple[Action, ...]:
        name, given = str(node.children[0]), [n for part in subtrees(node) for n in subtrees(part)]
        if name in self.names.functions:
            return self.names.functions[name].actions(*(self.formulas.formula(one) for one in given))
        at = span(node)
        if call := self.names.calls.get(self.text[at.start : at.end]):
            return call
        if name == "send":
            if len(given) != 2:
                said = "send() names an event and a state: `send(stop, Motor)`; nothing is sent to all."
                raise LabelError(said, span(node))
            return (send(_word(given[0], "an event"), _word(given[1], "a state")),)
        if name == "push":
            return self._push(node, given)
        near = did_you_mean(name, [*self.names.functions, "send", "push"])
        raise LabelError(f"there is no function `{name}` that does something. {near}", span(node))

    def _push(self, node: Node, given: Sequence[Node]) -> tuple[Action, ...]:
        if len(given) != 2:
            raise LabelError("push() takes an array and a value: `push(gaps, age)`.", span(node))
        name = _word(given[0], "an array")
        if name not in self.names.arrays:
            raise LabelError(f"`{name}` is no array. {did_you_mean(name, self.names.arrays)}", span(given[0]))
        array = self.names.arrays[name]
        return array.push(self.formulas.formula(given[1], array.variables[0].sort))

    def _assign(self, target: Node, value: Node) -> Action:
        if target.data == "indexed_target":
            name = str(target.children[0])
            if name not in self.names.arrays:
                near = did_you_mean(name, self.names.arrays)
                raise LabelError(f"`{name}` is no array. {near}", span(target))
            array = self.names.arrays[name]
            index = self.formulas.index(array.keys, subtrees(target)[0])
            return array.set(index, self.formulas.formula(value, array.variables[0].sort))
        var = self._target(target)
        return assign(var, self._value(value, var.sort))

    def _value(self, node: Node, like: Sort) -> Operand:
        made = self.formulas.formula(node, like)
        if isinstance(like, Bool) and not isinstance(made.sort, Bool):
            raise LabelError(
                f"`{made}` is a number, and what it is assigned to is true or false.", span(node)
            )
        return made

    def _target(self, node: Node) -> Var:
        strange = node.data == "strange_target"
        name = self.formulas.strange[span(node).start] if strange else str(node.children[0])
        found = self.names.value(name, span(node))
        if not isinstance(found, Var):
            what = "the name of a formula" if isinstance(found, Expr) else "the member of an enumeration"
            raise LabelError(f"`{name}` is {what} and takes no value; assign to a variable.", span(node))
        return found

    def _change(self, target: Node, sign: Token, value: Node) -> Action:
        def changed(old: Expr) -> Expr:
            match str(sign)[0]:
                case "+":
                    return old + self.formulas.formula(value, old.sort)
                case "-":
                    return old - self.formulas.formula(value, old.sort)
                case "*":
                    return old * self.formulas.formula(value)
            raise LabelError("`/=` has no meaning here; write the quotient.", span(sign))

        return self._changed(target, changed)

    def _changed(self, target: Node, change: Callable[[Expr], Expr]) -> Action:
        if target.data == "indexed_target":
            raise LabelError("write the assignment to an element whole: `a[1] = a[1] + 1`.", span(target))
        var = self._target(target)
        return assign(var, change(as_number(var, "this change")))


def _like(number: Expr, other: Expr) -> Expr:
    """A number of one in the unit of another."""
    assert not isinstance(other.sort, Bool)
    unit = getattr(other.sort, "unit", "")
    return const(getattr(number, "value", 1), unit)


def _word(node: Node, what: str) -> str:
    """A name that stands alone."""
    if node.data != "name":
        raise LabelError(f"write the name of {what}.", span(node))
    return str(node.children[0])
