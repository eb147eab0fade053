"""Texts from outside made printable: nothing in them commands a terminal, or looks like something else."""

import json
import re
from io import TextIOBase
from typing import TextIO

_UNSURE = re.compile(r"[^\x20-\x7e\n\t]")
"""What may have to be escaped; most texts hold nothing of it."""


def printable(text: str) -> str:
    r"""The text with what is not printable escaped as Python writes it: ``\x1b``, ``\u202e``, ``\udcff``.

    Line ends and tabs stay, and so do all blanks.  What counts as printable is the Unicode category
    (``str.isprintable``): neither control and format characters nor surrogates and what is not assigned.
    """
    return text if text.isascii() and text.isprintable() else _UNSURE.sub(_escaped, text)


def one_line(text: str) -> str:
    r"""The same, with line ends and tabs escaped too: a name that cannot pretend to be two lines."""
    return printable(text).replace("\n", r"\n").replace("\t", r"\t")


def json_text(document: object, indent: int = 2, ascii: bool = False) -> str:
    r"""A document as JSON that is printable itself: ``\u001b``, and 16-bit surrogates beyond ``\uffff``.

    ``ascii``: whatever is not ASCII is written so.
    """
    return _UNSURE.sub(_as_json, json.dumps(document, indent=indent, ensure_ascii=ascii))


class PrintableStream(TextIOBase):
    """A stream for texts from outside, which are written to another one as they are printable."""

    def __init__(self, to: TextIO) -> None:
        self._to = to

    def write(self, text: str) -> int:
        self._to.write(printable(text))
        return len(text)

    def flush(self) -> None:
        self._to.flush()

    def writable(self) -> bool:
        return True

    def isatty(self) -> bool:
        return self._to.isatty()

    def fileno(self) -> int:
        return self._to.fileno()


def _sound(char: str) -> bool:
    return char.isprintable() or (char.isspace() and char not in "\r\v\f\x1c\x1d\x1e\x1f\x85\u2028\u2029")


def _escaped(match: re.Match[str]) -> str:
    char = match.group()
    return char if _sound(char) else char.encode("unicode_escape").decode("ascii")


def _as_json(match: re.Match[str]) -> str:
    char = match.group()
    return char if _sound(char) else json.dumps(char)[1:-1].replace("\x7f", r"\u007f")
