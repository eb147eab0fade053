"""What a run does again and again is shown once: a story in which the same rows follow each other, folded."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from rovercheck.checker.render.durations import duration
from rovercheck.checker.render.story import Quiet, Row, StoryEvent, rows
from rovercheck.checker.results.trace import Trace, counted_ticks

TIMES = 2
"""How often rows must be repeated, after the first time, not to be told again."""
LONGEST = 200
"""Rows that may be repeated at once; where more are, all are told, and a long run is still read at once."""


@dataclass(frozen=True)
class RepeatedTicks:
    """Ticks ``first`` to ``last``, in which the ``period`` ticks before them happen ``times`` more times."""

    first: int
    last: int
    period: int
    times: int
    lasts: int

    @property
    def what(self) -> str:
        """The repetition in one sentence."""
        begin = self.first - self.period
        once = f"ticks {begin}–{self.first - 1}" if self.period > 1 else f"tick {begin}"
        ticks = f"{counted_ticks(self.times * self.period)} = {duration(self.lasts)}"
        return f"ticks {self.first}–{self.last}: {once} again, {self.times} times; {ticks}"


def folded(trace: Trace) -> Iterator[Row | RepeatedTicks]:
    """The rows of a trace; those that repeat the ones before them, as they are, several times in one."""
    told = list(rows(trace))
    numbers: dict[object, int] = {}
    kinds = [numbers.setdefault(_kind(row), len(numbers)) for row in told]
    at = 0
    while at < len(told):
        length, times = _repeated(kinds, at)
        if times < TIMES:
            yield told[at]
            at += 1
            continue
        yield from told[at : at + length]
        first, last = _ticks(told[at + length])[0], _ticks(told[at + length * (times + 1) - 1])[1]
        yield RepeatedTicks(
            first, last, (last - first + 1) // times, times, trace.ms(last) - trace.ms(first - 1)
        )
        at += length * (times + 1)


def _repeated(kinds: Sequence[int], at: int) -> tuple[int, int]:
    """How many rows from here on are repeated at once, and how often: such that most rows are left out."""
    found = (1, 0)
    for length in range(1, min(LONGEST, (len(kinds) - at) // (TIMES + 1)) + 1):
        start, times = at + length, 0
        while kinds[start] == kinds[at] and kinds[start : start + length] == kinds[at : at + length]:
            start, times = start + length, times + 1
            if start + length > len(kinds):
                break
        if times >= TIMES and length * times > found[0] * found[1]:
            found = length, times
    return found


def _kind(row: Row) -> object:
    """What two rows have in common of which one repeats the other; nothing, if no other can."""
    match row:
        case StoryEvent():
            return row.changes, row.transitions
        case Quiet():
            return row.count, row.counters
    return row


def _ticks(row: Row) -> tuple[int, int]:
    """The first and the last tick of a row."""
    if isinstance(row, StoryEvent):
        return row.number, row.number
    return row.first, row.last
