"""Distinct deviations: mismatches grouped by what differs and where, in many recordings."""

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from functools import reduce
from hashlib import sha256
from typing import Literal

from rovercheck.checker.conformance.mismatch import LogDifference, LogMismatch

MOST_KEPT = 5_000
"""Mismatches kept until it is known whether several outputs stay together."""


DeviationKind = Literal["value", "late", "frozen", "swapped"]

ScopedOutput = tuple[str, str, str]
"""An output, what it must be and what it is, in words; both empty where any other value is the same."""


@dataclass(frozen=True, order=True)
class DeviationScope:
    """What makes a deviation another one than the next, in words that a file can hold.

    ``kind`` is ``late`` where the outputs are never on time; what is late now and then is a ``value``.
    ``charts``: the transition that the charts took, or the states in which they stayed.  ``on_top``: it is
    one from the charts with the changes that explain what is known of the part.
    """

    kind: DeviationKind
    part: str
    differences: tuple[ScopedOutput, ...]
    charts: tuple[str, ...] = ()
    on_top: bool = False

    @property
    def outputs(self) -> tuple[str, ...]:
        return tuple(dict.fromkeys(name for name, _, _ in self.differences))

    def id(self, board: str) -> str:
        """A short name that is the same wherever and whenever the deviation is met."""
        text = repr((board, self.kind, self.part, self.differences, self.charts, *[True] * self.on_top))
        return f"{board}-{self.outputs[0]}-{sha256(text.encode()).hexdigest()[:6]}"


def scope_of(mismatch: LogMismatch) -> DeviationScope:
    """That of one piece of a mismatch: numbers that follow from a discrete output are no part of it."""
    leading = [d for d in mismatch.differences if not d.is_number or d.text] or list(mismatch.differences)
    return DeviationScope(
        "value", mismatch.part, tuple(dict.fromkeys(d.key for d in leading)), mismatch.moves
    )


@dataclass(frozen=True, order=True)
class DeviationSpan:
    """An uninterrupted stretch of ticks of the recording ``origin`` that differ, and where it begins."""

    ticks: int
    tick: int
    line: int
    origin: str = ""


@dataclass(frozen=True)
class Deviation:
    """One difference: how it shows, where it was first met, how often.

    ``kind``: ``value``, ``late`` (the value of the tick before), ``frozen`` (several outputs stay while the
    charts go on) or ``swapped`` (two columns for each other).  ``first`` is its first mismatch and ``last``
    the last tick, of the recording ``origin``; ``count`` the ticks that differ, ``times`` how often it began
    and ``runs`` in how many recordings.  ``worst`` is the longest uninterrupted stretch.
    """

    kind: DeviationKind
    first: LogMismatch
    last: int
    count: int
    times: int
    differences: tuple[LogDifference, ...]
    scope: DeviationScope
    runs: int = 1
    origin: str = ""
    worst: DeviationSpan = DeviationSpan(0, 0, 0)

    @property
    def outputs(self) -> tuple[str, ...]:
        return tuple(dict.fromkeys(d.output.name for d in self.differences))

    def joined(self, other: "Deviation") -> "Deviation":
        """The same one in two recordings, told where its run is the shortest."""
        known = {d.key: d for d in (*self.differences, *other.differences)}
        better = min(self, other, key=lambda d: (d.first.tick, d.origin))
        return replace(
            better,
            kind=_kind(self, other),
            count=self.count + other.count,
            times=self.times + other.times,
            runs=self.runs + other.runs,
            differences=tuple(known.values()),
            worst=_longer(self.worst, other.worst),
        )


def _longer(one: DeviationSpan, other: DeviationSpan) -> DeviationSpan:
    """The longer of two stretches, the earlier of two that are as long."""
    return other if (other.ticks, -other.tick) > (one.ticks, -one.tick) else one


def _kind(one: Deviation, other: Deviation) -> DeviationKind:
    """Late is what is late every time."""
    return one.kind if one.kind == other.kind else "value"


class Grouping:
    """Groups the mismatches of a recording as they come, tick by tick.

    ``may_freeze``: whether several outputs that stay at the same time are one deviation, as in a log that is
    not written on.
    """

    def __init__(self, may_freeze: bool = True) -> None:
        self._may_freeze = may_freeze
        self._groups: dict[DeviationScope, Deviation] = {}
        self._late: dict[tuple[str, ...], LogMismatch] = {}
        self._running: dict[tuple[str, ...], tuple[int, object, DeviationScope]] = {}
        self._frozen: list[LogMismatch] = []
        self._since: dict[tuple[str, ...], DeviationSpan] = {}
        """The stretch in which the outputs of a piece are now."""
        self.told: Callable[[LogMismatch, DeviationScope], None] | None = None
        """Is told each piece of a mismatch with the scope of its group, once that is known."""

    @property
    def waits(self) -> bool:
        """Whether some mismatch is not settled yet; if not, ticks without one change nothing."""
        return bool(self._late or self._frozen)

    def tick(self, tick: int, found: Sequence[LogMismatch], any_output_changed: bool) -> None:
        """The mismatches of a tick; every tick must be given, also those without."""
        if not found and not self._late and not self._frozen:
            return
        if any_output_changed:
            self._thaw()
        pieces = {(m.part, *map(str, _names(m))): m for one in found for m in one.pieces()}
        for part in [p for p in self._late if p not in pieces]:
            waited = self._late.pop(part)
            if any_output_changed:
                self._add(part, waited, "late")
            else:  # the charts are back at the value that stays
                self._settle(part, waited)
        for part, piece in pieces.items():
            self._one(part, piece)

    def end(self) -> tuple[Deviation, ...]:
        """All deviations, in the order of their first ticks."""
        for part, mismatch in self._late.items():
            self._settle(part, mismatch)
        self._late.clear()
        self._thaw()
        return tuple(sorted(self._groups.values(), key=lambda d: (d.first.tick, d.first.part)))

    def _one(self, part: tuple[str, ...], mismatch: LogMismatch) -> None:
        waiting = self._late.pop(part, None)
        if waiting is not None and mismatch.late:
            self._add(part, waiting, "late")
        elif waiting is not None:
            self._settle(part, waiting)
        if mismatch.late:
            self._late[part] = mismatch
        else:
            self._settle(part, mismatch)

    def _settle(self, part: tuple[str, ...], mismatch: LogMismatch) -> None:
        """Not late: either one of several outputs that stay, or a wrong value."""
        if mismatch.stuck and self._may_freeze:
            self._frozen.append(mismatch)
            if len(self._frozen) > MOST_KEPT:
                self._thaw()
        else:
            self._add(part, mismatch, "value")

    def _thaw(self) -> None:
        """An output changes again: what stayed until now did so together, or alone."""
        every, self._frozen = sorted(self._frozen, key=lambda m: m.tick), []
        right = _right_until_then(every)
        together = len({m.part for m in every if right.issuperset(m.outputs)}) > 1
        stayed = [m for m in every if together and right.issuperset(m.outputs)]
        for mismatch in every:
            if not (together and right.issuperset(mismatch.outputs)):
                self._add((mismatch.part, *_names(mismatch)), mismatch, "value")
        if stayed:
            self._add_frozen(stayed)

    def _add_frozen(self, stayed: Sequence[LogMismatch]) -> None:
        every = {d.key: d for m in stayed for d in m.differences}
        ticks = {m.tick for m in stayed}
        outputs = sorted({d.output.name for d in every.values()})
        scope = DeviationScope("frozen", "", tuple((name, "", "") for name in outputs))
        if self.told is not None:
            for mismatch in stayed:
                self.told(mismatch, scope)
        first = replace(stayed[0], part="")
        span = DeviationSpan(len(ticks), first.tick, first.line)
        whole = Deviation(
            "frozen", first, max(ticks), len(ticks), 1, tuple(every.values()), scope, worst=span
        )
        self._join(whole)

    def _add(self, part: tuple[str, ...], mismatch: LogMismatch, kind: DeviationKind) -> None:
        """A series of one value for another is one deviation, whatever the charts do meanwhile."""
        last, pairs, scope = self._running.get(part, (0, (), None))
        goes_on = kind == "value" and last == mismatch.tick - 1 and pairs == mismatch.key
        if scope is None or not goes_on:
            scope = scope_of(mismatch)
        if self.told is not None:
            self.told(mismatch, scope)
        if kind == "value":
            self._running[part] = (mismatch.tick, mismatch.key, scope)
        times = 0 if goes_on else 1
        before = self._since[part].ticks if goes_on else 0
        start = self._since[part] if goes_on else DeviationSpan(0, mismatch.tick, mismatch.line)
        span = self._since[part] = replace(start, ticks=before + 1)
        found = Deviation(kind, mismatch, mismatch.tick, 1, times, mismatch.differences, scope, worst=span)
        self._join(found)

    def _join(self, new: Deviation) -> None:
        old = self._groups.get(new.scope)
        if old is None:
            self._groups[new.scope] = replace(new, times=max(new.times, 1))
            return
        first = new.first if new.first.tick < old.first.tick else old.first
        self._groups[new.scope] = replace(
            old,
            kind=_kind(old, new),
            first=first,
            last=max(old.last, new.last),
            count=old.count + new.count,
            times=old.times + new.times,
            worst=_longer(old.worst, new.worst),
        )


def _right_until_then(stayed: Iterable[LogMismatch]) -> frozenset[str]:
    """Outputs that stay at what was required of them, and not at something wrong to which they changed."""
    first: dict[str, bool] = {}
    for mismatch in stayed:
        for one in mismatch.differences:
            first.setdefault(one.output.name, one.late)
    return frozenset(name for name, late in first.items() if late)


def _names(mismatch: LogMismatch) -> list[str]:
    """The outputs of a piece, with the bit of a mask."""
    return [f"{d.output.name} {d.bit or ''}" for d in mismatch.differences if not d.is_number] or list(
        mismatch.outputs
    )


# --- what only the whole of a recording, or of many, shows -----------------------------------------


@dataclass(frozen=True)
class WholeEvidence:
    """What is known of outputs over whole recordings.

    ``on_time``: those that changed when they had to, at least once.  ``swapped``: pairs that always hold
    what is required of the other one, and not always their own; ``alike``: pairs of
    which nothing says that they are not.
    """

    on_time: frozenset[str] = frozenset()
    swapped: frozenset[tuple[str, str]] = frozenset()
    alike: frozenset[tuple[str, str]] = frozenset()

    def joined(self, other: "WholeEvidence") -> "WholeEvidence":
        """That of both."""
        alike = self.alike & other.alike
        return WholeEvidence(self.on_time | other.on_time, (self.swapped | other.swapped) & alike, alike)


@dataclass
class DeviationTally:
    """The deviations of one recording, or of many of one implementation, each once.

    Recordings of other boards, or of other parts of it, go into a tally of their own.
    """

    evidence: WholeEvidence | None = None
    groups: dict[DeviationScope, Deviation] = field(default_factory=dict)

    def add(self, found: Iterable[Deviation], evidence: WholeEvidence, origin: str = "") -> None:
        """Those of one more recording, before anything is concluded from the whole of it."""
        self.evidence = evidence if self.evidence is None else self.evidence.joined(evidence)
        for one in found:
            worst = replace(one.worst, origin=one.worst.origin or origin)
            named = replace(one, origin=one.origin or origin, worst=worst)
            old = self.groups.get(one.scope)
            self.groups[one.scope] = named if old is None else old.joined(named)

    def deviations(self) -> tuple[Deviation, ...]:
        """All of them, what explains most first: in most recordings, then in most ticks."""
        evidence = self.evidence or WholeEvidence()
        plain = tuple(without_ambiguous(tuple(self.groups.values())))
        found = tuple(swapped(tuple(always_late(plain, evidence.on_time)), evidence.swapped))
        return tuple(sorted(found, key=lambda d: (-d.runs, -d.count, d.first.tick, d.scope)))


def without_ambiguous(found: Sequence[Deviation]) -> Iterator[Deviation]:
    """What may be after several moves of the charts joins the same difference after one of them, if any."""
    groups = {one.scope: one for one in found if not _ambiguous(one)}
    for one in filter(_ambiguous, found):
        same = [
            d for s, d in groups.items() if (s.part, s.differences) == (one.scope.part, one.scope.differences)
        ]
        nearest = max(same, key=lambda d: (d.runs, d.count, d.scope), default=one)
        if nearest is one:
            groups[one.scope] = one
        else:
            worst = _longer(nearest.worst, one.worst)
            count, times = nearest.count + one.count, nearest.times + one.times
            joined = replace(nearest, count=count, times=times, worst=worst)
            groups[nearest.scope] = joined
    yield from groups.values()


def _ambiguous(one: Deviation) -> bool:
    return any(d.ambiguous for d in one.first.differences)


def always_late(found: Iterable[Deviation], on_time: Iterable[str]) -> Iterator[Deviation]:
    """One deviation in place of many where an output was never on time."""
    punctual = set(on_time)
    late: dict[tuple[str, ...], list[Deviation]] = {}
    for one in found:
        if one.kind == "late" and not punctual & set(one.outputs):
            late.setdefault((one.first.part, *one.scope.outputs), []).append(one)
        else:
            yield one
    for (part, *outputs), group in late.items():
        yield _merged(group, DeviationScope("late", part, tuple((name, "", "") for name in outputs)))


def swapped(found: Sequence[Deviation], pairs: Iterable[tuple[str, str]]) -> Iterator[Deviation]:
    """One deviation in place of those of two columns that were swapped."""
    rest = list(found)
    for pair in sorted(pairs):
        own = [d for d in rest if set(d.outputs) <= set(pair)]
        if own:
            rest = [d for d in rest if d not in own]
            yield _merged(own, DeviationScope("swapped", "", tuple((name, "", "") for name in sorted(pair))))
    yield from rest


def _merged(group: Sequence[Deviation], scope: DeviationScope) -> Deviation:
    first = min(group, key=lambda d: (d.first.tick, d.origin))
    every = {d.key: d for one in group for d in one.differences}
    return replace(
        first,
        kind=scope.kind,
        last=max(d.last for d in group),
        count=sum(d.count for d in group),
        times=sum(d.times for d in group),
        runs=max(d.runs for d in group),
        differences=tuple(every.values()),
        scope=scope,
        worst=reduce(_longer, [d.worst for d in group]),
    )


def joins(whole: Deviation, scope: DeviationScope, outputs: Iterable[str]) -> bool:
    """Whether a conclusion from whole recordings stands for a group of one, of that scope and outputs."""
    inside = whole.scope.kind != "value" and set(outputs) <= set(whole.outputs)
    return inside and whole.scope.part in ("", scope.part)


def whole_of(every: Sequence[Deviation], scope: DeviationScope, outputs: Iterable[str]) -> Deviation | None:
    """The deviation over all recordings that stands for a group of one: itself, or what joined it."""
    named = set(outputs)
    same = [d for d in every if d.scope == scope] or [d for d in every if joins(d, scope, named)]
    alike = (d for d in every if (d.scope.part, d.scope.differences) == (scope.part, scope.differences))
    return next(iter(same), None) or next(alike, None)


__all__ = [
    "Deviation",
    "DeviationKind",
    "DeviationScope",
    "DeviationSpan",
    "DeviationTally",
    "Grouping",
    "WholeEvidence",
    "joins",
    "scope_of",
    "whole_of",
]
