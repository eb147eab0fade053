"""The words, numbers, texts and signs of a chart's text, in either language, without comments."""

import re
from dataclasses import dataclass
from enum import Enum, auto

from rovercheck.checker.drawn.grammar.errors import GrammarError
from rovercheck.checker.drawn.grammar.syntax import ActionLanguage

__all__ = ["MOST_NESTED", "RESERVED_IN_C", "RESERVED_IN_MATLAB", "Token", "TokenKind", "tokens_of"]

MOST_NESTED = 50
"""So many brackets, or statements, may stand in each other."""

RESERVED_IN_MATLAB = frozenset(
    [
        "if", "elseif", "else", "end", "for", "while", "switch", "case", "otherwise", "return", "break",
        "continue", "persistent", "global", "function", "try", "catch", "parfor", "spmd", "classdef",
    ]
)  # fmt: skip
RESERVED_IN_C = frozenset(
    [
        "if", "else", "for", "while", "do", "switch", "case", "default", "return", "break", "continue",
        "goto",
    ]
)  # fmt: skip

_BLANK = re.compile(r"[ \t\f\v\xa0]+")
_LINE_END = re.compile(r"\r\n?|\n")
_REST_OF_LINE = re.compile(r"[^\r\n]*")
_NAME = re.compile(r"[A-Za-z_][A-Za-z0-9_]*")
# `1./x` divides 1 element by element, `1...` goes on in the next line: neither point belongs to the number.
_MATLAB_NUMBER = re.compile(
    r"0[xX][0-9A-Fa-f]+(?:[us][0-9]+)?|0[bB][01]+(?:[us][0-9]+)?"
    r"|(?:[0-9]+(?:\.(?![*/\\^']|\.\.)[0-9]*)?|\.[0-9]+)(?:[eEdD][+-]?[0-9]+)?"
)
_C_NUMBER = re.compile(
    r"0[xX][0-9A-Fa-f]+[uUlL]*|0[bB][01]+[uUlL]*"
    r"|(?:[0-9]+(?:\.(?!\.\.)[0-9]*)?|\.[0-9]+)(?:[eE][+-]?[0-9]+)?(?:[fF]|[uUlL]+)?"
)
_COMMON = r"\|\||&&|==|!=|~=|<=|>=|\+=|-=|\*=|/=|&=|\|=|\^=|[-+*/^&|!~<>=()\[\]{},;:.?@]"
# A MATLAB `++` is one sign only where the statement ends behind it: `a++b` adds `+b`.
_MATLAB_SIGN = re.compile(
    rf"(?:\+\+|--)(?=[ \t]*(?:[;,}}\r\n%]|//|/\*|\.\.\.|\Z))|\.\^|\.\*|\./|\.\\|\.'|{_COMMON}|['\\]"
)
_C_SIGN = re.compile(rf"\+\+|--|->|<<|>>|<>|%%|:=|{_COMMON}")
_MATLAB_TEXT = {"'": re.compile(r"'(?:[^'\r\n]|'')*'"), '"': re.compile(r'"(?:[^"\r\n]|"")*"')}
_C_TEXT = {
    "'": re.compile(r"'(?:[^'\\\r\n]|\\[^\r\n]|'')*'"),
    '"': re.compile(r'"(?:[^"\\\r\n]|\\[^\r\n])*"'),
}
_BLOCK_COMMENT = re.compile(r"[ \t]*%([{}])[ \t]*")
_PARTNER = {")": "(", "]": "[", "}": "{"}


class TokenKind(Enum):
    """What a token is; a line break is one too, and the last token is the end."""

    NAME = auto()
    NUMBER = auto()
    TEXT = auto()
    SIGN = auto()
    LINE = auto()
    END = auto()


@dataclass(slots=True)
class Token:
    """A token with its offset.

    ``blank`` says whether something that is no token stands before it; ``partner`` is, of a bracket, the
    position of the other one in the list of tokens.
    """

    kind: TokenKind
    text: str
    at: int
    blank: bool
    partner: int = -1


def tokens_of(text: str, language: ActionLanguage) -> list[Token]:
    """The tokens of a text, with an end.

    Raises ``GrammarError`` for a character or bracket without meaning, and beyond ``MOST_NESTED`` brackets.
    """
    reader = _Tokenizer(text, language)
    while reader.at < len(text):
        reader.step()
    if reader.open:
        bracket = reader.tokens[reader.open[-1]]
        raise GrammarError(f"'{bracket.text}' is never closed", text, bracket.at)
    reader.add(TokenKind.END, "")
    return reader.tokens


class _Tokenizer:
    def __init__(self, text: str, language: ActionLanguage) -> None:
        self.text = text
        self.at = 0
        self.tokens: list[Token] = []
        self.open: list[int] = []
        self.blank = False
        self.matlab = language is ActionLanguage.MATLAB
        self.number, self.sign, self.quoted = (
            (_MATLAB_NUMBER, _MATLAB_SIGN, _MATLAB_TEXT) if self.matlab else (_C_NUMBER, _C_SIGN, _C_TEXT)
        )

    def add(self, kind: TokenKind, text: str) -> None:
        """A token stands at the offset."""
        self.tokens.append(Token(kind, text, self.at, self.blank))
        self.at += len(text)
        self.blank = False

    def skip(self, end: int) -> None:
        """Go on behind what means nothing."""
        self.at, self.blank = end, True

    def step(self) -> None:
        """Read what stands at the offset: a token, a blank or a comment."""
        if self._skipped():
            return
        text, at, first = self.text, self.at, self.text[self.at]
        if match := _LINE_END.match(text, at):
            self.add(TokenKind.LINE, match[0])
        elif match := _NAME.match(text, at):
            self.add(TokenKind.NAME, match[0])
        elif match := self.number.match(text, at):
            self.add(TokenKind.NUMBER, match[0])
        elif first in self.quoted and not (self.matlab and first == "'" and self._transposes()):
            self._quoted(first)
        elif match := self.sign.match(text, at):
            self._sign(match[0])
        else:
            raise GrammarError(f"{first!r} has no meaning here", text, at)

    def _skipped(self) -> bool:
        text, at = self.text, self.at
        if match := _BLANK.match(text, at):
            self.skip(match.end())
        elif text.startswith("...", at):
            end = _rest(text, at)
            line_end = _LINE_END.match(text, end)
            self.skip(line_end.end() if line_end else end)
        elif text.startswith("/*", at):
            end = text.find("*/", at + 2)
            if end < 0:
                raise GrammarError("the comment that begins with /* never ends: close it with */", text, at)
            self.skip(end + 2)
        elif text.startswith("//", at):
            self.skip(_rest(text, at))
        elif text.startswith("%", at) and not self._is_remainder():
            self._percent_comment()
        else:
            return False
        return True

    def _is_remainder(self) -> bool:
        # At the beginning of a line `%%` heads a comment, as in MATLAB.
        return not self.matlab and self.text.startswith("%%", self.at) and self._after_operand()

    def _percent_comment(self) -> None:
        text, at = self.text, self.at
        fresh = not self.tokens or self.tokens[-1].kind is TokenKind.LINE
        end = _rest(text, at)
        if not (self.matlab and fresh and text[at:end].rstrip() == "%{"):
            self.skip(end)
            return
        deep = 1
        while deep:
            line_end = _LINE_END.match(text, end)
            if line_end is None:
                raise GrammarError("the comment that begins with %{ never ends: close it with %}", text, at)
            start, end = line_end.end(), _rest(text, line_end.end())
            if mark := _BLOCK_COMMENT.fullmatch(text, start, end):
                deep += 1 if mark[1] == "{" else -1
        self.skip(end)

    def _after_operand(self) -> bool:
        """Whether the last token ends an operand."""
        last = self.tokens[-1] if self.tokens else None
        if last is None:
            return False
        if last.kind is TokenKind.NAME and self.matlab and last.text in RESERVED_IN_MATLAB - {"end"}:
            return len(self.tokens) > 1 and self.tokens[-2].text == "."
        if last.kind in (TokenKind.NAME, TokenKind.NUMBER, TokenKind.TEXT):
            return True
        return last.text in (")", "]", "}", "'", ".'")

    def _transposes(self) -> bool:
        """Whether a quote transposes what stands before it, rather than begin a text."""
        if not self._after_operand() or not self.blank:
            return self._after_operand()
        if self.open and self.tokens[self.open[-1]].text != "(":
            return False
        # `disp 'text'` at the beginning of a statement is a command.
        before = self.tokens[-2] if len(self.tokens) > 1 else None
        begins = before is None or before.kind is TokenKind.LINE or before.text in (";", ",", "{")
        return not (begins and self.tokens[-1].kind is TokenKind.NAME)

    def _quoted(self, quote: str) -> None:
        match = self.quoted[quote].match(self.text, self.at)
        if match is None:
            raise GrammarError(
                f"the text that begins with {quote} does not end in its line: close it", self.text, self.at
            )
        self.add(TokenKind.TEXT, match[0])

    def _sign(self, sign: str) -> None:
        at = self.at
        self.add(TokenKind.SIGN, sign)
        here = len(self.tokens) - 1
        if sign in _PARTNER.values():
            self.open.append(here)
            if len(self.open) > MOST_NESTED:
                raise GrammarError(
                    f"more than {MOST_NESTED} brackets in each other: name a part of it", self.text, at
                )
        elif sign in _PARTNER:
            other = self.open.pop() if self.open else None
            if other is None:
                raise GrammarError(f"'{sign}' closes nothing: it has no '{_PARTNER[sign]}'", self.text, at)
            if self.tokens[other].text != _PARTNER[sign]:
                opened = self.tokens[other].text
                raise GrammarError(f"'{sign}' cannot close '{opened}'", self.text, at)
            self.tokens[here].partner, self.tokens[other].partner = other, here


def _rest(text: str, at: int) -> int:
    match = _REST_OF_LINE.match(text, at)
    return match.end() if match else at
