"""Is a recording a run of the charts?  Its parts are followed; what differs is grouped by cause."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import permutations

from rovercheck.checker.conformance.cones import LogCone, measured
from rovercheck.checker.conformance.deviations import Deviation, DeviationTally, Grouping, WholeEvidence
from rovercheck.checker.conformance.estimator import MOST_REMEMBERED, differs
from rovercheck.checker.conformance.lookahead import LookAhead, plain_outcome
from rovercheck.checker.conformance.mismatch import LogDifference, LogMismatch
from rovercheck.checker.conformance.program import BeliefOutcome, Known, TakenStep
from rovercheck.checker.conformance.recording import Cells, LogBlock, Raw
from rovercheck.checker.conformance.tracker import TrackedRow, Tracker, UndecidedRow

Column = Sequence[Raw | None]
Alternatives = Mapping[str, tuple[Raw | None, ...]]
"""Every value that an output may have had, of those that deviate or are not known."""
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
        self._met: dict[int, tuple[Tracker, BeliefOutcome | TakenStep]] | None = {} if watched else None
        self._situations: set[Situation] = set()
        self._trackers = [Tracker(cone, tolerance, from_power_up) for cone in parts]
        self._outputs = {o.var.name: o.name for cone in parts for o in cone.outputs}
        self._known = seen | set(self._outputs)
        self._ahead = [LookAhead(tracker) for tracker in self._trackers]
        self._last: dict[str, Raw | None] = {
            o.var.name: o.var.init if from_power_up else None for cone in parts for o in cone.outputs
        }
        self._before: Alternatives = {}
        """What outputs may have been in the row before that differ there, or are not known."""
        self._previous: tuple[Raw | None, ...] = ()
        self.grouping = Grouping(may_freeze)
        self._changes = _OnTime()
        self._swaps = _Swaps(parts)

    def block(self, block: LogBlock, seen: Mapping[str, Cells]) -> None:
        """The rows of a block; ``seen`` are the inputs of the charts.

        Rows that every part explains at once are taken together, the others one by one.
        """
        columns = {name: block.values[signal] for name, signal in self._outputs.items()}
        rows = _BlockRows(block, columns, [self._fetch(t.cone, columns, seen) for t in self._trackers])
        for ahead, fetch in zip(self._ahead, rows.fetches, strict=True):
            ahead.begin(fetch.whole, fetch.outputs)
        by_itself = iter([*rows.by_itself(), len(block)])
        end, i = next(by_itself), 0
        while i < len(block):
            while end < i:
                end = next(by_itself)
            together = i if self._watch is not None else self._together(i, end)
            if together > i:
                self._rows(i, together, rows)
            else:
                self._row(i, rows)
            i = max(together, i + 1)
        for ahead in self._ahead:
            ahead.settle(len(block))
        self._last = {name: column[-1] for name, column in columns.items()}

    def _fetch(self, cone: LogCone, columns: Mapping[str, Column], seen: Mapping[str, Cells]) -> "_Fetch":
        inputs = [
            _FetchedInput(v.name, v.name in cone.before, seen.get(v.name) or columns.get(v.name))
            for v in cone.system.inputs
        ]
        return _Fetch(tuple(inputs), tuple(columns[o.var.name] for o in cone.outputs), self._last)

    def _together(self, i: int, end: int) -> int:
        """Up to which row every part explains all, from row ``i`` on."""
        for ahead in self._ahead:
            if end <= i:
                return i
            if not self._before or not ahead.reads(self._before):
                end = min(end, ahead.reach(i, end))
            else:
                return i
        return end

    def _rows(self, start: int, end: int, rows: "_BlockRows") -> None:
        """Rows that are taken ahead and explained by all parts."""
        for ahead in self._ahead:
            self._changes.among(ahead.tracker, ahead.outputs(start, end))
            ahead.required(end - 1)
        if self._met is not None:
            for ahead in self._ahead:
                self._meet(ahead, start, end)
        self._swaps.agree(self._ahead, rows.fetches, start, end)
        for i in range(start, end):
            if not self.grouping.waits:
                break
            before = rows.outputs[i - 1] if i else self._previous
            self.grouping.tick(rows.block.ticks[i], (), rows.outputs[i] != before)
        self._previous, self._before = rows.outputs[end - 1], {}

    def _row(self, i: int, rows: "_BlockRows") -> None:
        block = rows.block
        tick, missing = block.ticks[i], block.missing[i]
        if missing:
            self._before = dict.fromkeys(self._last, (None,))
        now: dict[str, tuple[Raw | None, ...]] = {}
        found: list[LogMismatch] = []
        meaningless = {name: texts[i] for name, texts in block.meaningless.items() if i in texts}
        alone = bool(missing or meaningless) or self._watch is not None
        for ahead, fetch in zip(self._ahead, rows.fetches, strict=True):
            tracker, mismatch = ahead.tracker, None
            before = tracker.required
            if i < ahead.stop and not alone and not ahead.reads(self._before) and not ahead.reads(now):
                ahead.required(i)
                self._changes.note(tracker, before, None)
                if self._met is not None:
                    self._meet(ahead, i, i + 1)
                continue
            ahead.settle(i)
            logged = tuple([c[i] for c in fetch.outputs])
            row = TrackedRow(tick, block.lines[i], missing, fetch.inputs(i, self._before, now), logged)
            mismatch = tracker.step(row)
            ahead.after(i)
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
        self._swaps.note(self._trackers, rows.fetches, i, bool(found))
        self.grouping.tick(tick, found, rows.outputs[i] != self._previous)
        self._previous, self._before = rows.outputs[i], now
        if self._met is not None and len(self._met) > MOST_REMEMBERED:
            self._note_met()

    def _meet(self, ahead: LookAhead, start: int, end: int) -> None:
        """Note what rows that are taken ahead put to the test."""
        assert self._met is not None
        if not ahead.owned:
            return
        for one in ahead.steps(start, end):
            if id(one) not in self._met:
                self._met[id(one)] = ahead.tracker, one
        if len(self._met) > MOST_REMEMBERED:
            self._note_met()

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
        for tracker, met in (self._met or {}).values():
            outcome = met if isinstance(met, BeliefOutcome) else plain_outcome(met)
            for i, output in enumerate(tracker.cone.outputs):
                required = None if measured(output) else outcome.outputs[i]
                moves = tracker.differences.moves(i, [outcome])
                self._situations.add((tracker.cone.name, output.name, moves, required))
        if self._met is not None:
            self._met.clear()


def _meaningless(tracker: Tracker, texts: Mapping[str, str]) -> list[LogDifference]:
    """The outputs of a part, by name, that were given as what is no value, or not where they are required."""
    outputs = tracker.cone.outputs
    required = tracker.required or (None,) * len(outputs)
    given = [
        o
        for o, wanted in zip(outputs, required, strict=True)
        if o.name in texts and (texts[o.name] != MISSING or wanted is not None)
    ]
    return [tracker.differences.meaningless(o.var.name, texts[o.name], tracker.exact) for o in given]


MISSING = "missing"
"""What is said of an output that the implementation gives in other steps."""


def _either(difference: LogDifference) -> tuple[Raw | None, ...]:
    """What those that read an output may have read: what it is, or what it must be."""
    if difference.logged is None:
        return difference.expected or (None,)
    return difference.logged, *difference.expected


@dataclass(frozen=True)
class _FetchedInput:
    """Where an input of a part is found: its name, whether it is of the tick before, its column."""

    name: str
    earlier: bool
    column: Column | None


@dataclass(frozen=True)
class _Fetch:
    """Where the inputs and outputs of a part are found; ``last``: what outputs were before the block."""

    columns: tuple[_FetchedInput, ...]
    outputs: tuple[Column, ...]
    last: Mapping[str, Raw | None]

    def inputs(self, i: int, before: Alternatives, now: Alternatives) -> tuple[tuple[Raw | None, ...], ...]:
        """What each input may have been in row ``i``: of an output that deviates, also what it should be."""
        return tuple([self._input(one, i, before if one.earlier else now) for one in self.columns])

    def _input(self, one: _FetchedInput, i: int, other: Alternatives) -> tuple[Raw | None, ...]:
        if one.name in other:
            return other[one.name]
        if one.earlier and not i:
            return (self.last[one.name],)
        return (None if one.column is None else one.column[i - one.earlier],)

    def whole(self) -> list[Column]:
        """The columns of the inputs where no output deviates."""
        count = len(self.outputs[0])
        nothing: Column = [None] * count
        return [
            [self.last[one.name], *(one.column or nothing)[:-1]] if one.earlier else one.column or nothing
            for one in self.columns
        ]


class _BlockRows:
    """The rows of a block, as the parts need them; ``outputs`` are all that is logged of a row."""

    def __init__(self, block: LogBlock, columns: Mapping[str, Column], fetches: Sequence[_Fetch]) -> None:
        self.block, self.fetches = block, fetches
        self.outputs: list[Known] = (
            list(zip(*columns.values(), strict=True)) if columns else [()] * len(block)
        )

    def by_itself(self) -> list[int]:
        """The rows behind missing steps, and those with an output that is no value."""
        found = {i for i, missing in enumerate(self.block.missing) if missing}
        return sorted(found.union(*self.block.meaningless.values()))


class _OnTime:
    """Outputs that changed in the tick in which they had to, at least once."""

    def __init__(self) -> None:
        self.on_time: set[str] = set()

    def note(self, tracker: Tracker, before: Sequence[Raw | None], mismatch: LogMismatch | None) -> None:
        if before != tracker.required:
            wrong = mismatch.outputs if mismatch is not None else ()
            self._changed(tracker, before, tracker.required, wrong)

    def among(self, tracker: Tracker, required: Sequence[Known]) -> None:
        """The same for successive rows that are explained, with what is required in each."""
        before = tracker.required
        for wanted in required:
            if before is not wanted and before != wanted:
                self._changed(tracker, before, wanted)
            before = wanted

    def _changed(
        self,
        tracker: Tracker,
        before: Sequence[Raw | None],
        required: Sequence[Raw | None],
        wrong: Sequence[str] = (),
    ) -> None:
        if not before or not required:
            return
        for output, old, new in zip(tracker.cone.outputs, before, required, strict=True):
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

    def agree(self, ahead: Sequence[LookAhead], fetches: Sequence[_Fetch], start: int, end: int) -> None:
        """The same for successive rows that are explained."""
        if not self._alive:
            return
        got, due = dict[str, Column](), dict[str, Column]()
        for name in {name for pair in self._alive for name in pair}:
            p, k = self._places[name]
            got[name] = fetches[p].outputs[k][start:end]
            due[name] = [required[k] if required else None for required in ahead[p].outputs(start, end)]
        for a, b in tuple(self._alive):
            if _differ(due[b], got[a]) or _differ(due[a], got[b]):
                self._alive.discard((a, b))

    def evidence(self) -> tuple[frozenset[tuple[str, str]], frozenset[tuple[str, str]]]:
        """Pairs that are swapped, and those that may be."""
        alive = frozenset(self._alive)
        return alive & self._wrong, alive


def _differ(due: Column, got: Column) -> bool:
    """Whether some value that is logged is not the one that is required."""
    return due != got and any(differs(d, g, None) for d, g in zip(due, got, strict=True))
