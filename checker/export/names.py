"""Names that other languages accept, as close to ours as they can be."""

import re
from collections.abc import Collection, Iterable


def identifiers(names: Iterable[str], reserved: Collection[str] = ()) -> dict[str, str]:
    """A distinct identifier (letters, digits, underscores; no digit first) for each name.

    ``Relay.B2_actuating`` becomes ``Relay_B2_actuating``.  Words that are ``reserved``, or were given to a
    name before, get a number at the end.
    """
    return _distinct(((name, _identifier(name)) for name in names), reserved)


def symbols(names: Iterable[str]) -> dict[str, str]:
    """A distinct word without blanks and semicolons for each name."""
    return _distinct(((name, re.sub(r"[\s;]+", "_", name)) for name in names), ())


def one_line(text: str) -> str:
    """A comment or a name that goes on to the end of its line: a blank for whatever lies between words."""
    return " ".join(text.split())


def _identifier(name: str) -> str:
    word = re.sub(r"[^A-Za-z0-9]+", "_", name).strip("_")
    return word if word[:1].isalpha() else f"x_{word}"


def _distinct(pairs: Iterable[tuple[str, str]], reserved: Collection[str]) -> dict[str, str]:
    taken, given = set(reserved), dict[str, str]()
    for name, word in pairs:
        choice, count = word, 1
        while choice in taken:
            count += 1
            choice = f"{word}_{count}"
        taken.add(choice)
        given[name] = choice
    return given
