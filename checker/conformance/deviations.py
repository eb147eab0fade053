"""Distinct deviations: mismatches grouped by their cause, however often and for however long they occur."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Literal

from rovercheck.checker.conformance.mismatch import LogDifference, LogMismatch

Key = tuple[object, ...]

MOST_KEPT = 5_000
"""Mismatches kept until it is known whether several outputs stay together."""


DeviationKind = Literal["value", "late", "frozen", "swapped"]


@dataclass(frozen=True)
class Deviation:
    """One cause: how it shows, where it was first met, how often.

    ``kind``: ``value``, ``late`` (the value of the tick before), ``frozen`` (several outputs stay while the
    charts go on) or ``swapped`` (two columns for each other).  ``ticks`` are the first and the last tick,
    ``count`` the ticks in between that differ, ``times`` how often it began.
    """

    kind: DeviationKind
    first: LogMismatch
    last: int
    count: int
    times: int
    differences: tuple[LogDifference, ...]

    @property
    def outputs(self) -> tuple[str, ...]:
        return tuple(dict.fromkeys(d.output.name for d in self.differences))


class Grouping:
    """Groups the mismatches of a log as they come, tick by tick."""

    def __init__(self) -> None:
        self._groups: dict[Key, Deviation] = {}
        self._late: dict[str, LogMismatch] = {}
        self._running: dict[str, tuple[int, Key, Key]] = {}
        self._frozen: list[LogMismatch] = []

    def tick(self, tick: int, found: Sequence[LogMismatch], any_output_changed: bool) -> None:
        """The mismatches of a tick; every tick must be given, also those without."""
        if any_output_changed:
            self._thaw()
        by_part = {m.part: m for m in found}
        for part in [p for p in self._late if p not in by_part]:
            waited = self._late.pop(part)
            if any_output_changed:
                self._add(waited, "late")
            else:  # the charts are back at the value that stays
                self._settle(waited)
        for mismatch in found:
            self._one(mismatch)

    def end(self) -> tuple[Deviation, ...]:
        """All deviations, in the order of their first ticks."""
        for mismatch in self._late.values():
            self._settle(mismatch)
        self._late.clear()
        self._thaw()
        return tuple(sorted(self._groups.values(), key=lambda d: (d.first.tick, d.first.part)))

    def _one(self, mismatch: LogMismatch) -> None:
        waiting = self._late.pop(mismatch.part, None)
        if waiting is not None and mismatch.late:
            self._add(waiting, "late")
        elif waiting is not None:
            self._settle(waiting)
        if mismatch.late:
            self._late[mismatch.part] = mismatch
        else:
            self._settle(mismatch)

    def _settle(self, mismatch: LogMismatch) -> None:
        """Not late: either one of several outputs that stay, or a wrong value."""
        if mismatch.stuck:
            self._frozen.append(mismatch)
            if len(self._frozen) > MOST_KEPT:
                self._thaw()
        else:
            self._add(mismatch, "value")

    def _thaw(self) -> None:
        """An output changes again: what stayed until now did so together, or alone."""
        stayed, self._frozen = self._frozen, []
        if len({m.part for m in stayed}) < 2:
            for mismatch in stayed:
                self._add(mismatch, "value")
            return
        stayed.sort(key=lambda m: m.tick)
        every = {d.key: d for m in stayed for d in m.differences}
        ticks = {m.tick for m in stayed}
        key = ("frozen", *sorted({d.output.name for d in every.values()}))
        first = replace(stayed[0], part="")
        self._join(key, Deviation("frozen", first, max(ticks), len(ticks), 1, tuple(every.values())))

    def _add(self, mismatch: LogMismatch, kind: DeviationKind) -> None:
        """A series of one value for another is one deviation, whatever the charts do meanwhile."""
        last, pairs, key = self._running.get(mismatch.part, (0, (), ()))
        goes_on = kind == "value" and last == mismatch.tick - 1 and pairs == mismatch.key
        if not goes_on:
            shape = mismatch.outputs if kind == "late" else mismatch.key
            key = (kind, mismatch.part, shape, mismatch.moves)
        if kind == "value":
            self._running[mismatch.part] = (mismatch.tick, mismatch.key, key)
        times = 0 if goes_on else 1
        self._join(key, Deviation(kind, mismatch, mismatch.tick, 1, times, mismatch.differences))

    def _join(self, key: Key, new: Deviation) -> None:
        old = self._groups.get(key)
        if old is None:
            self._groups[key] = replace(new, times=max(new.times, 1))
            return
        self._groups[key] = replace(
            old, last=max(old.last, new.last), count=old.count + new.count, times=old.times + new.times
        )


# --- what only the whole log shows --------------------------------------------------------------


def always_late(found: Sequence[Deviation], on_time: Iterable[str]) -> Iterator[Deviation]:
    """One deviation in place of many where an output was never on time."""
    punctual = set(on_time)
    late: dict[tuple[str, ...], list[Deviation]] = {}
    for one in found:
        if one.kind == "late" and not punctual & set(one.outputs):
            late.setdefault((one.first.part,), []).append(one)
        else:
            yield one
    for group in late.values():
        yield _merged(group, "late")


def swapped(found: Sequence[Deviation], pairs: Iterable[tuple[str, str]]) -> Iterator[Deviation]:
    """One deviation in place of those of two columns that were swapped."""
    rest = list(found)
    for pair in pairs:
        own = [d for d in rest if set(d.outputs) <= set(pair)]
        if own:
            rest = [d for d in rest if d not in own]
            yield _merged(own, "swapped")
    yield from rest


def _merged(group: Sequence[Deviation], kind: DeviationKind) -> Deviation:
    first = min(group, key=lambda d: d.first.tick)
    every = {d.key: d for one in group for d in one.differences}
    return replace(
        first,
        kind=kind,
        last=max(d.last for d in group),
        count=sum(d.count for d in group),
        times=sum(d.times for d in group),
        differences=tuple(every.values()),
    )
