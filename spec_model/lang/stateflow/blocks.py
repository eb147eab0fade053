"""Conditional actions without braces: by indentation, as charts print them, or up to ``end``, as in MATLAB.

The parser reads braces only; here they are put in.
"""

from collections.abc import Iterator

from lark import Token
from lark.lark import PostLex

_ENDS = ("NAME", "STRANGE", "NUMBER", "QUANTITY", "RPAR", "RSQB")
"""What the condition of an `if` can end with."""
_STARTS = ("NAME", "STRANGE", "IF")
"""What an action can start with."""
_OPEN, _CLOSE = ("LPAR", "LSQB"), ("RPAR", "RSQB")


class Blocks(PostLex):
    """Puts braces around the actions of an `if` that are written without; ``ended`` says that `end` does."""

    always_accept = ("NAME", "STRANGE", "IF", "ELSE", "ELSEIF", "END", "COMMA", "SEMICOLON", "SECTION", "ON")

    def __init__(self, ended: bool) -> None:
        self._ended = ended

    def process(self, stream: Iterator[Token]) -> Iterator[Token]:
        """The tokens, with braces put in."""
        return _Reader(self._ended).process(stream)


class _Reader:
    """What is open in one text: a column for each block by indentation, None for one in braces."""

    def __init__(self, ended: bool) -> None:
        self._ended = ended
        self._open: list[int | None] = []
        self._head: int | None = None  # the column of an `if` or `else` whose actions have not begun
        self._depth, self._margin, self._before = 0, 1, Token("", "")

    def process(self, stream: Iterator[Token]) -> Iterator[Token]:
        last = None
        for token in stream:
            first = last is None or (token.line or 1) > (last.end_line or 1)
            if first:
                self._margin = token.column or 1
            yield from self._token(token, first)
            last = self._before = token
        while last is not None and self._open and self._open.pop() is not None and not self._ended:
            yield _brace("RBRACE", "}", last)

    def _token(self, token: Token, first: bool) -> Iterator[Token]:
        if self._head is not None and self._depth == 0:
            yield from self._begun(token, first)
        elif first and not self._ended:
            while self._open and (column := self._open[-1]) is not None and self._margin <= column:
                self._open.pop()
                yield _brace("RBRACE", "}", self._before)
        self._depth += (token.type in _OPEN) - (token.type in _CLOSE)
        match token.type:
            case "LBRACE":
                self._open.append(None)
            case "RBRACE":
                while self._open and self._open.pop() is not None:
                    yield _brace("RBRACE", "}", self._before)
            case "END" if self._ended and self._open and self._open[-1] is not None:
                self._open.pop()
                yield _brace("RBRACE", "}", self._before)
                return
            case "ELSE" | "ELSEIF" if self._ended and self._open and self._open[-1] is not None:
                self._open.pop()
                yield _brace("RBRACE", "}", self._before)
        if token.type in ("IF", "ELSE", "ELSEIF"):
            self._head = self._margin
        yield token

    def _begun(self, token: Token, first: bool) -> Iterator[Token]:
        """The brace before the first action, where there is none but should be one."""
        other, apart = self._before.type == "ELSE", first and token.type in _STARTS
        if token.type == "LBRACE" or (other and token.type == "IF" and not first):
            self._head = None
        elif (other and token.type in _STARTS and (first or self._ended)) or (
            self._before.type in _ENDS and (apart or (self._ended and token.type in ("SEMICOLON", "COMMA")))
        ):
            assert self._head is not None
            self._open.append(self._head)
            self._head = None
            yield _brace("LBRACE", "{", self._before)


def _brace(kind: str, sign: str, after: Token) -> Token:
    """A brace right after a token, where nothing stands."""
    at, line, column = after.end_pos, after.end_line, after.end_column
    return Token(kind, sign, at, line, column, line, column, at)
