"""Memory of the search: states in arrival order, their parents, and the table of the known ones.

For each state of one word: 8 bytes of the word, 8 bytes at a load of 0.56 to 0.75 of the table,
and two bits of the parent (four bytes where quiet ticks are skipped).
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rovercheck.checker.encode.native import BATCH, NativeSearch
from rovercheck.checker.engines.explicit.parents import Unary

_LOAD = 0.75
_FULLEST = 0.95
_FIRST = 1 << 16
_LARGE = 1 << 20
"""Entries from which on arrays grow by less than their length."""


@dataclass
class StateStore:
    """Arrays that the native code fills; ``memory`` is the most they may take, in bytes.

    ``most`` states at most: they are numbered by 32 bits.
    """

    native: NativeSearch
    memory: int
    most: int = (1 << 32) - 2

    def __post_init__(self) -> None:
        task = self.native.task
        words = task.layout.words
        self.words: NDArray[np.uint64] = np.zeros((_FIRST, words), dtype=np.uint64)
        self.ordered = not task.shifts
        self.parents: NDArray[Any] = np.zeros(self._parents(_FIRST), np.uint8 if self.ordered else np.uint32)
        self.table: NDArray[np.uint64] = np.zeros(2 * _FIRST, dtype=np.uint64)
        self.buffer: NDArray[np.uint64] = np.zeros((BATCH, words), dtype=np.uint64)
        self.origins: NDArray[np.uint32] = np.zeros(BATCH, dtype=np.uint32)
        self.load = _LOAD

    def _parents(self, length: int) -> int:
        """Entries of ``parents`` for so many states."""
        return length // 4 + 1 if self.ordered else length

    @property
    def bytes(self) -> int:
        """Bytes of the arrays."""
        return int(self.words.nbytes + self.parents.nbytes + self.table.nbytes + self.buffer.nbytes)

    @property
    def room(self) -> int:
        """States that fit before the store must grow."""
        return min(len(self.words), int(len(self.table) * self.load), self.most)

    @property
    def by_number(self) -> "Unary | NDArray[np.uint32]":
        """The parent of each state; of initial ones it says nothing."""
        return Unary(self.parents) if self.ordered else self.parents

    def grow(self, count: int) -> bool:
        """Make room for more than ``count`` states; False when that is not allowed."""
        if count >= self.most:
            return False
        if count >= len(self.words) and not self._lengthen():
            return False
        return count < int(len(self.table) * self.load) or self._widen(count)

    def _lengthen(self) -> bool:
        """Longer arrays, by little: what is not used yet is in memory all the same."""
        length, words = self.words.shape
        extra = length if length < _LARGE else length // 16
        entry = self.words.itemsize * words + (1 if self.ordered else self.parents.itemsize)
        extra = min(extra, (self.memory - self.bytes) // entry)
        if extra <= 0:
            return False
        self.words.resize((length + extra, words), refcheck=False)
        self.parents.resize(self._parents(length + extra), refcheck=False)
        return True

    def _widen(self, count: int) -> bool:
        """A larger table; the old one is given up first, as the states are all in ``words``."""
        size = len(self.table)
        fits = (self.memory - self.bytes + self.table.nbytes) // self.table.itemsize
        larger = min(2 * size if size < _LARGE else size * 4 // 3, fits)
        if larger < size * 9 // 8:
            self.load = _FULLEST
            return count < int(size * self.load)
        self.table = np.zeros(0, dtype=np.uint64)
        self.table = np.zeros(larger, dtype=np.uint64)
        self.native.rehash(self.table, self.words, count)
        return True
