"""Names that other languages accept, as close to ours as they can be."""

import re
from collections.abc import Callable, Collection, Iterable


class Identifiers:
    """Distinct words for names, given one after the other.

    Words that are ``reserved``, or were given to a name before, get a number at the end.
    """

    def __init__(self, reserved: Collection[str] = (), word: Callable[[str], str] | None = None) -> None:
        self._taken, self._word = set(reserved), word or _identifier
        self._given: dict[tuple[object, str], str] = {}

    def __call__(self, name: str, of: object = None, instead: str = "") -> str:
        """The word of a name, the same whenever it is asked for.

        Names ``of`` different things are different; ``instead`` is written where the word is taken.
        """
        if (of, name) not in self._given:
            choice = word = self._word(name)
            if instead and word in self._taken:
                choice = word = self._word(instead)
            count = 1
            while choice in self._taken:
                count += 1
                choice = f"{word}_{count}"
            self._taken.add(choice)
            self._given[of, name] = choice
        return self._given[of, name]


def identifiers(names: Iterable[str], reserved: Collection[str] = ()) -> dict[str, str]:
    """A distinct identifier (letters, digits, underscores; no digit first) for each name.

    ``Relay.B2_actuating`` becomes ``Relay_B2_actuating``.
    """
    given = Identifiers(reserved)
    return {name: given(name) for name in names}


def symbols(names: Iterable[str]) -> dict[str, str]:
    """A distinct word without blanks and semicolons for each name."""
    given = Identifiers(word=lambda name: re.sub(r"[\s;]+", "_", name))
    return {name: given(name) for name in names}


def one_line(text: str) -> str:
    """A comment or a name that goes on to the end of its line: a blank for whatever lies between words."""
    return " ".join(text.split())


def _identifier(name: str) -> str:
    word = re.sub(r"[^A-Za-z0-9]+", "_", name).strip("_")
    return word if word[:1].isalpha() else f"x_{word}"
