"""Numbers and texts as they are written: what they are exactly."""

import re
from fractions import Fraction
from typing import Literal

from rovercheck.checker.drawn.grammar.cursor import Cursor
from rovercheck.checker.drawn.grammar.syntax import Applied, Name, Number, NumberKind, TextLiteral
from rovercheck.checker.drawn.grammar.tokens import Token, TokenKind

__all__ = ["MOST_DIGITS", "number", "quoted_text"]

MOST_DIGITS = 400
"""So many digits may be written, and so large may a decimal exponent be: no double needs more."""

_SIZED = re.compile(r"(0[xXbB][0-9A-Fa-f]+?)([us])(8|16|32|64)")
_ESCAPED = re.compile(r"\\([abfnrtv0\\'\"?])")
_CONTROL = {"a": "\a", "b": "\b", "f": "\f", "n": "\n", "r": "\r", "t": "\t", "v": "\v", "0": "\0"}


def number(cursor: Cursor) -> Number | Applied:
    """The number that is next; ``0xFFu8`` of MATLAB is the conversion ``uint8(0xFF)``."""
    token = cursor.advance()
    after = cursor.tokens[cursor.position]
    if after.kind in (TokenKind.NAME, TokenKind.NUMBER) and not after.blank:
        if cursor.matlab and after.text in ("i", "j"):
            cursor.fail("complex numbers are not supported", after.at)
        cursor.fail(f"'{token.text}{after.text}' is neither a number nor a name", token.at)
    if len(token.text) > MOST_DIGITS:
        cursor.fail(f"the number has more than {MOST_DIGITS} digits", token.at)
    if token.text[:2] in ("0x", "0X", "0b", "0B"):
        return _bits(cursor, token)
    suffix: Literal["f", "u", ""] = ""
    text = token.text
    if not cursor.matlab and text[-1] in "fF":
        text, suffix = text[:-1], "f"
    elif not cursor.matlab and text[-1] in "uUlL":
        text, suffix = text.rstrip("uUlL"), "u"
    value = _decimal(cursor, token, text)
    if cursor.matlab:
        kind = NumberKind.DOUBLE
    elif suffix == "f":
        kind = NumberKind.SINGLE
    else:
        kind = NumberKind.INTEGER if text.isdigit() else NumberKind.FLOATING
    if suffix == "u" and kind is NumberKind.FLOATING:
        cursor.fail(
            f"'{token.text}' is no number: only a whole number may end with {token.text[-1]}", token.at
        )
    return Number(value, kind, text, token.at)


def _bits(cursor: Cursor, token: Token) -> Number | Applied:
    text, size = token.text, ""
    if not cursor.matlab:
        text = text.rstrip("uUlL")
    elif sized := _SIZED.fullmatch(text):
        text, size = sized[1], ("uint" if sized[2] == "u" else "int") + sized[3]
    base = 16 if text[1] in "xX" else 2
    try:
        value = Fraction(int(text[2:], base))
    except ValueError:
        cursor.fail(f"'{token.text}' is no number: behind a size must stand 8, 16, 32 or 64", token.at)
    found = Number(value, NumberKind.BITS, text, token.at)
    return Applied(Name(size, token.at), (found,), token.at) if size else found


def _decimal(cursor: Cursor, token: Token, text: str) -> Fraction:
    digits, _, exponent = text.replace("d", "e").replace("D", "e").replace("E", "e").partition("e")
    power = int(exponent or "0")
    if abs(power) > MOST_DIGITS:
        cursor.fail(f"the exponent of '{token.text}' is beyond {MOST_DIGITS}", token.at)
    whole, _, behind = digits.partition(".")
    return Fraction(int(whole + behind)) * Fraction(10) ** (power - len(behind))


def quoted_text(cursor: Cursor) -> TextLiteral:
    """The text between quotes that is next: doubled quotes are one, C's escapes are what they stand for."""
    token = cursor.advance()
    quote, inner = token.text[0], token.text[1:-1]
    if cursor.matlab or quote == "'":
        inner = inner.replace(2 * quote, quote)
    if not cursor.matlab:
        inner = _ESCAPED.sub(lambda match: _CONTROL.get(match[1], match[1]), inner)
    return TextLiteral(inner, quote, token.at)
