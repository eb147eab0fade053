"""Breadth-first search, level by level: native code expands, Python keeps limits and reports."""

from bisect import bisect_right
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from itertools import product
from threading import Timer
from time import monotonic
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rovercheck.checker.encode.native import CONTEXT, NativeSearch, NativeTask, Status
from rovercheck.checker.engines import Limits, Progress, Timers
from rovercheck.checker.engines.explicit.advice import Advisor, Multiplier
from rovercheck.checker.engines.explicit.parents import Unary
from rovercheck.checker.engines.explicit.store import StateStore
from rovercheck.checker.results.trace import counted_ticks

QUICK_TRANSITIONS = 1 << 22
"""Transitions tried before the code is compiled again to run fast: most searches end before.

They take some 0.1 s, that compiling 0.1 to 0.5 s, and for a whole board seconds."""

_PAUSE = 0.2
_REPORT = 0.7
_MOST_INITIAL = 1 << 22


@dataclass(frozen=True)
class ExplicitFound:
    """What a search found: for each goal the state from which it is first reached (or None),
    and why it stopped early (empty if it did not).

    ``starts`` has the number of the first state of each level, ``levels`` the level from which
    each goal was reached; what lies between a state and its parent's level are quiet ticks.
    """

    hits: tuple[int | None, ...]
    levels: tuple[int, ...]
    starts: tuple[int, ...]
    words: NDArray[np.uint64]
    parents: Unary | NDArray[np.uint32]
    initial: int
    states: int
    transitions: int
    depth: int
    stopped: str
    outside: tuple[int, ...] | None = None

    def level(self, number: int) -> int:
        """The ticks after which a stored state is first reached."""
        return bisect_right(self.starts, number) - 1


@dataclass(frozen=True)
class SearchUsage:
    """What earlier searches under the same limits have used, and bytes that their answers hold."""

    transitions: int = 0
    bytes: int = 0


NOTHING = SearchUsage()


class LevelSearch:
    """Breadth-first search that stores every state it visits.

    ``run`` visits what is reachable until all goals are decided or a limit is met.
    """

    def __init__(
        self,
        native: NativeSearch,
        limits: Limits,
        deadline: float | None,
        progress: Progress,
        spent: SearchUsage = NOTHING,
    ) -> None:
        self.native, self.limits, self.deadline, self.progress = native, limits, deadline, progress
        self.spent = spent
        self.store = StateStore(native, limits.memory - spent.bytes)
        self.advisor = Advisor(native, freed=limits.timers is Timers.FREE)
        self.context: NDArray[np.int64] = np.zeros(len(CONTEXT), dtype=np.int64)
        self.hits: NDArray[np.int64] = np.zeros(max(1, len(native.task.goals)), dtype=np.int64)
        self["pending"] = len(native.task.goals)
        self.budget = 1 << 14
        self.depth = self.frontier = self.initial = 0
        self.started = self.reported = monotonic()
        self.stopped = ""
        self.outside: tuple[int, ...] | None = None
        self.starts: list[int] = [0]
        self.levels: list[int | None] = [None] * len(native.task.goals)

    def __getitem__(self, name: str) -> int:
        return int(self.context[CONTEXT.index(name)])

    def __setitem__(self, name: str, value: int) -> None:
        self.context[CONTEXT.index(name)] = value

    def run(self) -> ExplicitFound:
        with self._watched():
            self._search()
        return self._found()

    @contextmanager
    def _watched(self) -> Iterator[None]:
        """Tell the native code to stop when the time is over, also in the middle of a state."""
        if self.deadline is None:
            yield
            return
        timer = Timer(max(0.0, self.deadline - monotonic()), self.__setitem__, ("stop", 1))
        timer.daemon = True
        timer.start()
        try:
            yield
        finally:
            timer.cancel()

    def _search(self) -> None:
        self._start()
        while not self.stopped and self["pending"] and self.prepare():
            if self.limits.depth is not None and self.depth >= self.limits.depth:
                self.stopped = f"the depth limit of {counted_ticks(self.limits.depth)}"
                break
            self.starts.append(self["count"])
            whole = self._expand()
            self.levels = [
                self.depth if h and n is None else n for h, n in zip(self.hits, self.levels, strict=False)
            ]
            if whole and self.goes_on():
                self.depth += 1

    def prepare(self) -> bool:
        """Say what to expand next; False when there is nothing left."""
        self["next"], self["last"] = self.starts[-1], self["count"]
        self.frontier = self["last"] - self["next"]
        return self.frontier > 0

    def goes_on(self) -> bool:
        """Whether the level that was expanded led to anything new."""
        return self["count"] > self.starts[-1]

    @property
    def arrays(self) -> tuple[NDArray[Any], ...]:
        """What the native code works on."""
        s = self.store
        return self.context, s.words, s.parents, s.table, s.buffer, s.origins, self.hits

    @property
    def expanded(self) -> NDArray[np.uint64]:
        """The states of which ``next`` is one."""
        return self.store.words

    def _start(self) -> None:
        """Store the initial states: one for each choice of the frozen variables."""
        number = 1
        for var in self.native.task.system.frozen:
            number *= len(var.domain)
        if number > _MOST_INITIAL:
            self.stopped = f"{number} choices of the frozen variables"
            return
        layout = self.native.task.layout
        batch = self.store.buffer
        for valuation in initial_valuations(self.native.task):
            if self["filled"] == len(batch) and not (self._call() and self._in_time()):
                return
            batch[self["filled"]] = layout.pack(valuation)
            self["filled"] += 1
        self._call()
        self.initial = self["count"]

    def _expand(self) -> bool:
        """Expand a level; False when it was given up."""
        while self["next"] < self["last"]:
            began = monotonic()
            if not self._call() or not self["pending"]:
                return False
            now = monotonic()
            if self["transitions"] > QUICK_TRANSITIONS:
                self.native.improve()
            if now - began < _PAUSE / 2:
                self.budget = min(2 * self.budget, 1 << 40)
            elif now - began > _PAUSE:
                self.budget = max(self.budget // 2, 1 << 10)
            self._report(now)
            if not self._in_time():
                return False
            most = self.limits.transitions
            if most is not None and self.spent.transitions + self["transitions"] > most:
                return self._gave_up(f"the limit of {most:,} transitions")
        return True

    def _call(self) -> bool:
        """Run native code for a while; False when it cannot go on."""
        store = self.store
        while True:
            self["room"], self["size"], self["budget"] = store.room, len(store.table), self.budget
            match self.native.search(*self.arrays):
                case Status.PAUSED | Status.DECIDED:
                    return True
                case Status.NO_ROOM:
                    if not store.grow(self["count"]):
                        return self._out_of_room()
                case Status.STOPPED:
                    return self._out_of_time()
                case Status.TOO_MANY:
                    self.stopped = "too many inputs in one tick for an explicit search"
                    return False
                case Status.OUTSIDE:
                    self.outside = tuple(self.expanded[self["next"]].tolist())
                    self.stopped = "a value outside its domain"
                    return False

    def _out_of_room(self) -> bool:
        if self["count"] >= self.store.most:
            return self._gave_up(
                f"the most that an explicit search can number, {self.store.most:,},", memory=True
            )
        return self._out_of_memory()

    def _out_of_memory(self) -> bool:
        return self._gave_up(f"the memory limit of {self.limits.memory / 2**20:.0f} MiB", memory=True)

    def _in_time(self) -> bool:
        return self.deadline is None or monotonic() <= self.deadline or self._out_of_time()

    def _out_of_time(self) -> bool:
        return self._gave_up(f"the time limit of {self.limits.seconds:g} s")

    def _report(self, now: float) -> None:
        if now - self.reported < _REPORT:
            return
        self.reported = now
        states = self["count"]
        rate = states / (now - self.started)
        most = self._multiplier()
        self.progress(
            f"explicit: {states:,} states, {rate / 1e6:.2f} M/s, depth {self.depth + 1}, "
            f"frontier {self.frontier:,}, {self.store.bytes / 2**20:.0f} MiB"
            + (f", {self.advisor.sentence(most)}" if most else "")
        )

    def _multiplier(self) -> Multiplier | None:
        """What multiplies the states stored so far."""
        return self.advisor.multiplier(self.store.words, self.store.table, self["count"])

    def _gave_up(self, limit: str, *, memory: bool = False) -> bool:
        """Note the limit that ends the search, how far it came, and what would help; False."""
        most = self._multiplier()
        self.stopped = f"{limit} is reached at {self['count']:,} states"
        if most is not None:
            stored = self.store.words[: self["count"]]
            remedy = self.advisor.remedy(most.field.var.name, stored, memory=memory)
            self.stopped += f": {self.advisor.sentence(most)}" + (f" ({remedy})" if remedy else "")
        return False

    def _found(self) -> ExplicitFound:
        hits = tuple(int(h) - 1 if h else None for h in self.hits[: len(self.native.task.goals)])
        store = self.store
        return ExplicitFound(
            hits,
            tuple(n or 0 for n in self.levels),
            tuple(self.starts),
            store.words[: self["count"]],
            store.by_number,
            self.initial,
            self["count"],
            self["transitions"],
            self.depth,
            self.stopped,
            self.outside,
        )


def initial_valuations(task: NativeTask) -> Iterator[Mapping[str, int]]:
    """The states before the first tick."""
    frozen = task.system.frozen
    for values in product(*(v.domain.values for v in frozen)):
        yield {**task.system.init, **dict(zip((v.name for v in frozen), values, strict=True))}
