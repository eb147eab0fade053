"""Names that Simulink takes, for those of a system."""

import re

RESERVED = frozenset(
    [
        "after",
        "at",
        "before",
        "begin",
        "bind",
        "break",
        "case",
        "catch",
        "change",
        "chooseOne",
        "classdef",
        "continue",
        "count",
        "crossing",
        "duration",
        "during",
        "du",
        "else",
        "elapsed",
        "elseif",
        "end",
        "en",
        "enter",
        "entry",
        "every",
        "ex",
        "exit",
        "falling",
        "false",
        "floor",
        "for",
        "function",
        "global",
        "hasChanged",
        "hasChangedFrom",
        "hasChangedTo",
        "if",
        "in",
        "max",
        "min",
        "mod",
        "msec",
        "on",
        "otherwise",
        "parfor",
        "persistent",
        "return",
        "rising",
        "sec",
        "send",
        "spmd",
        "switch",
        "t",
        "temporalCount",
        "tick",
        "true",
        "try",
        "usec",
        "while",
        "abs",
        "i",
        "j",
        "pi",
        "eps",
        "inf",
        "nan",
    ]
)
"""Words of the action language, and of the functions that are written into charts."""
LONGEST = 63


def identifier(name: str) -> str:
    """The name with an underscore for what no identifier of MATLAB has in it."""
    plain = re.sub(r"[^A-Za-z0-9_]", "_", name)
    if not plain[:1].isalpha():
        plain = f"n_{plain.lstrip('_')}"
    return f"{plain}_" if plain in RESERVED else plain


class SlxNames:
    """Identifiers, each given once: ``a.b`` and ``a_b`` become ``a_b`` and ``a_b_2``."""

    def __init__(self, prefix: str = "") -> None:
        self._prefix = prefix
        self._known: dict[str, str] = {}
        self._taken: set[str] = set()

    def __call__(self, name: str) -> str:
        """The identifier of a name, the same whenever it is asked for."""
        if name not in self._known:
            wanted = identifier(f"{self._prefix}{name}")[: LONGEST - 4]
            found, number = wanted, 1
            while found in self._taken:
                number += 1
                found = f"{wanted}_{number}"
            self._taken.add(found)
            self._known[name] = found
        return self._known[name]

    def free(self, name: str) -> bool:
        """Whether a name has no identifier yet."""
        return name not in self._known


__all__ = ["SlxNames", "identifier"]
