"""What recordings say of one part of a board: its rows, and the cases in which it deviates."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from rovercheck.checker.conformance.cones import ConeGroup, LogCone, cone_groups
from rovercheck.checker.conformance.decoder import InputDecoder
from rovercheck.checker.conformance.follower import Behaviour, BoardFollower
from rovercheck.checker.conformance.mismatch import LogMismatch
from rovercheck.checker.conformance.program import Known
from rovercheck.checker.conformance.recording import Cells, LogBlock, Raw, Recording
from rovercheck.checker.conformance.signals import Vocabulary
from rovercheck.checker.conformance.tracker import TrackedRow, Tracker
from rovercheck.spec_model.abstraction import Board
from rovercheck.spec_model.abstraction.board import made_of, with_readings
from rovercheck.spec_model.abstraction.readings import StampReading
from rovercheck.spec_model.abstraction.stamps import NOW

NONE: Mapping[str, Cells] = {}

Options = dict[str, dict[int, tuple[Raw | None, ...]]]
"""The values that an input may have had, by its name and the row."""


@dataclass(frozen=True)
class DeviatingCase:
    """Successive rows of a run in which a part deviates: the places of the first and of the last."""

    first: int
    last: int
    mismatch: LogMismatch


@dataclass
class DecodedRun:
    """A run as the charts see it: every known variable row by row.

    ``options``: by the name of a part, what its inputs may have been where they are outputs that deviate.
    ``undecided``: by the name of a part the row from which on it is not decided.
    """

    run: Recording
    columns: dict[str, Cells]
    ticks: list[int]
    lines: list[int]
    missing: list[int]
    options: dict[str, Options] = field(default_factory=dict)
    wrong: dict[str, list[tuple[int, LogMismatch]]] = field(default_factory=dict)
    undecided: dict[str, int] = field(default_factory=dict)

    def __len__(self) -> int:
        return len(self.ticks)

    def take(self, block: LogBlock, seen: Mapping[str, Cells], outputs: Mapping[str, str]) -> None:
        """More rows: what the charts see in them, and the outputs by the names of their variables."""
        for name, cells in seen.items():
            self.columns[name] += cells
        for name, signal in outputs.items():
            self.columns[name] += block.values[signal]
        self.ticks += block.ticks
        self.lines += block.lines
        self.missing += block.missing

    def cases(self, part: str) -> list[DeviatingCase]:
        """The cases of a part."""
        found: list[DeviatingCase] = []
        for row, mismatch in self.wrong.get(part, ()):
            if found and found[-1].last == row - 1:
                found[-1] = DeviatingCase(found[-1].first, row, found[-1].mismatch)
            else:
                found.append(DeviatingCase(row, row, mismatch))
        return found


@dataclass
class PartEvidence:
    """All that the recordings say of one part: ``runs`` conform or deviate, ``group`` is the part."""

    group: ConeGroup
    cone: LogCone
    runs: list[DecodedRun]

    @property
    def name(self) -> str:
        return self.group.name

    @property
    def deviating(self) -> list[DecodedRun]:
        """The runs in which the part deviates."""
        return [run for run in self.runs if run.wrong.get(self.name)]

    @property
    def cases(self) -> int:
        """How often it deviates, in all runs."""
        return sum(len(run.cases(self.name)) for run in self.deviating)


@dataclass(frozen=True)
class Evidence:
    """What the recordings say of a board: the parts that deviate, and how each run behaves."""

    board: Board
    parts: tuple[PartEvidence, ...]
    behaviours: Mapping[str, Behaviour]


Seen = tuple[frozenset[str], frozenset[str]]


class EvidenceCollector:
    """Takes recorded runs one by one."""

    def __init__(self, board: Board) -> None:
        self._board = board
        self._vocabulary = Vocabulary(board)
        self._groups: dict[Seen, tuple[tuple[ConeGroup, LogCone], ...]] = {}
        self._runs: dict[Seen, list[DecodedRun]] = {}
        self._behaviours: dict[str, Behaviour] = {}
        self.runs = 0
        """How many were followed."""

    def add(self, run: Recording) -> None:
        """Follow a run.  Raises what reading its blocks raises."""
        decoder = InputDecoder(self._vocabulary, run.signals, run.from_power_up)
        key = decoder.seen, run.signals - self._vocabulary.inputs
        if key not in self._groups:
            groups = cone_groups(self._board, *key)
            self._groups[key] = tuple((group, group.cone()) for group in groups)
        watch = _Watch()
        cones = [cone for _, cone in self._groups[key]]
        follower = BoardFollower(cones, run.tolerance, decoder.seen, run.from_power_up, watch.row)
        outputs = {o.var.name: o.name for cone in cones for o in cone.outputs}
        decoded = DecodedRun(run, {n: [] for n in (*decoder.seen, *outputs)}, [], [], [])
        for block in run.blocks():
            seen = decoder.decode(block)
            follower.block(block, seen)
            decoded.take(block, seen, outputs)
        watch.tell(decoded)
        self._behaviours[run.name] = follower.end()
        self._runs.setdefault(key, []).append(decoded)
        self.runs += 1

    def evidence(self) -> Evidence:
        """The parts that deviate in some run, in the order of execution.

        Runs with other columns are of one part as long as these are none that it reads or writes.
        """
        found: dict[object, PartEvidence] = {}
        for key, runs in self._runs.items():
            for group, cone in self._groups[key]:
                found.setdefault(_told_of(group, cone), PartEvidence(group, cone, [])).runs.extend(runs)
        parts = tuple(part for part in found.values() if part.deviating)
        return Evidence(self._board, parts, self._behaviours)


def _told_of(group: ConeGroup, cone: LogCone) -> object:
    """What is a part, and what recordings tell of it."""
    own = frozenset[str]().union(*(part.reads | part.writes for part in group.parts))
    return (
        tuple(part.component.name for part in group.parts),
        tuple(o.name for o in group.outputs),
        tuple(o.name for o in cone.outputs),
        tuple(v.name for v in cone.system.inputs),
        cone.before,
        cone.between,
        (group.seen | group.cuts) & own,
    )


class _Watch:
    """Notes what differs, and what others may have seen in its place."""

    def __init__(self) -> None:
        self._row: dict[str, int] = {}
        self._wrong: dict[str, list[tuple[int, LogMismatch]]] = {}
        self._options: dict[str, Options] = {}
        self._undecided: dict[str, int] = {}

    def row(self, tracker: Tracker, row: TrackedRow, mismatch: LogMismatch | None) -> None:
        name = tracker.cone.name
        at = self._row[name] = self._row.get(name, -1) + 1
        if mismatch is not None:
            self._wrong.setdefault(name, []).append((at, mismatch))
        if tracker.undecided is not None:
            self._undecided.setdefault(name, at)
        for var, given in zip(tracker.cone.system.inputs, row.inputs, strict=True):
            if len(given) > 1:
                self._options.setdefault(name, {}).setdefault(var.name, {})[at] = given

    def tell(self, run: DecodedRun) -> None:
        run.wrong, run.options, run.undecided = self._wrong, self._options, self._undecided


def decoded_run(board: Board, run: Recording) -> DecodedRun:
    """A run from power-up that no part is followed in: what its inputs and outputs are."""
    decoder = InputDecoder(Vocabulary(board), run.signals, run.from_power_up)
    outputs = {o.var.name: o.name for o in board.outputs if o.name in run.signals}
    found = DecodedRun(run, {n: [] for n in (*decoder.seen, *outputs)}, [], [], [])
    for block in run.blocks():
        found.take(block, decoder.decode(block), outputs)
    return found


def logged_of(cone: LogCone, run: DecodedRun) -> list[Known]:
    """The outputs of a part, row by row."""
    columns = [run.columns.get(o.var.name) or [None] * len(run) for o in cone.outputs]
    return list(zip(*columns, strict=True)) if columns else [()] * len(run)


def inputs_of(cone: LogCone, run: DecodedRun, otherwise: Mapping[str, Cells] = NONE) -> list[Known]:
    """The inputs of a part, row by row, as they were recorded; ``otherwise``: others in their place."""
    columns: list[Sequence[Raw | None]] = []
    for var in cone.system.inputs:
        cells = otherwise.get(var.name) or run.columns.get(var.name) or [None] * len(run)
        if var.name in cone.before:
            first = var.init if run.run.from_power_up else None
            cells = [first, *cells[:-1]]
        columns.append(cells)
    return list(zip(*columns, strict=True)) if columns else [()] * len(run)


def taken_otherwise(board: Board, run: DecodedRun, readings: Sequence[StampReading]) -> dict[str, Cells]:
    """What the charts would see of the stamps of a run, if an implementation takes them otherwise."""
    found: dict[str, Cells] = {}
    if readings:
        variant = with_readings(board, readings)
        stamps = {NOW, *(name for one in readings for name in (one.stamp, one.other))}
        decoder = InputDecoder(Vocabulary(variant), run.run.signals & stamps, run.run.from_power_up)
        names = {name for one in readings for name in made_of(board, one)}
        for block in run.run.blocks():
            for name, cells in decoder.decode(block).items():
                if name in names:
                    found.setdefault(name, []).extend(cells)
    return found


__all__ = [
    "DecodedRun", "DeviatingCase", "Evidence", "EvidenceCollector", "PartEvidence", "decoded_run",
    "inputs_of", "logged_of", "taken_otherwise",
]  # fmt: skip
