"""Errors in labels: the place in the text, a caret under it, and the line and column of the model's file."""

import ast
import linecache
from collections.abc import Sequence
from dataclasses import dataclass, field
from unicodedata import combining, east_asian_width

from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.place import CallExtent, Place, call_extent, here

_SHOWN = 100
"""Signs of a long line that are shown around an error."""


@dataclass(frozen=True)
class Extent:
    """Part of a text: where it starts, and where the sign after it is, both counted from 0."""

    start: int
    end: int


class LabelError(ModelError):
    """What has no meaning in a label: what is wrong with which part of the text."""

    def __init__(self, said: str, at: Extent) -> None:
        super().__init__(said)
        self.said, self.at = said, at


class UnknownName(LabelError):
    """A name in a label that stands for nothing there."""

    def __init__(self, name: str, near: str, at: Extent) -> None:
        super().__init__(f"`{name}` is unknown here. {near}", at)
        self.name = name


@dataclass(frozen=True)
class LabelText:
    """A text of the model, and the call that it is written in: its place, and where it begins and ends."""

    text: str
    place: Place | None = field(default=None, compare=False)
    call: CallExtent = field(default=((0, 0), (0, 0)), compare=False)

    def fault(self, of: str, error: LabelError) -> str:
        """The error with its place before it and the line of the text under it, a caret below."""
        start = min(max(error.at.start, 0), len(self.text))
        line, column = _position(self.text, start)
        shown = _underlined(self.text, start, max(error.at.end, start + 1))
        where = _in_file(self, start)
        if where is not None:
            return f"{where}: {of}: {error.said}\n{shown}"
        many = f"line {line}, " if "\n" in self.text else ""
        before = f"{self.place}: " if self.place else ""
        return f"{before}{of}, {many}column {column} of the label: {error.said}\n{shown}"


def label_text(text: str) -> LabelText:
    """A text that is written where the language is called from."""
    return LabelText(text, here(), call_extent())


def _position(text: str, at: int) -> tuple[int, int]:
    """The line and the column, both counted from 1."""
    return text.count("\n", 0, at) + 1, at - (text.rfind("\n", 0, at) + 1) + 1


def _underlined(text: str, start: int, end: int) -> str:
    """The line that an error is in, with a caret below each sign of the part that it is about."""
    first = text.rfind("\n", 0, start) + 1
    last = text.find("\n", start)
    last = len(text) if last < 0 else last
    end = min(end, max(last, start + 1))
    cut_left, cut_right = max(first, start - _SHOWN // 2), min(last, max(end, start + _SHOWN // 2))
    cut_right = min(cut_right, cut_left + 2 * _SHOWN)
    before = _printable(text[cut_left:start])
    about = _printable(text[start : min(end, cut_right)])
    after = _printable(text[min(end, cut_right) : cut_right])
    left, right = "..." if cut_left > first else "", "..." if cut_right < last else ""
    gap = " " * (len(left) + _width(before))
    return f"    {left}{before}{about}{after}{right}\n    {gap}{'^' * max(_width(about), 1)}"


def _printable(text: str) -> str:
    """Each sign as one that a terminal shows."""
    return "".join(sign if sign.isprintable() else " " if sign in "\t\r\n" else "�" for sign in text)


def _width(text: str) -> int:
    """Columns of a terminal that a text takes."""
    return sum(0 if combining(sign) else 2 if east_asian_width(sign) in "WF" else 1 for sign in text)


def _in_file(label: LabelText, at: int) -> str | None:
    """File, line and column of a sign of a label that stands in the file letter by letter; else nothing."""
    if label.place is None or not label.text:
        return None
    linecache.checkcache(label.place.file)
    lines = linecache.getlines(label.place.file)
    for node in _texts("".join(lines), label):
        begin = _opening(lines, node, label.text)
        if begin is None:
            continue
        line, column = _position(label.text, at)
        column += begin[1] if line == 1 else 0
        return f"{label.place.path}:{begin[0] + line - 1}:{column}"
    return None


def _texts(source: str, label: LabelText) -> Sequence[ast.Constant]:
    """The texts in the call that are the label."""
    try:
        nodes = ast.walk(ast.parse(source))
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return ()
    found = [n for n in nodes if isinstance(n, ast.Constant) and n.value == label.text]
    first, last = label.call
    return [
        n
        for n in found
        if first <= (n.lineno, n.col_offset) and (n.end_lineno or 0, n.end_col_offset or 0) <= last
    ]


def _opening(lines: Sequence[str], node: ast.Constant, text: str) -> tuple[int, int] | None:
    """The line, from 1, and the signs of it that precede the text, unless it is written with escapes."""
    line = lines[node.lineno - 1]
    before = len(line.encode()[: node.col_offset].decode())
    rest = line[before:] + "".join(lines[node.lineno :])
    quote = next((q for q in ('"""', "'''", '"', "'") if rest.startswith(q)), None)
    if quote is None or not rest[len(quote) :].startswith(text + quote):
        return None
    return node.lineno, before + len(quote)
