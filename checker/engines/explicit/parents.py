"""The parents of stored states, read from two bits each.

Bit i + parent(i) is set for the i-th state, parents being in ascending order: the parent of the
i-th is the place of the i-th set bit, less i.
"""

from functools import cached_property

import numpy as np
from numpy.typing import NDArray

_BLOCK = 512
"""Bytes between two entries of the directory."""


class Unary:
    """The parents by the number of their child; ``bits`` as the native search has set them."""

    def __init__(self, bits: NDArray[np.uint8]) -> None:
        self.bits = bits

    @cached_property
    def before(self) -> NDArray[np.int64]:
        """The number of set bits before each block."""
        ones = np.unpackbits(np.arange(256, dtype=np.uint8)[:, None], axis=1).sum(axis=1, dtype=np.uint8)
        starts = np.arange(0, len(self.bits), _BLOCK)
        counts = np.add.reduceat(ones[self.bits], starts, dtype=np.int64)
        return np.concatenate([[0], np.cumsum(counts)])

    def __getitem__(self, number: int) -> int:
        """The parent of a state that has one.  Raises ``IndexError`` for one that is not stored."""
        if not 0 <= number < self.before[-1]:
            raise IndexError(f"no state has the number {number}")
        block = int(np.searchsorted(self.before, number, side="right")) - 1
        bytes_ = self.bits[block * _BLOCK : (block + 1) * _BLOCK]
        places = np.flatnonzero(np.unpackbits(bytes_, bitorder="little"))
        return block * _BLOCK * 8 + int(places[number - self.before[block]]) - number
