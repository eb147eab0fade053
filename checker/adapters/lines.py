"""What is said to an implementation and what it answers: JSON objects, one a line.

Numbers that JSON does not have are spelled as strings: "NaN", "Infinity" and "-Infinity".
"""

import json
import math
from collections.abc import Mapping
from enum import Enum

from rovercheck.checker.adapters.implementation import Value

NOT_FINITE = {"NaN": math.nan, "Infinity": math.inf, "-Infinity": -math.inf}
PLAIN = frozenset((bool, int, float))
MOST_SHOWN = 80


def encoded(message: Mapping[str, object]) -> bytes:
    """A message as one line."""
    try:
        text = json.dumps(message, allow_nan=False, separators=(",", ":"))
    except ValueError:
        text = json.dumps(_spelled(message), separators=(",", ":"))
    return text.encode() + b"\n"


def decoded(line: bytes) -> dict[str, object]:
    """The object on a line.  Raises ``ValueError`` with what is there instead."""
    try:
        found = json.loads(line)
    except (ValueError, RecursionError):
        raise ValueError(f"{shown(line)}, which is no JSON object") from None
    if not isinstance(found, dict):
        raise ValueError(f"{shown(line)}, which is JSON but no object")
    return found


def values(found: object) -> dict[str, Value]:
    """Values by name.  Raises ``ValueError`` for anything but truth values and numbers by name."""
    if not isinstance(found, dict):
        raise ValueError(f"{shown(found)} where values by name belong")
    for name, value in found.items():
        if type(value) not in PLAIN:
            found[name] = _not_finite(name, value)
    return found


def shown(thing: object) -> str:
    """The beginning of something that was said, in quotes."""
    text = thing.decode(errors="replace").strip() if isinstance(thing, bytes) else str(thing)
    return repr(text) if len(text) <= MOST_SHOWN else f"{text[:MOST_SHOWN]!r}..."


def _not_finite(name: str, value: object) -> float:
    if isinstance(value, str) and value in NOT_FINITE:
        return NOT_FINITE[value]
    raise ValueError(
        f"{name} = {shown(value)}, which is neither true or false nor a number"
        + (' (write NaN as "NaN", infinity as "Infinity")' if isinstance(value, str) else "")
    )


def plain(name: str, value: object) -> Value:
    """A value that code gave, with members of enumerations and NumPy scalars as plain numbers.

    Raises ``ValueError`` for anything else.
    """
    if isinstance(value, Enum):
        value = value.value
    elif type(value) not in PLAIN and hasattr(value, "item"):
        value = value.item()
    if isinstance(value, bool | int | float):
        return value
    raise ValueError(f"{name} = {shown(value)}, which is neither true or false nor a number")


def _spelled(thing: object) -> object:
    """The same with strings in place of numbers that JSON does not have."""
    if isinstance(thing, Mapping):
        return {key: _spelled(value) for key, value in thing.items()}
    if isinstance(thing, float) and not math.isfinite(thing):
        return "NaN" if math.isnan(thing) else "Infinity" if thing > 0 else "-Infinity"
    return thing
