"""The exact part of ECMAScript: whole numbers, truth values, comparisons, sums, products, ``In()``."""

import re
from collections.abc import Collection, Mapping

from rovercheck.checker.scxml.records import (
    Constant,
    DatumName,
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
    r"\s*(?:(\d+(?![\w.]))|(Math\.(?:abs|floor|max|min)\b|[A-Za-z_$][\w$]*)|('[^'\\]*'|\"[^\"\\]*\")|(===|!==|==|!=|<=|>=|&&|\|\||[-+*/%<>!?:(),]))"
)
_BINARY = (("||",), ("&&",), ("===", "!==", "==", "!="), ("<", "<=", ">", ">="), ("+", "-"), ("*", "%"))
_FUNCTIONS: Mapping[str, int] = {"Math.abs": 1, "Math.floor": 1, "Math.max": 2, "Math.min": 2}
"""Functions of numbers, and of how many; ``Math.floor`` is that of a quotient."""
SUBSET = (
    "Written here are whole numbers, true, false, data, In('state'), + - *, % 4, Math.floor(... / 4), "
    "Math.min, Math.max, Math.abs, comparisons, ! && || and ? :"
)


def kind_of(one: ScxmlExpression) -> ValueKind:
    """Whether a value is a truth value or a whole number."""
    match one:
        case Constant(value):
            return "boolean" if isinstance(value, bool) else "integer"
        case DatumName(_, kind) | Operation(_, _, kind):
            return kind
    return "boolean"


def parsed_expression(text: str, data: Mapping[str, ValueKind], states: Collection[str]) -> ScxmlExpression:
    """An expression of data and states.  Raises ``ModelError`` for what is outside of the exact part."""
    return _Parser(text, data, states).whole()


class _Parser:
    def __init__(self, text: str, data: Mapping[str, ValueKind], states: Collection[str]) -> None:
        self.text, self.data, self.states = text.strip(), data, states
        self.tokens, self.at, self.depth = list(self._tokens()), 0, 0

    def _tokens(self) -> list[str]:
        found, at = [], 0
        if len(self.text) > LONGEST:
            raise ModelError(f"{brief(self.text)} is longer than {LONGEST:,} letters. Split it.")
        while at < len(self.text):
            one = _TOKEN.match(self.text, at)
            if one is None:
                raise ModelError(
                    f"`{brief(self.text)}` has {brief(self.text[at:].strip()[:10])}, which has no exact "
                    f"meaning here. {SUBSET}."
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
            return ModelError(f"`{brief(self.text)}` has {what}, which has no exact meaning here. {SUBSET}.")
        return ModelError(f"`{brief(self.text)}`: {what} is not expected there. {SUBSET}.")

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
            if kind_of(then) != kind_of(other):
                raise ModelError(f"`{brief(self.text)}`: both values of ? : must be of one kind.")
            found = Operation("?", (self._of(found, "boolean"), then, other), kind_of(then))
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
            if kind_of(left) != kind_of(right):
                raise ModelError(
                    f"`{brief(self.text)}` compares a truth value with a number, which ECMAScript converts. "
                    "Compare values of one kind."
                )
            return Operation(operator[:2], (left, right), "boolean")
        if operator == "%":
            return self._divided("%", left, right)
        kind: ValueKind = "integer" if operator in ("+", "-", "*") else "boolean"
        return Operation(operator, (self._of(left, "integer"), self._of(right, "integer")), kind)

    def _of(self, one: ScxmlExpression, kind: ValueKind) -> ScxmlExpression:
        if kind_of(one) != kind:
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


__all__ = ["SUBSET", "kind_of", "parsed_expression"]
