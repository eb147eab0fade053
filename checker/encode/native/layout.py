"""Packing: the valuation of a sliced system in as few 64-bit words as its domains need."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import gcd

from spec_model.lang.expr import Var

WORD_BITS = 63
"""Bits used of a word: the table marks an empty place with a word that no valuation packs to."""


class OutsideDomain(Exception):
    """A tick gives a variable a value outside its domain: the model is broken, nothing is decided."""

    def __init__(self, var: Var, raw: int) -> None:
        super().__init__(f"{var.name} becomes {raw} (raw value), outside {var.domain}.")
        self.var, self.raw = var, raw


@dataclass(frozen=True)
class Field:
    """Where a variable lies: (raw - low) / stride in ``bits`` bits of a word, from ``shift`` up."""

    var: Var
    word: int
    shift: int
    bits: int
    stride: int

    @property
    def low(self) -> int:
        return self.var.domain.low

    @property
    def mask(self) -> int:
        return (1 << self.bits) - 1

    def code(self, raw: int) -> int:
        """The bits for a raw value.  Raises ``OutsideDomain``."""
        if raw not in self.var.domain:
            raise OutsideDomain(self.var, raw)
        return (raw - self.low) // self.stride

    def raw(self, word: int) -> int:
        return (word >> self.shift & self.mask) * self.stride + self.low


@dataclass(frozen=True)
class Layout:
    """The fields of a packed valuation and how many words it has (at least one)."""

    fields: tuple[Field, ...]
    words: int

    @property
    def bits(self) -> int:
        """Bits that the fields occupy."""
        return sum(f.bits for f in self.fields)

    def pack(self, valuation: Mapping[str, int]) -> tuple[int, ...]:
        """The words of a valuation.  Raises ``OutsideDomain``."""
        packed = [0] * self.words
        for f in self.fields:
            packed[f.word] |= f.code(valuation[f.var.name]) << f.shift
        return tuple(packed)

    def unpack(self, words: Sequence[int]) -> dict[str, int]:
        """The raw values in the words, by name."""
        return {f.var.name: f.raw(int(words[f.word])) for f in self.fields}


def layout(variables: Sequence[Var]) -> Layout:
    """Fields for the variables, wide ones first, none across a word boundary."""
    used = [0]
    placed: dict[str, Field] = {}
    for var in sorted(variables, key=lambda v: -_bits(v)):
        bits = _bits(var)
        if bits > WORD_BITS:
            raise ValueError(f"{var.name} needs {bits} bits; at most {WORD_BITS} are supported.")
        word = next((w for w, n in enumerate(used) if n + bits <= WORD_BITS), len(used))
        if word == len(used):
            used.append(0)
        placed[var.name] = Field(var, word, used[word], bits, _stride(var))
        used[word] += bits
    return Layout(tuple(placed[v.name] for v in variables), len(used))


def _stride(var: Var) -> int:
    values = var.domain.values
    if isinstance(values, range):
        return abs(values.step)
    return gcd(*(v - values[0] for v in values)) or 1


def _bits(var: Var) -> int:
    return ((var.domain.high - var.domain.low) // _stride(var)).bit_length()
