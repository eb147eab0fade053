"""Packing: the state of a sliced system in as few 64-bit words as its domains need."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from math import gcd

from rovercheck.checker.encode.value_sets import Values, ends, whole
from rovercheck.checker.system.intervals import Interval
from rovercheck.spec_model.lang.expr import Var

NOTHING: Mapping[str, Values] = {}
WORD_BITS = 63
"""Bits used of a word: the table marks an empty place with a word that no state packs to."""


class OutsideDomain(Exception):
    """A tick gives a variable a value outside its domain: the model is broken, nothing is decided."""

    def __init__(self, var: Var, raw: int) -> None:
        super().__init__(f"{var.name} becomes {raw} (raw value), outside {var.domain}.")
        self.var, self.raw = var, raw


@dataclass(frozen=True)
class Field:
    """Where a variable lies: (raw - low) / stride in ``bits`` bits of a word, from ``shift`` up.

    It is never worth more than ``top``, nor less than ``low``; where these are one, no bits are needed.
    """

    var: Var
    word: int
    shift: int
    bits: int
    stride: int
    low: int
    top: int

    @property
    def most(self) -> int:
        """The code of ``top``."""
        return (self.top - self.low) // self.stride

    @property
    def mask(self) -> int:
        return (1 << self.bits) - 1

    def code(self, raw: int) -> int:
        """The bits for a raw value.  Raises ``OutsideDomain``."""
        if raw not in self.var.domain or not self.low <= raw <= self.top:
            raise OutsideDomain(self.var, raw)
        return (raw - self.low) // self.stride

    def raw(self, word: int) -> int:
        return (word >> self.shift & self.mask) * self.stride + self.low


@dataclass(frozen=True)
class Layout:
    """The fields of a packed state and how many words it has (at least one)."""

    fields: tuple[Field, ...]
    words: int

    @property
    def bits(self) -> int:
        """Bits that the fields occupy."""
        return sum(f.bits for f in self.fields)

    def pack(self, valuation: Mapping[str, int]) -> tuple[int, ...]:
        """The words of a state.  Raises ``OutsideDomain``."""
        packed = [0] * self.words
        for f in self.fields:
            packed[f.word] |= f.code(valuation[f.var.name]) << f.shift
        return tuple(packed)

    def unpack(self, words: Sequence[int]) -> dict[str, int]:
        """The raw values in the words, by name."""
        return {f.var.name: f.raw(int(words[f.word])) for f in self.fields}


def layout(variables: Sequence[Var], known: Mapping[str, Values] = NOTHING) -> Layout:
    """Fields for the variables, wide ones first, none across a word boundary.

    ``known`` has the values that some of them can take, where these are fewer than the domain has.
    """
    used = [0]
    placed: dict[str, Field] = {}
    free = [_field(var, known.get(var.name, whole(var.domain))) for var in variables]
    for field in sorted(free, key=lambda f: -f.bits):
        var, bits = field.var, field.bits
        if bits > WORD_BITS:
            raise ValueError(f"{var.name} needs {bits} bits; at most {WORD_BITS} are supported.")
        word = next((w for w, n in enumerate(used) if n + bits <= WORD_BITS), len(used))
        if word == len(used):
            used.append(0)
        placed[var.name] = replace(field, word=word, shift=used[word])
        used[word] += bits
    return Layout(tuple(placed[v.name] for v in variables), len(used))


def _field(var: Var, values: Values) -> Field:
    """Without its place in a word."""
    low, top = ends(values)
    if var.domain.dense and isinstance(values, Interval):
        stride = 1
    else:
        within = [v for v in var.domain.values if low <= v <= top and (v in values)]
        low, top = min(within), max(within)
        stride = gcd(*(v - low for v in within)) or 1
    return Field(var, 0, 0, ((top - low) // stride).bit_length(), stride, low, top)
