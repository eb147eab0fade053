"""Memory of the search: valuations in arrival order, their parents, and the table of the known ones."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from checker.encode.native import BATCH, NativeSearch

_LOAD = 0.75
_FULLEST = 0.9
_FIRST = 1 << 13
_MOST = (1 << 32) - 2


@dataclass
class Store:
    """Arrays that the native code fills; ``memory`` is the most they may take, in bytes."""

    native: NativeSearch
    memory: int

    def __post_init__(self) -> None:
        words = self.native.task.layout.words
        self.words: NDArray[np.uint64] = np.zeros((_FIRST, words), dtype=np.uint64)
        self.parents: NDArray[np.uint32] = np.zeros(_FIRST, dtype=np.uint32)
        self.table: NDArray[np.uint64] = np.zeros(2 * _FIRST, dtype=np.uint64)
        self.buffer: NDArray[np.uint64] = np.zeros((BATCH, words), dtype=np.uint64)
        self.origins: NDArray[np.uint32] = np.zeros(BATCH, dtype=np.uint32)
        self.load = _LOAD

    @property
    def bytes(self) -> int:
        """Bytes of the arrays."""
        return int(self.words.nbytes + self.parents.nbytes + self.table.nbytes + self.buffer.nbytes)

    @property
    def room(self) -> int:
        """Valuations that fit before the store must grow."""
        return min(len(self.words), int(len(self.table) * self.load))

    def grow(self, count: int) -> bool:
        """Make room for more than ``count`` valuations; False when the memory does not allow it."""
        if count >= _MOST:
            return False
        if count >= len(self.words) and not self._lengthen():
            return False
        return count < int(len(self.table) * self.load) or self._double(count)

    def _lengthen(self) -> bool:
        extra = max(len(self.words) // 4, min(len(self.words), 1 << 20))
        entry = self.words.itemsize * self.words.shape[1] + self.parents.itemsize
        extra = min(extra, (self.memory - self.bytes) // entry)
        if extra <= 0:
            return False
        length = len(self.words) + extra
        self.words.resize((length, self.words.shape[1]), refcheck=False)
        self.parents.resize(length, refcheck=False)
        return True

    def _double(self, count: int) -> bool:
        size = len(self.table)
        if self.bytes + self.table.nbytes > self.memory:
            self.load = _FULLEST
            return count < int(size * self.load)
        self.table = np.zeros(0, dtype=np.uint64)  # freed first: the valuations are all in ``words``
        self.table = np.zeros(2 * size, dtype=np.uint64)
        self.native.rehash(self.table, self.words, count)
        return True
