"""Where a key stands in a TOML file, which its reader does not tell."""

import tomllib
from collections.abc import Iterator, Mapping, Sequence
from typing import Any


def line_of(text: str, path: Sequence[str]) -> int | None:
    """The line, from 1, of the key at the end of a path of tables, or of the table nearest to it.

    ``None`` where none is found.  Tables within one line share it.
    """
    best, depth = None, 0
    for number, at in _keys(text):
        same = _common(at, path)
        if same > depth:
            best, depth = number, same
    return best


def _common(one: Sequence[str], other: Sequence[str]) -> int:
    """How many keys of the whole of ``one`` the other begins with."""
    return len(one) if tuple(other[: len(one)]) == tuple(one) else 0


def _keys(text: str) -> Iterator[tuple[int, tuple[str, ...]]]:
    """The path of every key and table that begins a line."""
    table: tuple[str, ...] = ()
    open_text = ""
    for number, line in enumerate(text.splitlines(), 1):
        if open_text:
            open_text = "" if open_text in line else open_text
            continue
        written = line.strip()
        if written.startswith("["):
            if (path := _path_of(written)) is not None:
                table = path
                yield number, table
        elif (path := _path_of(f"{_before_value(written)} = 0")) is not None:
            yield number, (*table, *path)
        open_text = next((quotes for quotes in ('"""', "'''") if line.count(quotes) % 2), "")


def _before_value(line: str) -> str:
    """What stands in front of the first ``=`` outside of quotes."""
    quoted = ""
    for at, sign in enumerate(line):
        if quoted:
            quoted = "" if sign == quoted else quoted
        elif sign in "\"'":
            quoted = sign
        elif sign == "=":
            return line[:at]
    return ""


def _path_of(line: str) -> tuple[str, ...] | None:
    """The keys of a line that is a table, or a key with a value, on its own."""
    try:
        found: Any = tomllib.loads(line)
    except (tomllib.TOMLDecodeError, RecursionError):
        return None
    path: list[str] = []
    while True:
        if isinstance(found, list) and found:
            found = found[-1]
        if not isinstance(found, Mapping) or len(found) != 1:
            return tuple(path) or None
        ((key, found),) = found.items()
        path.append(key)
