"""An implementation's run beside the charts part by part, each fed with its own upstream outputs."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from math import isfinite

from rovercheck.checker.adapters.implementation import Value, Values
from rovercheck.checker.compare.beside import ComparedStep, differences, rerun
from rovercheck.checker.conformance.cones import LogCone, cones
from rovercheck.checker.conformance.decoder import InputDecoder
from rovercheck.checker.conformance.deviations import Deviation, DeviationScope, Grouping, scope_of
from rovercheck.checker.conformance.follower import MISSING, Behaviour, BoardFollower
from rovercheck.checker.conformance.mismatch import LogDifference, LogMismatch
from rovercheck.checker.conformance.recording import Cells, LogBlock, Raw, Recording
from rovercheck.checker.conformance.signals import Vocabulary
from rovercheck.spec_model.abstraction import Board, BoardSignal
from rovercheck.spec_model.abstraction.signals import units
from rovercheck.spec_model.lang.domain import Bool, Enum, exact


@dataclass(frozen=True)
class RecordedRun:
    """A run of an implementation from power-up: what it was given, what the charts do, what it answered."""

    board: Board
    origin: str
    steps: tuple[ComparedStep, ...]
    outputs: tuple[Values, ...]

    @cached_property
    def block(self) -> LogBlock:
        """The run as rows of a recording, for whatever follows recordings; the line of a row is its step."""
        return recorded_block(self.board, [step.inputs for step in self.steps], self.outputs)

    @property
    def recording(self) -> Recording:
        """The run for whatever diagnoses recordings."""
        block = self.block  # and not the run, of which much more is known
        return Recording(self.origin, frozenset(block.values), True, lambda: [block])

    def up_to(self, tick: int) -> "RecordedRun":
        """Its first steps."""
        return RecordedRun(self.board, self.origin, self.steps[:tick], self.outputs[:tick])


class RunFollower:
    """Follows runs of one implementation through the charts of a board; what it learns it keeps for the next.

    ``watched``: whether the behaviours say what was put to the test.  ``only``: the one part that is
    followed, with those that it reads.
    """

    def __init__(self, board: Board, watched: bool = False, only: str = "") -> None:
        self.board = board
        self._only = only
        self._watched = watched
        self._vocabulary = Vocabulary(board)
        self._cones: dict[frozenset[str], tuple[LogCone, ...]] = {}

    def behaviour(self, run: RecordedRun) -> Behaviour:
        """What the run says of the charts; what differs from them as a whole is a deviation in any case."""
        found = self.followed(run.block)
        if not found.deviations and not found.undecided and (plain := self._plain(run)) is not None:
            found.tally.groups[plain.scope] = plain
        return found

    def followed(self, block: LogBlock) -> Behaviour:
        """What a run from power-up, as a block of rows, says of the parts of the charts."""
        return self._followed(block, self._parts(block), self._watched)

    def first(
        self, inputs: Sequence[Values], outputs: Sequence[Values], wanted: DeviationScope
    ) -> LogMismatch | None:
        """The first mismatch in a run that is as one in another run.  Raises ``ModelError``."""
        block = recorded_block(self.board, inputs, outputs)
        parts = _upstream(self._parts(block), wanted.part)
        if not parts:
            return None
        follower = self._follower(parts, block)
        found: list[LogMismatch] = []
        follower.heard = lambda mismatches: found.extend(
            piece for one in mismatches for piece in one.pieces() if scope_of(piece) == wanted
        )
        for tick in range(0, len(block), SOME_ROWS):
            some = rows_of(block, tick, tick + SOME_ROWS)
            follower.block(some, self._decoded.decode(some))
            if found:
                return found[0]
        return None

    def _parts(self, block: LogBlock) -> tuple[LogCone, ...]:
        given = frozenset(o.name for o in self.board.outputs if o.name in block.values)
        if given not in self._cones:
            every = cones(self.board, frozenset(self._vocabulary.sights), given)
            self._cones[given] = tuple(_upstream(every, self._only)) if self._only else every
        return self._cones[given]

    def _follower(self, parts: Sequence[LogCone], block: LogBlock, watched: bool = False) -> BoardFollower:
        self._decoded = InputDecoder(self._vocabulary, frozenset(block.values), from_power_up=True)
        return BoardFollower(
            parts, {}, self._decoded.seen, from_power_up=True, watched=watched, may_freeze=False
        )

    def _followed(self, block: LogBlock, parts: Sequence[LogCone], watched: bool) -> Behaviour:
        follower = self._follower(parts, block, watched)
        follower.block(block, self._decoded.decode(block))
        return follower.end()

    def _plain(self, run: RecordedRun) -> Deviation | None:
        """The first difference from the charts as a whole, where no part has one."""
        seen = set[str]()
        for tick, (step, actual) in enumerate(zip(run.steps, run.outputs, strict=True), 1):
            seen.update(actual)
            if different := differences(self.board, step.expected, actual, seen):
                outputs = {o.name: o for o in self.board.outputs}
                told = tuple(
                    LogDifference(
                        outputs[d.name],
                        (outputs[d.name].signal.raw(d.expected),),
                        None,
                        text=MISSING if d.actual is None else outputs[d.name].signal.show(d.actual),
                    )
                    for d in different
                )
                mismatch = LogMismatch(tick, tick, self.board.name, told[:1], {})
                [plain] = _grouped(mismatch)
                return plain
        return None


def _upstream(parts: Sequence[LogCone], name: str) -> list[LogCone]:
    """A part, and those whose outputs it reads, directly or not."""
    wanted = {cone.name for cone in parts if cone.name == name}
    while True:
        read = {v.name for cone in parts if cone.name in wanted for v in cone.system.inputs}
        more = {cone.name for cone in parts if any(o.var.name in read for o in cone.outputs)}
        if more <= wanted:
            return [cone for cone in parts if cone.name in wanted]
        wanted |= more


def _grouped(mismatch: LogMismatch) -> tuple[Deviation, ...]:
    grouping = Grouping(may_freeze=False)
    grouping.tick(mismatch.tick, [mismatch], True)
    return grouping.end()


SOME_ROWS = 64
"""Rows that are followed before it is asked whether what is looked for was met."""


# --- rows of a recording --------------------------------------------------------------------------


def recorded_block(board: Board, inputs: Sequence[Values], outputs: Sequence[Values]) -> LogBlock:
    """Steps from power-up as rows.  Raises ``ModelError`` for inputs that the charts give no meaning to."""
    values: dict[str, Cells] = {}
    for signal in board.inputs:
        raw = _Raws(signal)
        values[signal.name] = [raw[one[signal.name]] for one in inputs]
    meaningless: dict[str, Mapping[int, str]] = {}
    given = {name for one in outputs for name in one}
    for output in board.outputs:
        if output.name in given:
            cells, texts = _outputs(output.signal, [one.get(output.name) for one in outputs])
            values[output.name] = cells
            if texts:
                meaningless[output.name] = texts
    ticks = range(1, len(inputs) + 1)
    return LogBlock(ticks, ticks, [0] * len(inputs), values, meaningless)


def recorded_run(board: Board, origin: str, block: LogBlock) -> RecordedRun:
    """The run that rows of a recording are of."""
    inputs = {s.name: [units(s.domain, raw) for raw in _all(block.values[s.name])] for s in board.inputs}
    steps = rerun(board, [dict(zip(inputs, row, strict=True)) for row in zip(*inputs.values(), strict=True)])
    outputs: list[dict[str, Value]] = [{} for _ in steps]
    for one in (o for o in board.outputs if o.name in block.values):
        texts = block.meaningless.get(one.name, {})
        for row, (given, raw) in enumerate(zip(outputs, block.values[one.name], strict=True)):
            if raw is not None:
                given[one.name] = units(one.signal.domain, raw)
            elif texts.get(row, MISSING) != MISSING:
                given[one.name] = float(texts[row])
    return RecordedRun(board, origin, tuple(steps), tuple(outputs))


def _all(cells: Cells) -> list[Raw]:
    known = [cell for cell in cells if cell is not None]
    assert len(known) == len(cells), "a run of an implementation has all inputs"
    return known


def rows_of(block: LogBlock, start: int, end: int) -> LogBlock:
    """Some rows of a block."""
    return LogBlock(
        block.lines[start:end],
        block.ticks[start:end],
        block.missing[start:end],
        {name: cells[start:end] for name, cells in block.values.items()},
        {
            name: {i - start: text for i, text in texts.items() if start <= i < end}
            for name, texts in block.meaningless.items()
        },
    )


class _Raws(dict[Value, Raw]):
    """Raw values of an input, each computed once."""

    def __init__(self, signal: BoardSignal) -> None:
        self._signal = signal

    def __missing__(self, value: Value) -> Raw:
        self[value] = raw = self._signal.raw(value)
        return raw


def _outputs(signal: BoardSignal, given: Sequence[Value | None]) -> tuple[Cells, dict[int, str]]:
    """The cells of an output, and what is no value of it; until it is first given, nothing is wrong."""
    cells: Cells = []
    texts: dict[int, str] = {}
    known: dict[Value, Raw | str] = {}
    begun = False
    for i, value in enumerate(given):
        if value is None:
            cells.append(None)
            if begun:
                texts[i] = MISSING
            continue
        begun = True
        raw = known.get(value)
        if raw is None:
            raw = known[value] = _output(signal, value)
        if isinstance(raw, str):
            texts[i] = raw
        cells.append(None if isinstance(raw, str) else raw)
    return cells, texts


def _output(signal: BoardSignal, value: Value) -> Raw | str:
    if not isfinite(value):
        return str(value)
    if isinstance(signal.domain.sort, Bool | Enum):
        return int(value) if value == int(value) and int(value) in signal.domain else f"{value:g}"
    return raw_number(value, signal)


def raw_number(value: Value, signal: BoardSignal) -> Raw:
    """A number as charts compute with it, also one that the firmware should not give."""
    sort = signal.domain.sort
    assert not isinstance(sort, Bool | Enum)
    raw = exact(value) / sort.resolution
    return raw.numerator if raw.denominator == 1 else raw
