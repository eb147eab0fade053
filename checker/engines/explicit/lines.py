"""Breadth-first search that skips quiet ticks: states in which only counters moved on are not stored.

A stored state is the anchor of a line: what quiet ticks lead to from it, one state in each
level.  The frontier of a level holds its new anchors and the next state of every line that goes
on; a line ends where no tick is quiet or where it meets another anchor, which goes on for it.  Every
state is still expanded in the level in which it is first reached, so runs stay shortest.
"""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from rovercheck.checker.encode.native import NativeSearch
from rovercheck.checker.engines import Limits, Progress
from rovercheck.checker.engines.explicit.levels import NOTHING, LevelSearch, SearchUsage


class LineSearch(LevelSearch):
    """Stores anchors; for a task with shifts."""

    def __init__(
        self,
        native: NativeSearch,
        limits: Limits,
        deadline: float | None,
        progress: Progress,
        spent: SearchUsage = NOTHING,
    ) -> None:
        super().__init__(native, limits, deadline, progress, spent)
        self.current, self.anchors = self._room(0)
        self.onward, self.carried = self._room(0)

    def _room(self, length: int) -> tuple[NDArray[np.uint64], NDArray[np.uint32]]:
        """States and the numbers of their anchors."""
        words = self.native.task.layout.words
        return np.zeros((length, words), dtype=np.uint64), np.zeros(length, dtype=np.uint32)

    def prepare(self) -> bool:
        """The frontier: the new anchors, and the lines that have not met one."""
        first, last = self.starts[-1], self["count"]
        moved, carried = self.onward[: self["lines"]], self.carried[: self["lines"]]
        on = ~self.native.known(self.store.table, self.store.words, moved)
        self.current = np.concatenate([self.store.words[first:last], moved[on]])
        self.anchors = np.concatenate([np.arange(first, last, dtype=np.uint32), carried[on]])
        self.onward, self.carried = self._room(len(self.current))
        self["next"], self["last"], self["lines"] = 0, len(self.current), 0
        self.frontier = len(self.current)
        used = self.store.bytes + 2 * (self.current.nbytes + self.anchors.nbytes)
        if used > self.store.memory:
            self._out_of_memory()
        return self.frontier > 0 and not self.stopped

    def goes_on(self) -> bool:
        """Whether there are new anchors or lines that go on."""
        return self["lines"] > 0 or super().goes_on()

    @property
    def arrays(self) -> tuple[NDArray[Any], ...]:
        """The frontier and where its lines go on, besides what is stored."""
        return *super().arrays, self.current, self.anchors, self.onward, self.carried

    @property
    def expanded(self) -> NDArray[np.uint64]:
        """The frontier."""
        return self.current
