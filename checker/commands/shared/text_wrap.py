"""Texts wrapped between words, in which what is to be copied, a command or a path, stays whole."""

import re
from textwrap import fill

_BLANK = "\ufdd0"
"""A blank in what stays whole: a sign that Unicode leaves to programs, so that no text has it."""
_COMMAND = re.compile(r"`rovercheck [^`\n]*`")


def whole(thing: object) -> str:
    """A command or a path as one word, which no line end may cut; ``plain`` makes its blanks again."""
    return str(thing).replace(" ", _BLANK)


def plain(text: str) -> str:
    """The text as it is shown."""
    return text.replace(_BLANK, " ")


def fitted(text: str, width: int, indent: int | None = None) -> str:
    """The text, its long lines wrapped; what follows is indented as its line is, or by so many blanks."""
    text = _COMMAND.sub(lambda found: whole(found[0]), text)
    return "\n".join(
        line if len(line) <= width else _folded(line, width, indent) for line in text.split("\n")
    )


def filled(text: str, width: int, first: str = "", then: str = "") -> str:
    """The text as lines of so many columns, wrapped between words; a word that is longer has its own."""
    return fill(
        text, width, initial_indent=first, subsequent_indent=then, break_long_words=False,
        break_on_hyphens=False,
    )  # fmt: skip


def _folded(line: str, width: int, indent: int | None) -> str:
    blanks = len(line) - len(line.lstrip()) if indent is None else indent
    hanging = " " * (blanks if blanks <= width // 2 + 4 else 4)
    return fill(
        line, width, subsequent_indent=hanging, break_long_words=False, break_on_hyphens=False,
        expand_tabs=False, replace_whitespace=False,
    )  # fmt: skip
