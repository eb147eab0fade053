"""Names of Python for variables, domains and charts, each of one thing."""

import builtins
import keyword
import re
from collections.abc import Collection
from unicodedata import normalize

_HUMP = re.compile(r"(?<=[a-z0-9])(?=[A-Z])")
_TAKEN = {*keyword.kwlist, *keyword.softkwlist, *dir(builtins)}


def plain_word(name: str) -> str:
    """The letters and digits of a name as Python reads them, which takes some signs for others.

    >>> plain_word("probe.level (2)")
    'probe_level_2'
    """
    signs = "".join(one if f"a{one}".isidentifier() else " " for one in normalize("NFKC", name))
    return "_".join(signs.split()).strip("_")


class SourceNames:
    """Names of one module.  ``words`` are those that it imports."""

    def __init__(self, words: Collection[str]) -> None:
        self._taken = {*_TAKEN, *words}

    def variable(self, name: str) -> str:
        """``probe.level`` is ``probe_level``."""
        return self._free(plain_word(name) or "datum")

    def constant(self, name: str) -> str:
        """``LampColour`` is ``LAMP_COLOUR``."""
        return self._free(plain_word(_HUMP.sub("_", name)).upper() or "DOMAIN")

    def thing(self, name: str, kind: str = "chart") -> str:
        """``TopLevel`` is ``top_level``, as charts and systems are named; if that is taken, with its kind."""
        plain = plain_word(_HUMP.sub("_", name)).lower() or kind
        return self._free(plain if plain not in self._taken else f"{plain}_{kind}")

    def _free(self, name: str) -> str:
        name = f"_{name}" if name[0].isdigit() else name
        found, number = name if name not in self._taken else f"{name}_", 2
        while found in self._taken:
            found, number = f"{name}_{number}", number + 1
        self._taken.add(found)
        return found


__all__ = ["SourceNames", "plain_word"]
