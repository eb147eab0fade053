"""One log, checked in both ways: every property as a monitor, and as a run of the charts."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass
from itertools import permutations
from pathlib import Path

from rovercheck.checker.logs.cells import Raw
from rovercheck.checker.logs.cones import LogCone
from rovercheck.checker.logs.decoder import InputDecoder
from rovercheck.checker.logs.deviations import Deviation, Grouping, always_late, swapped
from rovercheck.checker.logs.estimator import differs
from rovercheck.checker.logs.invalid import Invalid
from rovercheck.checker.logs.log import Cells, Log, LogBlock, LogLayout, open_log
from rovercheck.checker.logs.mapping import ColumnMap
from rovercheck.checker.logs.mismatch import LogMismatch
from rovercheck.checker.logs.monitors import LogMonitors, LogVerdict
from rovercheck.checker.logs.reference import LogReference, as_drawn
from rovercheck.checker.logs.selection import PropertySelection
from rovercheck.checker.logs.tracker import TrackedRow, Tracker, UndecidedRow
from rovercheck.properties.forms import Reachable
from rovercheck.spec_model.lang.system import TICK_MS

# --- is a log a run of the charts?  Every part of the board is followed; what differs is grouped by cause

Column = Sequence[Raw | None]


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
    """Follows all parts of a board through a log."""

    def __init__(
        self,
        parts: Sequence[LogCone],
        tolerance: Mapping[str, float],
        seen: frozenset[str],
        from_power_up: bool,
    ) -> None:
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
            mismatch = tracker.step(TrackedRow(tick, block.lines[i], missing, inputs, logged))
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


MOST_GAPS = 5


@dataclass(frozen=True)
class Gap:
    """Steps that are missing in front of a row."""

    line: int
    tick: int
    steps: int


@dataclass(frozen=True)
class LogResult:
    """What was found in one log; ``gaps`` are the first ones, ``missing`` the steps lost in all.

    ``invalid``: cells without meaning; their values are unknown in all the rest.
    """

    name: str
    layout: LogLayout
    rows: int
    ticks: int
    start: str
    missing: int
    gaps: tuple[Gap, ...]
    verdicts: tuple[LogVerdict, ...]
    choice: PropertySelection
    behaviour: Behaviour
    invalid: Invalid

    @property
    def unexpected(self) -> tuple[LogVerdict, ...]:
        """Properties broken though expected to be true, or reached though expected not to be."""
        return tuple(v for v in self.verdicts if v.count and not as_on_record(v))

    @property
    def deviates(self) -> bool:
        return bool(self.behaviour.deviations or self.unexpected)

    @property
    def conforms(self) -> bool:
        """Whether nothing at all is wrong with the log, and all could be decided."""
        return not (self.deviates or self.invalid or self.behaviour.undecided)

    @property
    def seconds(self) -> float:
        """How long the recorded run took."""
        return self.ticks * TICK_MS / 1000


def as_on_record(verdict: LogVerdict) -> bool:
    """Whether what was met in the log is what the baseline leads to expect."""
    violated = verdict.expected == "violated"
    return not violated if isinstance(verdict.prop.form, Reachable) else violated


def examine(path: Path, how: ColumnMap, system: str = "", against: LogReference | None = None) -> LogResult:
    """Check one log, against the charts as specified unless told otherwise.

    Raises ``LogError`` for a file that is no log of the board, or not up to its end.
    """
    log = open_log(path, how, system)
    with closing(log.blocks()) as blocks:
        first = next(blocks)
        run = _Run(log, against or as_drawn())
        run.block(first)
        for block in blocks:
            run.block(block)
    return run.result()


class _Run:
    """A log on its way through both checks."""

    def __init__(self, log: Log, against: LogReference) -> None:
        self._log, self._against = log, against
        layout, from_power_up = log.layout, log.start == "power-up"
        vocabulary = against.vocabulary(layout.board)
        self._decoder = InputDecoder(vocabulary, layout.signals, from_power_up)
        seen, logged = self._decoder.seen, layout.signals - vocabulary.inputs
        known = seen | {o.var.name for o in vocabulary.board.outputs if o.name in logged}
        self._choice = against.choice(layout.board, known)
        self._monitors = LogMonitors(vocabulary, self._choice, known, from_power_up)
        parts = against.cones(layout.board, seen, logged)
        self._follow = BoardFollower(parts, _tolerance(layout), seen, from_power_up)
        self._rows = self._ticks = self._missing = 0
        self._gaps: list[Gap] = []

    def block(self, block: LogBlock) -> None:
        seen = self._decoder.decode(block)
        self._monitors.block(block, self._monitors.columns(block, seen))
        self._follow.block(block, seen)
        self._rows += len(block)
        self._ticks = block.ticks[-1]
        self._missing += sum(block.missing)
        found = (
            Gap(*where) for where in zip(block.lines, block.ticks, block.missing, strict=True) if where[2]
        )
        self._gaps += [gap for gap, _ in zip(found, range(MOST_GAPS - len(self._gaps)), strict=False)]

    def result(self) -> LogResult:
        return LogResult(
            self._log.name,
            self._log.layout,
            self._rows,
            self._ticks,
            self._log.start,
            self._missing,
            tuple(self._gaps),
            tuple(self._on_record(v) for v in self._monitors.verdicts()),
            self._choice,
            self._follow.end(),
            self._log.invalid,
        )

    def _on_record(self, verdict: LogVerdict) -> LogVerdict:
        verdict.expected = self._against.expected(verdict.prop.id)
        return verdict


def _tolerance(layout: LogLayout) -> Mapping[str, float]:
    return {c.signal: c.tolerance for c in layout.stated.values() if c.tolerance is not None}
