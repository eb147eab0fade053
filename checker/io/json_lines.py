"""JSON of a stranger with the line of each value: no names twice, no depth or number without a bound."""

import json
import re
from collections.abc import Mapping
from dataclasses import dataclass, field

from rovercheck.spec_model.lang.errors import ModelError, brief

MOST_DEPTH = 200
"""Values in each other."""
MOST_VALUES = 500_000
"""Values of a text."""
LONGEST_NUMBER = 30
"""Letters of a number."""
_SPACE = re.compile(r"[ \t\r\n]*")
_STRING = re.compile(r'"((?:[^"\\\x00-\x1f]|\\(?:["\\/bfnrt]|u[0-9a-fA-F]{4}))*)"')
_NUMBER = re.compile(r"-?(?:0|[1-9]\d*)(\.\d+)?([eE][-+]?\d+)?")
_WORDS: Mapping[str, bool | None] = {"true": True, "false": False, "null": None}


@dataclass(slots=True)
class JsonValue:
    """A value and its line: an ``object`` by name, a ``list``, a text, a truth value, a number or null.

    A number that is no whole one is its text, ``number`` says so.
    """

    line: int
    plain: str | bool | int | None = None
    object: dict[str, "JsonValue"] | None = None
    list: "list[JsonValue] | None" = None
    number: bool = field(default=False)

    @property
    def text(self) -> str | None:
        """The text that it is; nothing for another value."""
        return self.plain if isinstance(self.plain, str) and not self.number else None

    @property
    def null(self) -> bool:
        """Whether it is null."""
        return self.plain is None and self.object is None and self.list is None


def parsed_json(data: bytes, place: str) -> JsonValue:
    """The value of a text in UTF-8 that stands at ``place``.  Raises ``ModelError`` with the line."""
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise ModelError(f"{place}, line 1: this is no text in UTF-8: {error.reason}.") from error
    return _Parser(text, place).whole()


class _Parser:
    def __init__(self, text: str, place: str) -> None:
        self.text, self.place, self.at, self.line, self.counted = text, place, 0, 1, 0
        self.values = 0

    def whole(self) -> JsonValue:
        found = self._value(0)
        self._space()
        if self.at < len(self.text):
            raise self._fault("something after the end of the value")
        return found

    def _fault(self, what: str) -> ModelError:
        return ModelError(f"{self.place}, line {self._line()}: this is no JSON: {what}.")

    def _line(self) -> int:
        self.line += self.text.count("\n", self.counted, self.at)
        self.counted = self.at
        return self.line

    def _space(self) -> str:
        found = _SPACE.match(self.text, self.at)
        assert found is not None
        self.at = found.end()
        return self.text[self.at : self.at + 1]

    def _value(self, depth: int) -> JsonValue:
        begin = self._space()
        made = JsonValue(self._line())
        self.values += 1
        if self.values > MOST_VALUES:
            raise ModelError(
                f"{self.place}, line {made.line}: more than {MOST_VALUES:,} values are not read."
            )
        if depth > MOST_DEPTH:
            raise ModelError(
                f"{self.place}, line {made.line}: more than {MOST_DEPTH} values in each other are not read."
            )
        if begin == "{":
            made.object = self._object(depth)
        elif begin == "[":
            made.list = self._list(depth)
        elif begin == '"':
            made.plain = self._string()
        else:
            self._word(made)
        return made

    def _object(self, depth: int) -> dict[str, JsonValue]:
        found: dict[str, JsonValue] = {}
        self.at += 1
        if self._space() == "}":
            self.at += 1
            return found
        while True:
            if self._space() != '"':
                raise self._fault("a name in quotes is expected")
            name = self._string()
            if name in found:
                raise self._fault(f"the name {brief(name)} stands twice in an object")
            if self._space() != ":":
                raise self._fault(f"a colon is expected after {brief(name)}")
            self.at += 1
            found[name] = self._value(depth + 1)
            if self._after("}"):
                return found

    def _list(self, depth: int) -> list[JsonValue]:
        found: list[JsonValue] = []
        self.at += 1
        if self._space() == "]":
            self.at += 1
            return found
        while True:
            found.append(self._value(depth + 1))
            if self._after("]"):
                return found

    def _after(self, end: str) -> bool:
        """Whether the end follows; false after a comma."""
        mark = self._space()
        if mark not in (",", end) or not mark:
            raise self._fault(f"a comma or {end} is expected")
        self.at += 1
        return mark == end

    def _string(self) -> str:
        found = _STRING.match(self.text, self.at)
        if found is None:
            raise self._fault("a text that does not end, or holds what none may")
        self.at = found.end()
        text = str(json.loads(found[0]))
        if any("\ud800" <= one <= "\udfff" for one in text):
            raise self._fault("a text with half of a character")
        return text

    def _word(self, made: JsonValue) -> None:
        number = _NUMBER.match(self.text, self.at)
        if number is not None:
            self.at = number.end()
            if len(number[0]) > LONGEST_NUMBER:
                raise self._fault(f"a number of more than {LONGEST_NUMBER} letters")
            whole = number[1] is None and number[2] is None
            made.plain, made.number = int(number[0]) if whole else number[0], not whole
            return
        for word, value in _WORDS.items():
            if self.text.startswith(word, self.at):
                self.at += len(word)
                made.plain = value
                return
        raise self._fault(f"{brief(self.text[self.at : self.at + 12]) or 'its end'} is no value")


__all__ = ["JsonValue", "parsed_json"]
