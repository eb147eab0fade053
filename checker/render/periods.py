"""What a run does again and again, period by period, is told once: which ticks, how often, what goes on.

Ticks repeat those a period before them when the same transitions fire and every value changes as it did then:
states, truth values and enumerations are the same, and numbers differ by the same amount in each tick, so
that one may rise from period to period.
"""

from bisect import bisect_right
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import accumulate, pairwise

from rovercheck.checker.render.durations import duration
from rovercheck.checker.render.repetitions import Repetition, repetitions
from rovercheck.checker.render.story import (
    Row,
    StoryChange,
    StoryEvent,
    counted_on,
    of_model,
    rows,
    values_at,
)
from rovercheck.checker.results.trace import Trace, counted_ticks
from rovercheck.spec_model.lang.domain import Num

TIMES = 2
"""How often a period must be repeated, after the first time, not to be told again."""
LEAST = 2
"""Rows of a story that must be left out for that."""


@dataclass(frozen=True)
class RepeatedTicks:
    """Ticks ``first`` to ``last``, in which the ``period`` ticks before them happen ``times`` more times.

    ``ms`` are the times before the first and at the end of the last.  ``progress`` has what goes on
    meanwhile: numbers that are not, after a period, what they were before it, from before the first to
    after the last of these ticks.
    """

    first: int
    last: int
    period: int
    times: int
    ms: tuple[int, int]
    progress: tuple[StoryChange, ...] = ()

    @property
    def count(self) -> int:
        return self.last - self.first + 1

    @property
    def told(self) -> str:
        """The ticks of the first time, which are shown."""
        begin = self.first - self.period
        return f"ticks {begin}–{self.first - 1}" if self.period > 1 else f"tick {begin}"

    @property
    def what(self) -> str:
        """The repetition in one sentence."""
        start, end = self.ms
        span = f"ticks {self.first}–{self.last}, {start}–{end} ms"
        ticks = f"{counted_ticks(self.count)} = {duration(end - start)}"
        on = f"; {'; '.join(map(str, self.progress))}" if self.progress else ""
        return f"{span}: {self.told} again, {self.times} times; {ticks}{on}"


def folded(trace: Trace) -> Iterator[Row | RepeatedTicks]:
    """The rows of a trace; those of ticks that repeat the ones before them, several times, are one."""
    return (row for row, _ in unfolded(trace))


def unfolded(trace: Trace) -> Iterator[tuple[Row | RepeatedTicks, tuple[Row, ...]]]:
    """The rows of ``folded``, each repetition with the rows that it stands for; other rows with none."""
    repeated = periods(trace)
    ends = {tick for row in repeated for tick in (row.first - row.period - 1, row.first - 1, row.last)}
    left, inside = list(repeated), list[Row]()
    for row in rows(trace, frozenset(ends)):
        first = row.number if isinstance(row, StoryEvent) else row.first
        if left and first > left[0].last:
            yield left.pop(0), tuple(inside)
            inside = []
        if left and first >= left[0].first:
            inside.append(row)
        else:
            yield row, ()


def periods(trace: Trace) -> tuple[RepeatedTicks, ...]:
    """The ticks that need not be told, in order, such that most rows of the story are left out.

    The first tick and the last one are always told, and a loop is no part of what comes before it.
    """
    told = [0] * len(trace)
    for row in rows(trace):
        told[(row.number if isinstance(row, StoryEvent) else row.first) - 1] += 1
    if sum(told) <= 1 + LEAST:
        return ()
    found, at = [], values_at(trace)
    ends = sorted({1, *([trace.loop] if trace.loop else []), len(trace) - 1})
    every = _alike(trace, at)
    for low, high in pairwise(ends):
        search = _Choice(every[low:high], told[low:high])
        found += [(start + low, end + low, period) for start, end, period in search.best(0, high - low)]
    return tuple(sorted((_repeated(trace, at, *one) for one in found), key=lambda row: row.first))


def _repeated(
    trace: Trace, at: Sequence[Mapping[str, int]], start: int, end: int, period: int
) -> RepeatedTicks:
    """What is said of the repetition of the ticks (counted from 0) from ``start`` to ``end``."""
    first = start + period
    before, after = at[first], at[end]
    moved = [n for n, raw in after.items() if of_model(trace, n) and raw != before.get(n, raw)]
    return RepeatedTicks(
        first + 1,
        end,
        period,
        (end - first) // period,
        (trace.ms(first), trace.ms(end)),
        tuple(counted_on(trace, n, before[n], after[n]) for n in moved),
    )


def _alike(trace: Trace, at: Sequence[Mapping[str, int]]) -> list[int]:
    """A number for each tick, the same for ticks in which the same happens."""
    held = dict.fromkeys(n for values in at for n in values)
    known = [n for n in held if of_model(trace, n)]
    numbers = [n for n in known if isinstance(trace.system.variables[n].sort, Num)]
    others = [n for n in known if n not in set(numbers)]
    needed: dict[int, list[str]] = {}
    for one in trace.needed():
        needed.setdefault(one.number, []).append(one.name)
    kinds: dict[object, int] = {}
    found = []
    for tick, (old, new) in zip(trace.ticks, pairwise(at), strict=True):
        marked = [n for n in needed.get(tick.number, ()) if old.get(n) != new.get(n)]
        steps = tuple(new.get(n, 0) - old.get(n, 0) for n in numbers)
        kind = tick.transitions, steps, tuple(map(new.get, others)), tuple(sorted(marked))
        found.append(kinds.setdefault(kind, len(kinds)))
    return found


Interval = tuple[int, int, int]
"""Where a repetition starts and ends, and its period."""


class _Choice:
    """Which repetitions of a sequence of ticks are left out, such that most rows of the story are."""

    def __init__(self, kinds: Sequence[int], told: Sequence[int]) -> None:
        self.told = told
        """How many rows of the story begin at each tick."""
        self.rows = [0, *accumulate(told)]
        self.found = [one for one in repetitions(kinds) if self._whole(one, 0, len(told))]
        self.known: dict[tuple[int, int], tuple[int, list[Interval]]] = {}

    def best(self, low: int, high: int) -> list[Interval]:
        """Repetitions between two ticks.

        They do not overlap, but that one may lie in the first period of another, the one that is told.
        """
        return self._best(low, high)[1]

    def _best(self, low: int, high: int) -> tuple[int, list[Interval]]:
        """How many rows are left out at most, and by which repetitions."""
        if (low, high) not in self.known:
            able = {whole for one in self.found if (whole := self._whole(one, low, high)) is not None}
            inner = {one: self._best(one[0], one[0] + one[2]) for one in able}
            chosen = self._chosen({one: self._left_out(one) - 1 + inner[one][0] for one in able})
            found = [piece for one in chosen for piece in (one, *inner[one][1])]
            gain = sum(self._left_out(one) - 1 for one in found)
            ends = [(low, low, 0), *chosen, (high, high, 0)] if chosen else []
            for (_, left, _), (right, _, _) in pairwise(ends):
                more = self._best(left, right)
                gain, found = gain + more[0], found + more[1]
            self.known[low, high] = gain, found
        return self.known[low, high]

    def _whole(self, one: Repetition, low: int, high: int) -> Interval | None:
        """The whole periods of a repetition between two ticks; None where little would be left out.

        The first one begins where a row of the story does, if any can.
        """
        start, end = max(one.start, low), min(one.end, high)
        times, spare = divmod(end - start, one.period)
        if times <= TIMES:
            return None
        start += next((i for i in range(spare + 1) if self.told[start + i]), 0)
        whole = start, start + times * one.period, one.period
        return whole if self._left_out(whole) >= LEAST else None

    def _left_out(self, whole: Interval) -> int:
        start, end, period = whole
        return self.rows[end] - self.rows[start + period]

    def _chosen(self, able: Mapping[Interval, int]) -> list[Interval]:
        """Weighted interval scheduling: of intervals with gains a set without overlaps that gains most."""
        by_end = sorted(able, key=lambda one: (one[1], one[0], one[2]))
        ends = [end for _, end, _ in by_end]
        best: list[tuple[int, Interval | None, int]] = [(0, None, 0)]
        for number, one in enumerate(by_end):
            before = bisect_right(ends, one[0], hi=number)
            gain = best[before][0] + able[one]
            best.append((gain, one, before) if gain > best[-1][0] else (best[-1][0], None, number))
        chosen: list[Interval] = []
        at = len(by_end)
        while at:
            _, one_of, at = best[at]
            chosen += [one_of] if one_of is not None else []
        return chosen[::-1]
