"""Scripts of MATLAB as far as they say values: their assignments, each as it is written."""

import re
from collections.abc import Iterator

_PIECE = re.compile(
    r"""
      (?P<more>   \.\.\.[^\n]*(?:\n|$) )
    | (?P<comment>%[^\n]* )
    | (?P<text>   "(?:[^"\n]++|"")*+" | (?<![\w)\]}'.])'(?:[^'\n]++|'')*+' )
    | (?P<open>   [(\[{] )
    | (?P<close>  [)\]}] )
    | (?P<end>    [;,\n] )
    | (?P<other>  [^.%"'()\[\]{};,\n]+ | . )
    """,
    re.VERBOSE,
)
_ASSIGNMENT = re.compile(r"\s*([A-Za-z]\w*(?:\.\w+)?)\s*=(?!=)(.*)", re.DOTALL)


def assignments(text: str) -> Iterator[tuple[str, str]]:
    """Names, or those of a property as ``K.Value``, and values, in their order, as they are written."""
    for statement in _statements("\n".join(_lines(text))):
        found = _ASSIGNMENT.fullmatch(statement)
        if found and (value := found[2].strip()):
            yield found[1], value


def _lines(text: str) -> Iterator[str]:
    """The lines without those in blocks of comments, which nest; one that is open ends with the script."""
    depth = 0
    for line in text.splitlines():
        depth += {"%{": 1, "%}": -1 if depth else 0}.get(line.strip(), 0)
        if not depth:
            yield line


def _statements(text: str) -> Iterator[str]:
    """The statements of a script without comments; line ends in brackets are semicolons."""
    pieces: list[str] = []
    depth = 0
    for piece in _PIECE.finditer(text):
        kind = piece.lastgroup
        if kind == "comment":
            continue
        depth = max(0, depth + {"open": 1, "close": -1}.get(kind or "", 0))
        if kind == "more":
            pieces.append(" ")
        elif kind == "end" and not depth:
            yield "".join(pieces)
            pieces.clear()
        else:
            pieces.append(";" if piece[0] == "\n" else piece[0])
    yield "".join(pieces)


__all__ = ["assignments"]
