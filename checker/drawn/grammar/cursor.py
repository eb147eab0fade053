"""Where a reader stands in the tokens of a text, and which line breaks and blanks count there."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Literal, NoReturn, TypeAlias, TypeVar

from rovercheck.checker.drawn.grammar.errors import GrammarError
from rovercheck.checker.drawn.grammar.syntax import ActionLanguage
from rovercheck.checker.drawn.grammar.tokens import (
    MOST_NESTED,
    RESERVED_IN_C,
    RESERVED_IN_MATLAB,
    Token,
    TokenKind,
    tokens_of,
)

__all__ = ["Cursor", "Surroundings", "read_whole"]

Surroundings: TypeAlias = Literal["lines", "brackets", "entries"]
"""Line breaks count, or nothing does, or line breaks and blanks do as between the entries of a matrix."""

T = TypeVar("T")


class Cursor:
    """A position in the tokens of a text, the surroundings there, and how deep it stands."""

    def __init__(self, text: str, language: ActionLanguage) -> None:
        self.text = text
        self.language = language
        self.tokens = tokens_of(text, language)
        self.position = 0
        self.surroundings: Surroundings = "lines"
        self.in_index = False
        self._statements = 0

    @property
    def matlab(self) -> bool:
        """Whether the language is MATLAB."""
        return self.language is ActionLanguage.MATLAB

    @property
    def token(self) -> Token:
        """The token that is next."""
        if self.surroundings == "brackets":
            self.skip_lines()
        return self.tokens[self.position]

    def ahead(self, count: int = 1) -> Token:
        """The token so many after the next one, line breaks included; the end has no other after it."""
        return self.tokens[min(self.position + count, len(self.tokens) - 1)]

    def advance(self) -> Token:
        """Take the next token."""
        token = self.token
        if token.kind is not TokenKind.END:
            self.position += 1
        return token

    def skip_lines(self) -> None:
        """Go on to what is no line break."""
        while self.tokens[self.position].kind is TokenKind.LINE:
            self.position += 1

    def skip_separators(self) -> None:
        """Go on behind line breaks, semicolons and commas."""
        while self.token.kind is TokenKind.LINE or self.at_sign(";", ","):
            self.position += 1

    def at_sign(self, *signs: str) -> bool:
        """Whether one of these signs is next."""
        token = self.token
        return token.kind is TokenKind.SIGN and token.text in signs

    def at_word(self, *words: str) -> bool:
        """Whether one of these words is next."""
        token = self.token
        return token.kind is TokenKind.NAME and token.text in words

    def behind_lines(self) -> Token:
        """The next token that is no line break."""
        position = self.position
        while self.tokens[position].kind is TokenKind.LINE:
            position += 1
        return self.tokens[position]

    def at_end(self) -> bool:
        """Whether nothing is left."""
        return self.token.kind is TokenKind.END

    def take(self, sign: str) -> bool:
        """Take this sign if it is next, and say so."""
        found = self.at_sign(sign)
        if found:
            self.position += 1
        return found

    def expect(self, sign: str, why: str) -> Token:
        """Take this sign, which must be next."""
        if not self.at_sign(sign):
            self.refuse_sign()
            self.fail(f"{self.shown()} stands where '{sign}' must: {why}")
        return self.advance()

    def name(self, what: str) -> Token:
        """Take a name that is no keyword; ``what`` says of what."""
        token = self.token
        if token.kind is not TokenKind.NAME or self.is_keyword(token):
            because = ", and is a keyword" if token.kind is TokenKind.NAME else ""
            self.fail(f"{self.shown()} stands where the name of {what} must{because}")
        return self.advance()

    def is_keyword(self, token: Token) -> bool:
        """Whether the token is a word that the language reserves."""
        reserved = RESERVED_IN_MATLAB if self.matlab else RESERVED_IN_C
        return token.kind is TokenKind.NAME and token.text in reserved

    def refuse_sign(self) -> None:
        """Raise an error if ``=`` is next, where a comparison may be meant, or the ``?`` of C."""
        if self.at_sign("="):
            self.fail("'=' assigns, and nothing can be assigned here: to compare, write '=='")
        if self.at_sign("?"):
            self.fail("charts have no conditional values, as in a ? b : c: assign in two transitions")

    def shown(self) -> str:
        """What is next, for a message."""
        token = self.token
        match token.kind:
            case TokenKind.END:
                return "the end of the text"
            case TokenKind.LINE:
                return "the end of the line"
            case TokenKind.TEXT:
                return f"the text {token.text}"
            case _:
                return f"'{token.text}'"

    def fail(self, message: str, at: int | None = None) -> NoReturn:
        """Raise an error at an offset, or at the next token."""
        raise GrammarError(message, self.text, self.token.at if at is None else at)

    @contextmanager
    def inside(self, surroundings: Surroundings, index: bool = False) -> Iterator[None]:
        """Other surroundings for a while; of an index, ``end`` is the last one."""
        before = self.surroundings, self.in_index
        self.surroundings, self.in_index = surroundings, index or self.in_index
        yield
        self.surroundings, self.in_index = before

    @contextmanager
    def nested(self, at: int) -> Iterator[None]:
        """One statement deeper for a while, up to a bound."""
        self._statements += 1
        if self._statements > MOST_NESTED:
            self.fail(f"more than {MOST_NESTED} statements in each other: make a function of a part", at)
        yield
        self._statements -= 1


def read_whole(text: str, language: ActionLanguage, read: Callable[[Cursor], T], what: str) -> T:
    """What a function reads from a text, of which nothing may be left."""
    cursor = Cursor(text, language)
    found = read(cursor)
    cursor.skip_lines()
    if not cursor.at_end():
        cursor.refuse_sign()
        cursor.fail(f"{cursor.shown()} stands behind the end of {what}")
    return found
