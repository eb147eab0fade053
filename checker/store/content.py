"""What a question is made of, as one short key: equal keys stand for questions written alike.

Every kind of value has its own way to be written, and one that has none has no key: nothing is ever kept
under a key that leaves something out.  Texts for readers and places where things are written do not enter,
since no verdict depends on them.
"""

from collections.abc import Mapping
from dataclasses import fields, is_dataclass
from enum import Enum
from fractions import Fraction
from hashlib import blake2b

from rovercheck.properties.forms import Property
from rovercheck.spec_model.lang.chart import Block, Chart, Enabled
from rovercheck.spec_model.lang.expr import Var
from rovercheck.spec_model.lang.programmed import ProgrammedChart
from rovercheck.spec_model.lang.system import Assumption, System

_BYTES = 20
_FOR_READERS: Mapping[type, frozenset[str]] = {
    Assumption: frozenset({"text"}),
    Property: frozenset({"text", "covers", "interpretations", "costly"}),
    System: frozenset({"text", "notes"}),
    Var: frozenset({"doc"}),
}
"""Fields of records that only readers look at."""
_READ: Mapping[type, tuple[str, ...]] = {
    Chart: ("name", "root", "local_to", "label_faults"),
    ProgrammedChart: ("name", "root", "program"),
    Block: ("name", "do", "temporaries"),
    Enabled: ("by", "components", "name"),
}
"""What there is of components that are no records."""
_OURS = (
    "rovercheck.checker.",
    "rovercheck.properties.forms",
    "rovercheck.properties.pasttime",
    "rovercheck.spec_model.lang.",
)
"""The modules of records of which the fields tell all: what these mean is code of ``versions.SOURCES``.

A form of a user's own, with a monitor of its own, means what its code says.
"""


class NoKey(TypeError):
    """A value of a kind that no key can be made of."""


class ContentKeys:
    """Makes keys; what occurs in several places is looked at once.

    >>> keys = ContentKeys()
    >>> keys.key("age", 3) == keys.key("age", 3) != keys.key("age", True)
    True
    """

    def __init__(self) -> None:
        self._known: dict[int, tuple[bytes, object]] = {}

    def key(self, *values: object) -> str:
        """The key of some values, in hexadecimal.  Raises ``NoKey``, ``RecursionError``."""
        return self._digest(values).hex()

    def _digest(self, value: object) -> bytes:
        known = self._known.get(id(value))
        if known is not None:
            return known[0]
        kind = type(value)
        plain = _plain(value)
        if plain is not None:
            return _hashed(kind.__name__.encode(), plain)
        names = _names(kind)
        if names is not None:
            parts = [kind.__qualname__.encode(), *(self._digest(getattr(value, name)) for name in names)]
        else:
            parts = self._others(value)
        found = _hashed(*parts)
        self._known[id(value)] = found, value  # held, so that its id stays its own
        return found

    def _others(self, value: object) -> list[bytes]:
        match value:
            case Enum():
                return [b"enum", type(value).__qualname__.encode(), value.name.encode()]
            case str():  # a note
                return [b"str", _text(value)]
            case tuple() | list():
                return [b"list", *map(self._digest, value)]
            case frozenset() | set():
                return [b"set", *sorted(map(self._digest, value))]
            case Mapping():
                return [b"map", *sorted(_hashed(self._digest(k), self._digest(v)) for k, v in value.items())]
        raise NoKey(f"{type(value).__qualname__} is of no kind that a key can be made of")


def _text(value: str) -> bytes:
    return value.encode("utf-8", "surrogatepass")


_SHOWN = {type(None), bool, float, range, bytes}
"""Kinds of values whose ``repr`` tells all."""


def _plain(value: object) -> bytes | None:
    """A value of a kind of which there are many, and which is soon done; None of any other."""
    kind = type(value)
    if type(value) is str:
        return _text(value)
    if type(value) is int:
        return b"%x" % value  # of any size: decimals have a limit
    if type(value) is Fraction:
        return b"%x/%x" % value.as_integer_ratio()
    return repr(value).encode() if kind in _SHOWN else None


_known_names: dict[type, tuple[str, ...] | None] = dict(_READ)


def _names(kind: type) -> tuple[str, ...] | None:
    """The fields of a record, or of a component, that enter its key; None of anything else."""
    if kind not in _known_names:
        left = _FOR_READERS.get(kind, frozenset())
        is_record = is_dataclass(kind) and not issubclass(kind, Enum) and kind.__module__.startswith(_OURS)
        named = (f.name for f in fields(kind) if f.compare and f.name not in left) if is_record else None
        _known_names[kind] = None if named is None else tuple(named)
    return _known_names[kind]


def _hashed(*parts: bytes) -> bytes:
    """With the length of each part: where one ends is no choice."""
    framed = b"".join(b"%d:%b" % (len(part), part) for part in parts)
    return blake2b(framed, digest_size=_BYTES).digest()
