"""Is a recording a run of the charts?  Its parts are followed; what differs is grouped by cause."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import permutations

from rovercheck.checker.conformance.cones import LogCone, measured
from rovercheck.checker.conformance.deviations import Deviation, DeviationTally, Grouping, WholeEvidence
from rovercheck.checker.conformance.estimator import MOST_REMEMBERED, differs
from rovercheck.checker.conformance.mismatch import LogDifference, LogMismatch
from rovercheck.checker.conformance.program import BeliefOutcome
from rovercheck.checker.conformance.recording import Cells, LogBlock, Raw
from rovercheck.checker.conformance.tracker import TrackedRow, Tracker, UndecidedRow

Column = Sequence[Raw | None]
Watch = Callable[[Tracker, TrackedRow, LogMismatch | None], None]
"""Told of every row of every part, as it is followed."""


Situation = tuple[str, str, tuple[str, ...], Raw | None]
"""A part, an output, what the charts that decide it did, and what they required of it (not of a number)."""


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
    tally: DeviationTally = field(default_factory=DeviationTally)
    """The deviations before anything was concluded from the whole of the recording."""
    situations: frozenset[Situation] = frozenset()
    """What the recording put to the test and was as required, if that was asked for."""


class BoardFollower:
    """Follows all parts of a board through a recording; ``watch`` sees each part's rows.

    ``watched``: whether what is put to the test is told; ``may_freeze``: see ``Grouping``.
    """

    def __init__(
        self,
        parts: Sequence[LogCone],
        tolerance: Mapping[str, float],
        seen: frozenset[str],
        from_power_up: bool,
        watch: Watch | None = None,
        *,
        watched: bool = False,
        may_freeze: bool = True,
    ) -> None:
        self._watch = watch
        self.heard: Callable[[Sequence[LogMismatch]], None] | None = None
        """Is told the mismatches of each row that has some."""
        self._met: dict[int, tuple[Tracker, BeliefOutcome]] | None = {} if watched else None
        self._situations: set[Situation] = set()
        self._trackers = [Tracker(cone, tolerance, from_power_up) for cone in parts]
        self._outputs = {o.var.name: o.name for cone in parts for o in cone.outputs}
        self._known = seen | set(self._outputs)
        self._before: dict[str, tuple[Raw | None, ...]] = {
            o.var.name: (o.var.init if from_power_up else None,) for cone in parts for o in cone.outputs
        }
        self._previous: tuple[Raw | None, ...] = ()
        self.grouping = Grouping(may_freeze)
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
        meaningless = {name: texts[i] for name, texts in block.meaningless.items() if i in texts}
        for tracker, fetch in zip(self._trackers, fetches, strict=True):
            inputs = fetch.inputs(i, self._before, now)
            logged = tuple([c[i] for c in fetch.outputs])
            before = tracker.required
            row = TrackedRow(tick, block.lines[i], missing, inputs, logged)
            mismatch = tracker.step(row)
            if self._watch is not None:
                self._watch(tracker, row, mismatch)
            self._changes.note(tracker, before, mismatch)
            if self._met is not None and tracker.exact is not None:
                self._met[id(tracker.exact)] = tracker, tracker.exact
            if meaningless and (wrong := _meaningless(tracker, meaningless)):
                others = mismatch.differences if mismatch is not None else ()
                inputs_read = tracker.inputs(row)
                mismatch = LogMismatch(
                    tick, block.lines[i], tracker.cone.name, (*wrong, *others), inputs_read
                )
            if mismatch is not None:
                found.append(mismatch)
                now |= {d.output.var.name: _either(d) for d in mismatch.differences}
        if found and self.heard is not None:
            self.heard(found)
        self._swaps.note(self._trackers, fetches, i, bool(found))
        self.grouping.tick(tick, found, outputs != self._previous)
        self._previous = outputs
        if self._met is not None and len(self._met) > MOST_REMEMBERED:
            self._note_met()
        self._before = {name: now.get(name) or (column[i],) for name, column in columns.items()}

    def end(self) -> Behaviour:
        """What was found in all."""
        self._note_met()
        evidence = WholeEvidence(frozenset(self._changes.on_time), *self._swaps.evidence())
        tally = DeviationTally()
        tally.add(self.grouping.end(), evidence)
        undecided = tuple(t.undecided for t in self._trackers if t.undecided is not None)
        read = {v.name for t in self._trackers for v in t.cone.system.inputs}
        return Behaviour(
            tuple(sorted(tally.deviations(), key=lambda d: d.first.tick)),
            tuple(sorted(undecided, key=lambda u: u.tick)),
            tuple(self._outputs.values()),
            tuple(name for t in self._trackers for name in t.cone.left_out),
            tuple(sorted(read - self._known)),
            tally,
            frozenset(self._situations),
        )

    def _note_met(self) -> None:
        """What was put to the test and was as required, in words."""
        for tracker, outcome in (self._met or {}).values():
            for i, output in enumerate(tracker.cone.outputs):
                required = None if measured(output) else outcome.outputs[i]
                moves = tracker.differences.moves(i, [outcome])
                self._situations.add((tracker.cone.name, output.name, moves, required))
        if self._met is not None:
            self._met.clear()


def _meaningless(tracker: Tracker, texts: Mapping[str, str]) -> list[LogDifference]:
    """The outputs of a part, by name, that were given as what is no value."""
    given = [o for o in tracker.cone.outputs if o.name in texts]
    return [tracker.differences.meaningless(o.var.name, texts[o.name], tracker.exact) for o in given]


def _either(difference: LogDifference) -> tuple[Raw | None, ...]:
    """What those that read an output may have read: what it is, or what it must be."""
    if difference.logged is None:
        return difference.expected or (None,)
    return difference.logged, *difference.expected


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

    def evidence(self) -> tuple[frozenset[tuple[str, str]], frozenset[tuple[str, str]]]:
        """Pairs that are swapped, and those that may be."""
        alive = frozenset(self._alive)
        return alive & self._wrong, alive
