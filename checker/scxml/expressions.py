"""The exact part of ECMAScript: whole numbers, truth values, comparisons, sums, products, ``In()``."""

import re
from collections.abc import Collection, Mapping
from typing import Literal

from rovercheck.checker.scxml.records import (
    EVENT_DATA,
    Constant,
    DatumName,
    EventDatum,
    InState,
    Operation,
    ScxmlExpression,
    ValueKind,
)
from rovercheck.spec_model.lang.errors import ModelError, brief, did_you_mean

MOST = 1 << 53
"""Whole numbers of ECMAScript are exact below it."""
DEEPEST = 50
"""Parentheses in each other."""
LONGEST = 4000
"""Letters of an expression."""
_TOKEN = re.compile(
    r"\s*(?:(\d+(?![\w.]))|(Math\.(?:abs|floor|max|min)\b|_event\.data\.[A-Za-z_$][\w$]*|[A-Za-z_$][\w$]*)|('[^'\\]*'|\"[^\"\\]*\")|(===|!==|==|!=|<=|>=|&&|\|\||[-+*/%<>!?:(),]))"
)
_BINARY = (("||",), ("&&",), ("===", "!==", "==", "!="), ("<", "<=", ">", ">="), ("+", "-"), ("*", "%"))
_FUNCTIONS: Mapping[str, int] = {"Math.abs": 1, "Math.floor": 1, "Math.max": 2, "Math.min": 2}
"""Functions of numbers, and of how many; ``Math.floor`` is that of a quotient."""
SUBSET = (
    "Written here are whole numbers, true, false, data, {carried}In('state'), + - *, % 4, "
    "Math.floor(... / 4), Math.min, Math.max, Math.abs, comparisons, ! && || and ? :"
)


def _kind_of(one: ScxmlExpression) -> ValueKind | Literal[""]:
    """Whether a value is a truth value or a whole number; of data of events their use says it."""
    match one:
        case Constant(value):
            return "boolean" if isinstance(value, bool) else "integer"
        case DatumName(_, kind) | Operation(_, _, kind):
            return kind
        case EventDatum(_, known):
            return known
    return "boolean"


def parsed_expression(
    text: str,
    data: Mapping[str, ValueKind],
    states: Collection[str],
    kind: ValueKind | None = None,
    carried: dict[str, ValueKind] | None = None,
) -> ScxmlExpression:
    """An expression of data and states, and of what events carry, to which its kinds are added as it says.

    Without ``carried`` nothing of an event can be read.  Raises ``ModelError`` for what is outside of the
    exact part, and for a value of another kind.
    """
    parser = _Parser(text, data, states, carried)
    found = parser.whole()
    if kind is None:
        return found
    if isinstance(found, EventDatum):
        return parser.carries(found, kind)
    if _kind_of(found) != kind:
        raise ModelError(f"{brief(text)} is no {kind} value")
    return found


class _Parser:
    def __init__(
        self,
        text: str,
        data: Mapping[str, ValueKind],
        states: Collection[str],
        carried: dict[str, ValueKind] | None,
    ) -> None:
        self.text, self.data, self.states, self.carried = text.strip(), data, states, carried
        self.tokens, self.at, self.depth = list(self._tokens()), 0, 0

    @property
    def _subset(self) -> str:
        return SUBSET.format(carried="" if self.carried is None else f"{EVENT_DATA}name, ")

    def _tokens(self) -> list[str]:
        found, at = [], 0
        if len(self.text) > LONGEST:
            raise ModelError(f"{brief(self.text)} is longer than {LONGEST:,} letters. Split it.")
        while at < len(self.text):
            one = _TOKEN.match(self.text, at)
            if one is None:
                raise ModelError(
                    f"`{brief(self.text)}` has {brief(self.text[at:].strip()[:10])}, which has no exact "
                    f"meaning here. {self._subset}."
                )
            found.append(one[0].strip())
            at = one.end()
        return found

    def whole(self) -> ScxmlExpression:
        found = self._choice()
        if self.at < len(self.tokens):
            raise self._unexpected()
        return found

    def _unexpected(self) -> ModelError:
        what = brief(self.tokens[self.at]) if self.at < len(self.tokens) else "its end"
        if what == brief("/"):
            return ModelError(
                f"`{brief(self.text)}` has {what}, which has no exact meaning here. {self._subset}."
            )
        return ModelError(f"`{brief(self.text)}`: {what} is not expected there. {self._subset}.")

    def _take(self, *wanted: str) -> str:
        if self.at < len(self.tokens) and self.tokens[self.at] in wanted:
            self.at += 1
            return self.tokens[self.at - 1]
        return ""

    def _need(self, wanted: str) -> None:
        if not self._take(wanted):
            raise self._unexpected()

    def _deeper(self) -> None:
        self.depth += 1
        if self.depth > DEEPEST:
            raise ModelError(f"`{brief(self.text)}` nests deeper than {DEEPEST}. Split it.")

    def _choice(self) -> ScxmlExpression:
        self._deeper()
        found = self._binary(0)
        if self._take("?"):
            then = self._choice()
            self._need(":")
            other = self._choice()
            then, other, kind = self._alike(then, other, ": both values of ? : must be of one kind")
            found = Operation("?", (self._of(found, "boolean"), then, other), kind)
        self.depth -= 1
        return found

    def _binary(self, level: int) -> ScxmlExpression:
        if level == len(_BINARY):
            return self._unary()
        found = self._binary(level + 1)
        while operator := self._take(*_BINARY[level]):
            found = self._joined(operator, found, self._binary(level + 1))
        return found

    def _joined(self, operator: str, left: ScxmlExpression, right: ScxmlExpression) -> ScxmlExpression:
        if operator in ("&&", "||"):
            return Operation(operator, (self._of(left, "boolean"), self._of(right, "boolean")), "boolean")
        if operator in ("==", "===", "!=", "!=="):
            unlike = (
                " compares a truth value with a number, which ECMAScript converts. Compare values of one kind"
            )
            left, right, _ = self._alike(left, right, unlike)
            return Operation(operator[:2], (left, right), "boolean")
        if operator == "%":
            return self._divided("%", left, right)
        kind: ValueKind = "integer" if operator in ("+", "-", "*") else "boolean"
        return Operation(operator, (self._of(left, "integer"), self._of(right, "integer")), kind)

    def _alike(
        self, one: ScxmlExpression, other: ScxmlExpression, unlike: str
    ) -> tuple[ScxmlExpression, ScxmlExpression, ValueKind]:
        """Two values of one kind, and which it is."""
        kind = _kind_of(one) or _kind_of(other)
        if not kind:
            assert isinstance(one, EventDatum)
            raise ModelError(
                f"`{brief(self.text)}`: nothing says whether {brief(one.written)} is a number or a truth "
                "value. Assign it to a datum, and write that."
            )
        if _kind_of(other) not in ("", kind):
            raise ModelError(f"`{brief(self.text)}`{unlike}.")
        return self._of(one, kind), self._of(other, kind), kind

    def carries(self, one: EventDatum, kind: ValueKind) -> EventDatum:
        """What an event carries, of the kind that its use says.  Raises ``ModelError`` for another one."""
        assert self.carried is not None
        if self.carried.setdefault(one.name, kind) != kind:
            raise ModelError(
                f"`{brief(self.text)}`: {brief(one.written)} is a number in one place and a truth value in "
                "another. Give both a name of their own."
            )
        return EventDatum(one.name, kind)

    def _of(self, one: ScxmlExpression, kind: ValueKind) -> ScxmlExpression:
        if isinstance(one, EventDatum):
            return self.carries(one, kind)
        if _kind_of(one) != kind:
            other = "a number" if kind == "boolean" else "a truth value"
            raise ModelError(
                f"`{brief(self.text)}` has {other} where another kind is expected. "
                "Write a comparison, or ? :."
            )
        return one

    def _unary(self) -> ScxmlExpression:
        self._deeper()
        found = self._plain()
        self.depth -= 1
        return found

    def _plain(self) -> ScxmlExpression:
        if self._take("!"):
            return Operation("!", (self._of(self._unary(), "boolean"),), "boolean")
        if self._take("-"):
            found = self._of(self._unary(), "integer")
            if isinstance(found, Constant):
                return Constant(-found.value)
            return Operation("neg", (found,), "integer")
        if self._take("("):
            found = self._choice()
            self._need(")")
            return found
        if self.at == len(self.tokens) or not re.match(r"[\w$]", self.tokens[self.at]):
            raise self._unexpected()
        word = self.tokens[self.at]
        self.at += 1
        if word.isdecimal():
            if len(word) > 16 or int(word) >= MOST or not word.isascii():
                raise ModelError(
                    f"{brief(word)} is no whole number below 2^53, which ECMAScript has exactly."
                )
            return Constant(int(word))
        if word in ("true", "false"):
            return Constant(word == "true")
        if word in _FUNCTIONS:
            return self._function(word)
        if word.startswith(EVENT_DATA) and self.carried is not None:
            name = word.removeprefix(EVENT_DATA)
            return EventDatum(name, self.carried.get(name, ""))
        return self._in() if word == "In" else self._datum(word)

    def _divided(self, operator: str, left: ScxmlExpression, by: ScxmlExpression) -> ScxmlExpression:
        """A remainder, or a quotient rounded down."""
        if not isinstance(by, Constant) or isinstance(by.value, bool) or by.value < 1:
            raise ModelError(f"`{brief(self.text)}` divides by no positive whole number. Write one.")
        return Operation(operator, (self._of(left, "integer"), by), "integer")

    def _function(self, word: str) -> ScxmlExpression:
        self._need("(")
        if word == "Math.floor":
            left = self._binary(len(_BINARY) - 1)
            self._need("/")
            by = self._unary()
            self._need(")")
            return self._divided("floor", left, by)
        found = [self._of(self._choice(), "integer")]
        while len(found) < _FUNCTIONS[word]:
            self._need(",")
            found.append(self._of(self._choice(), "integer"))
        self._need(")")
        return Operation(word.removeprefix("Math."), tuple(found), "integer")

    def _in(self) -> ScxmlExpression:
        self._need("(")
        if self.at == len(self.tokens) or self.tokens[self.at][0] not in "'\"":
            raise self._unexpected()
        state = self.tokens[self.at][1:-1]
        self.at += 1
        self._need(")")
        if state not in self.states:
            raise ModelError(f"In({state!r}): there is no such state. {did_you_mean(state, self.states)}")
        return InState(state)

    def _datum(self, word: str) -> ScxmlExpression:
        if word not in self.data:
            raise ModelError(
                f"`{brief(self.text)}`: {brief(word)} is no datum. {did_you_mean(word, self.data)}"
            )
        return DatumName(word, self.data[word])


__all__ = ["parsed_expression"]
