"""One log, checked in both ways: every property as a monitor, and as a run of the charts."""

from collections.abc import Mapping
from contextlib import closing
from dataclasses import dataclass
from pathlib import Path

from rovercheck.checker.conformance.decoder import InputDecoder
from rovercheck.checker.conformance.follower import Behaviour, BoardFollower
from rovercheck.checker.conformance.recording import LogBlock
from rovercheck.checker.logs.errors import LogError
from rovercheck.checker.logs.invalid import Invalid
from rovercheck.checker.logs.log import Log, LogLayout, open_log
from rovercheck.checker.logs.mapping import ColumnMap
from rovercheck.checker.logs.monitors import LogMonitors, LogVerdict
from rovercheck.checker.logs.reference import LogReference, as_drawn
from rovercheck.checker.logs.selection import PropertySelection
from rovercheck.properties.forms import Reachable
from rovercheck.spec_model.lang.system import TICK_MS

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

    ``invalid``: cells without meaning; their values are unknown in all the rest.  ``ended``: why the file
    could not be read any further, empty if it could.
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
    ended: str = ""

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
        return not (self.deviates or self.invalid or self.ended or self.behaviour.undecided)

    @property
    def seconds(self) -> float:
        """How long the recorded run took."""
        return self.ticks * TICK_MS / 1000


def as_on_record(verdict: LogVerdict) -> bool:
    """Whether what was met in the log is what the baseline leads to expect."""
    violated = verdict.expected == "violated"
    return not violated if isinstance(verdict.prop.form, Reachable) else violated


def examine(
    path: Path,
    how: ColumnMap,
    system: str = "",
    against: LogReference | None = None,
    watched: bool = False,
) -> LogResult:
    """Check one log, against the charts as specified unless told otherwise.

    ``watched``: whether its behaviour says what was put to the test.  A file that cannot be read up to its
    end is judged as far as it can.  Raises ``LogError`` for one that is no log of the board at all.
    """
    against = against or as_drawn()
    log = open_log(path, how, system, against.boards)
    with closing(log.blocks()) as blocks:
        first = next(blocks)
        run = _Run(log, against, watched)
        run.block(first)
        try:
            for block in blocks:
                run.block(block)
        except LogError as error:
            run.ended = str(error)
    return run.result()


class _Run:
    """A log on its way through both checks."""

    def __init__(self, log: Log, against: LogReference, watched: bool) -> None:
        self._log, self._against = log, against
        layout, from_power_up = log.layout, log.start == "power-up"
        vocabulary = against.vocabulary(layout.board)
        self._decoder = InputDecoder(vocabulary, layout.signals, from_power_up)
        seen, logged = self._decoder.seen, layout.signals - vocabulary.inputs
        known = seen | {o.var.name for o in vocabulary.board.outputs if o.name in logged}
        self._choice = against.choice(layout.board, known)
        self._monitors = LogMonitors(vocabulary, self._choice, known, from_power_up)
        parts = against.cones(layout.board, seen, logged)
        self._follow = BoardFollower(parts, _tolerance(layout), seen, from_power_up, watched=watched)
        self._rows = self._ticks = self._missing = 0
        self.ended = ""
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
            self.ended,
        )

    def _on_record(self, verdict: LogVerdict) -> LogVerdict:
        verdict.expected = self._against.expected(verdict.prop.id)
        return verdict


def _tolerance(layout: LogLayout) -> Mapping[str, float]:
    return {c.signal: c.tolerance for c in layout.stated.values() if c.tolerance is not None}
