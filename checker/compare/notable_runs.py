"""The runs of a comparison that are kept to be shown: where a deviation is met first, and where longest."""

from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass, field

from rovercheck.checker.compare.run_follower import RecordedRun
from rovercheck.checker.conformance.deviations import Deviation, DeviationScope, whole_of


@dataclass(frozen=True)
class NotableRun:
    """A run to its end, and the deviations met in it, before anything is concluded from all runs.

    ``number``: which of the runs it is, from 1, as several may have one origin.
    """

    number: int
    run: RecordedRun
    groups: tuple[Deviation, ...]

    def first(self, one: Deviation, every: Sequence[Deviation]) -> bool:
        """Whether a deviation of ``every`` is met first here."""
        here = (g for g in self.groups if whole_of(every, g.scope, g.outputs) is one)
        return self.run.origin == one.origin and any(g.first.tick == one.first.tick for g in here)


@dataclass
class NotableRuns:
    """Of each deviation the run in which it is after the fewest steps, and that of its longest stretch."""

    deviating: int = 0
    """How many runs deviate, kept or not."""
    _kept: dict[int, NotableRun] = field(default_factory=dict)
    _first: dict[DeviationScope, tuple[int, str, int]] = field(default_factory=dict)
    _worst: dict[DeviationScope, tuple[int, int, int]] = field(default_factory=dict)

    def add(self, number: int, run: RecordedRun, groups: Collection[Deviation]) -> None:
        """One more run that deviates, in the order of their numbers."""
        self.deviating += 1
        self.more(number, run, groups)

    def more(self, number: int, run: RecordedRun, groups: Collection[Deviation]) -> None:
        """More deviations of a run that deviates."""
        notable = False
        for one in groups:
            first = one.first.tick, run.origin, number
            worst = one.worst.ticks, -one.worst.tick, number
            if one.scope not in self._first or first < self._first[one.scope]:
                self._first[one.scope], notable = first, True
            if one.scope not in self._worst or worst[:2] > self._worst[one.scope][:2]:
                self._worst[one.scope], notable = worst, True
        if notable:
            before = self._kept[number].groups if number in self._kept else ()
            self._kept[number] = NotableRun(number, run, (*before, *groups))
            wanted = {at[-1] for at in (*self._first.values(), *self._worst.values())}
            self._kept = {number: kept for number, kept in self._kept.items() if number in wanted}

    def __iter__(self) -> Iterator[NotableRun]:
        return iter(self._kept.values())

    def __len__(self) -> int:
        return len(self._kept)


__all__ = ["NotableRun", "NotableRuns"]
