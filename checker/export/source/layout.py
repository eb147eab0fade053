"""Calls and lists of Python as text, in lines of a width, as formatters of Python lay them out."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

WIDTH = 88
INDENT = "    "


@dataclass(frozen=True)
class Call:
    """``head(parts)``; a list has the head ``[``.

    Where it does not fit into a line, each part has its own.
    """

    head: str
    parts: "tuple[Source, ...]"

    @property
    def ends(self) -> tuple[str, str]:
        return ("[", "]") if self.head == "[" else (f"{self.head}(", ")")


@dataclass(frozen=True)
class Keyword:
    """``name=value``."""

    name: str
    value: "Source"


@dataclass(frozen=True)
class Lines:
    """A text in quotes of several lines, of which those after the first are indented beneath it."""

    lines: tuple[str, ...]


@dataclass(frozen=True)
class Commented:
    """What has comments above it, a line each."""

    comments: tuple[str, ...]
    value: "Source"


Source = str | Call | Keyword | Lines | Commented


def call(head: str, *parts: Source) -> Call:
    """A call."""
    return Call(head, parts)


def listed(parts: Sequence[Source]) -> Call:
    """A list."""
    return Call("[", tuple(parts))


def laid_out(source: Source, indent: str = "", before: str = "", after: str = "") -> list[str]:
    """The lines, of which the first begins with ``before``, and the last ends with ``after``."""
    short = _flat(source)
    if short is not None and len(f"{indent}{before}{short}{after}") <= WIDTH:
        return [f"{indent}{before}{short}{after}"]
    match source:
        case str():
            return [f"{indent}{before}{source}{after}"]
        case Keyword(name, value):
            return laid_out(value, indent, f"{before}{name}=", after)
        case Commented(comments, value):
            return [
                *(f"{indent}# {one}".rstrip() for one in comments),
                *laid_out(value, indent, before, after),
            ]
        case Lines(lines):
            return list(_quoted(lines, f"{indent}{before}", after))
        case Call(_, parts):
            start, end = source.ends
            inner = [line for part in parts for line in laid_out(part, indent + INDENT, after=",")]
            return [f"{indent}{before}{start}", *inner, f"{indent}{end}{after}"]


def _quoted(lines: Sequence[str], before: str, after: str) -> Iterator[str]:
    quotes = '"""'
    blank = " " * (len(before) + len(quotes))
    for number, line in enumerate(lines):
        shown = f"{blank if number else before + quotes}{line}"
        yield f"{shown}{quotes}{after}" if number == len(lines) - 1 else shown


def _flat(source: Source) -> str | None:
    """The source in one line, if it may stand in one."""
    match source:
        case str():
            return source
        case Keyword(name, value):
            inner = _flat(value)
            return None if inner is None else f"{name}={inner}"
        case Call(_, parts):
            some = [_flat(part) for part in parts]
            if None in some:
                return None
            start, end = source.ends
            return f"{start}{', '.join(filter(None, some))}{end}"
    return None


def quoted(text: str) -> str:
    """A text in quotes, double ones where that needs no backslash."""
    shown = repr(text)
    if shown.startswith("'") and '"' not in text:
        return '"' + shown[1:-1].replace("\\'", "'") + '"'
    return shown


__all__ = ["WIDTH", "Call", "Commented", "Keyword", "Lines", "Source", "call", "laid_out", "listed", "quoted"]
