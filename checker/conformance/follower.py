"""Is a recording a run of the charts?  Its parts are followed; what differs is grouped by cause."""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import permutations

from rovercheck.checker.conformance.cones import LogCone
from rovercheck.checker.conformance.deviations import Deviation, Grouping, always_late, swapped
from rovercheck.checker.conformance.estimator import differs
from rovercheck.checker.conformance.mismatch import LogMismatch
from rovercheck.checker.conformance.recording import Cells, LogBlock, Raw
from rovercheck.checker.conformance.tracker import TrackedRow, Tracker, UndecidedRow

Column = Sequence[Raw | None]
Watch = Callable[[Tracker, TrackedRow, LogMismatch | None], None]
"""Told of every row of every part, as it is followed."""


@dataclass(frozen=True)
class Behaviour:
    """What the log says of the charts.

    ``compared``: outputs that were compared in every tick; ``left_out``: those that are computed from inputs
    that are not logged, so that any value may be right.  ``undecided``: parts that are not decided from some
    tick on; whatever was found is found, but the rest is no pass.
    """

    deviations: tuple[Deviation, ...]
    undecided: tuple[UndecidedRow, ...]
    compared: tuple[str, ...]
    left_out: tuple[str, ...]
    inferred: tuple[str, ...]


class BoardFollower:
    """Follows all parts of a board through a log; ``watch`` sees each part's rows."""

    def __init__(
        self,
        parts: Sequence[LogCone],
        tolerance: Mapping[str, float],
        seen: frozenset[str],
        from_power_up: bool,
        watch: Watch | None = None,
    ) -> None:
        self._watch = watch
        self._trackers = [Tracker(cone, tolerance, from_power_up) for cone in parts]
        self._outputs = {o.var.name: o.name for cone in parts for o in cone.outputs}
        self._known = seen | set(self._outputs)
        self._before: dict[str, tuple[Raw | None, ...]] = {
            o.var.name: (o.var.init if from_power_up else None,) for cone in parts for o in cone.outputs
        }
        self._previous: tuple[Raw | None, ...] = ()
        self._grouping = Grouping()
        self._changes = _OnTime()
        self._swaps = _Swaps(parts)

    def block(self, block: LogBlock, seen: Mapping[str, Cells]) -> None:
        """The rows of a block; ``seen`` are the inputs of the charts."""
        columns = {name: block.values[signal] for name, signal in self._outputs.items()}
        fetches = [self._fetch(t.cone, columns, seen) for t in self._trackers]
        outputs = list(zip(*columns.values(), strict=True)) if columns else [()] * len(block)
        for i in range(len(block)):
            self._row(i, block, fetches, columns, outputs[i])

    def _fetch(self, cone: LogCone, columns: Mapping[str, Column], seen: Mapping[str, Cells]) -> "_Fetch":
        inputs = [
            (v.name, v.name in cone.before, seen.get(v.name) or columns.get(v.name))
            for v in cone.system.inputs
        ]
        return _Fetch(tuple(inputs), tuple(columns[o.var.name] for o in cone.outputs))

    def _row(
        self,
        i: int,
        block: LogBlock,
        fetches: Sequence["_Fetch"],
        columns: Mapping[str, Column],
        outputs: tuple[Raw | None, ...],
    ) -> None:
        tick, missing = block.ticks[i], block.missing[i]
        if missing:
            self._before = dict.fromkeys(self._before, (None,))
        now: dict[str, tuple[Raw | None, ...]] = {}
        found: list[LogMismatch] = []
        for tracker, fetch in zip(self._trackers, fetches, strict=True):
            inputs = fetch.inputs(i, self._before, now)
            logged = tuple([c[i] for c in fetch.outputs])
            before = tracker.required
            row = TrackedRow(tick, block.lines[i], missing, inputs, logged)
            mismatch = tracker.step(row)
            if self._watch is not None:
                self._watch(tracker, row, mismatch)
            self._changes.note(tracker, before, mismatch)
            if mismatch is not None:
                found.append(mismatch)
                now |= {d.output.var.name: (d.logged, *d.expected) for d in mismatch.differences}
        self._swaps.note(self._trackers, fetches, i, bool(found))
        self._grouping.tick(tick, found, outputs != self._previous)
        self._previous = outputs
        self._before = {name: now.get(name) or (column[i],) for name, column in columns.items()}

    def end(self) -> Behaviour:
        """What was found in all."""
        found: Iterable[Deviation] = self._grouping.end()
        found = always_late(tuple(found), self._changes.on_time)
        found = swapped(tuple(found), self._swaps.pairs())
        undecided = tuple(t.undecided for t in self._trackers if t.undecided is not None)
        read = {v.name for t in self._trackers for v in t.cone.system.inputs}
        return Behaviour(
            tuple(sorted(found, key=lambda d: d.first.tick)),
            tuple(sorted(undecided, key=lambda u: u.tick)),
            tuple(self._outputs.values()),
            tuple(name for t in self._trackers for name in t.cone.left_out),
            tuple(sorted(read - self._known)),
        )


@dataclass(frozen=True)
class _Fetch:
    """Where the inputs and outputs of a part are found: its name, whether of the tick before, its column."""

    columns: tuple[tuple[str, bool, Column | None], ...]
    outputs: tuple[Column, ...]

    def inputs(
        self, i: int, before: Mapping[str, tuple[Raw | None, ...]], now: Mapping[str, tuple[Raw | None, ...]]
    ) -> tuple[tuple[Raw | None, ...], ...]:
        """What each input may have been in row ``i``: of an output that deviates, also what it should be."""
        return tuple(
            [
                before[name]
                if earlier
                else now[name]
                if name in now
                else (None if column is None else column[i],)
                for name, earlier, column in self.columns
            ]
        )


class _OnTime:
    """Outputs that changed in the tick in which they had to, at least once."""

    def __init__(self) -> None:
        self.on_time: set[str] = set()

    def note(self, tracker: Tracker, before: Sequence[Raw | None], mismatch: LogMismatch | None) -> None:
        if before == tracker.required or not before or not tracker.required:
            return
        wrong = mismatch.outputs if mismatch is not None else ()
        for output, old, new in zip(tracker.cone.outputs, before, tracker.required, strict=True):
            if old != new and old is not None and new is not None and output.name not in wrong:
                self.on_time.add(output.name)


class _Swaps:
    """Pairs of outputs that in every tick hold what is required of the other one."""

    def __init__(self, parts: Sequence[LogCone]) -> None:
        self._places = {o.name: (p, i) for p, cone in enumerate(parts) for i, o in enumerate(cone.outputs)}
        domains = {o.name: o.var.domain for cone in parts for o in cone.outputs}
        self._alive = {(a, b) for a, b in permutations(domains, 2) if a < b and domains[a] == domains[b]}
        self._wrong: set[tuple[str, str]] = set()
        self._last: dict[tuple[str, str], tuple[Raw | None, ...]] = {}

    def note(self, trackers: Sequence[Tracker], fetches: Sequence[_Fetch], i: int, deviates: bool) -> None:
        """Compare the logged outputs of a row with what is required of others."""
        if not self._alive:
            return
        got = {n: fetches[p].outputs[k][i] for n, (p, k) in self._places.items()}
        due = {n: (trackers[p].required or (None,) * (k + 1))[k] for n, (p, k) in self._places.items()}
        for a, b in tuple(self._alive):
            if differs(due[b], got[a], None) or differs(due[a], got[b], None):
                self._alive.discard((a, b))
            elif deviates and got[a] != due[a] and None not in (got[a], got[b], due[a], due[b]):
                self._wrong.add((a, b))

    def pairs(self) -> Iterator[tuple[str, str]]:
        yield from sorted(self._alive & self._wrong)
