"""Measure and wrap text without asking the machine for a font.

Widths are those of DejaVu Sans and Verdana, the widest of the usual sans-serif faces, so text set
in any other face stays inside the space reserved for it.
"""

import re

SIZE = 11
"""Height of the letters of labels and actions, in pixels."""

LINE = 14
"""Distance between two lines of text, in pixels."""

_NARROW = {c: 0.28 for c in "ijlI"} | {c: 0.32 for c in " .,:;'|/\\"} | {c: 0.40 for c in '()[]ftr-!"'}
_WIDE = {c: 0.84 for c in "&#%<>=+*~≥≤≠∧∨¬→°"} | {c: 0.98 for c in "mMW@"} | {c: 0.82 for c in "wGOQ_"}
_WIDTH = _NARROW | _WIDE | {"_": 0.5, "*": 0.5, "w": 0.82, "{": 0.64, "}": 0.64}


def width(text: str, size: int = SIZE, bold: bool = False) -> int:
    """The width of a line of text in pixels, rounded up."""
    ems = sum(_WIDTH.get(c, 0.70 if c.isupper() else 0.62) for c in text)
    return int(ems * size * (1.1 if bold else 1)) + 1


def block(lines: tuple[str, ...], size: int = SIZE) -> tuple[int, int]:
    """Width and height in pixels of lines set below each other; (0, 0) for no lines."""
    return max((width(line, size) for line in lines), default=0), LINE * len(lines)


def _pieces(text: str) -> list[str]:
    """The text cut where a line may end: after a space, but never inside a short operator pair."""
    words = text.split(" ")
    pieces: list[str] = []
    for word in words:
        joined = pieces and (pieces[-1].split(" ")[-1] in _LEADING or _TRAILING.match(word))
        if joined:
            pieces[-1] += " " + word
        else:
            pieces.append(word)
    return pieces


_LEADING = ("&&", "||", "else", "if", "==", "!=", "<", ">", "<=", ">=")
_TRAILING = re.compile(r":=$|(ms|s|cm|ticks?)\b|\w{1,3}\)+;?$")


def wrap(text: str, limit: int, indent: str = "") -> tuple[str, ...]:
    """The text in lines of at most ``limit`` characters where spaces allow it.

    A line rather starts than ends with ``&&`` or ``||``; lines after the first start with ``indent``.
    """
    lines: list[str] = []
    current = start = text[: len(text) - len(text.lstrip(" "))]
    indent = start + indent
    for piece in _pieces(text.lstrip(" ")):
        if current.strip() and len(current) + 1 + len(piece) > limit:
            lines.append(current)
            current = indent + piece
        else:
            current = f"{current} {piece}" if current.strip() else current + piece
    return (*lines, current) if current else tuple(lines)
