"""What is expected beside what was recorded, tick by tick, around the place where a recording deviates."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

from rovercheck.checker.conformance.cones import LogCone, cones
from rovercheck.checker.conformance.decoder import InputDecoder
from rovercheck.checker.conformance.deviations import Deviation, DeviationScope, whole_of
from rovercheck.checker.conformance.follower import BoardFollower
from rovercheck.checker.conformance.mismatch import LogMismatch, shown
from rovercheck.checker.conformance.recording import Raw, Recording
from rovercheck.checker.conformance.signals import Vocabulary
from rovercheck.checker.conformance.tracker import TrackedRow, Tracker
from rovercheck.checker.results.campaign import OutputLane, OutputMoment
from rovercheck.spec_model.abstraction import Board

BEFORE, AFTER = 12, 28
"""Ticks around the first one that deviates."""
MOST_LANES = 6


@dataclass(frozen=True)
class ExcerptWindow:
    """The deviation that is shown, and the tick around which it is."""

    deviation: Deviation

    @property
    def first(self) -> int:
        return max(1, self.deviation.first.tick - BEFORE)

    @property
    def last(self) -> int:
        return self.deviation.first.tick + AFTER

    def holds(self, tick: int) -> bool:
        """Whether a tick lies in it."""
        return self.first <= tick <= self.last


def excerpts(
    board: Board,
    run: Recording,
    windows: Sequence[ExcerptWindow],
    every: Sequence[Deviation],
    may_freeze: bool = True,
) -> list[tuple[OutputLane, ...]]:
    """For each window the outputs of its deviation as lanes.  Reads no further than it must.

    ``every``: all deviations of the board, of which each tick that differs belongs to one; ``may_freeze``:
    see ``Grouping``.  Raises what reading the blocks of the run raises.
    """
    vocabulary = Vocabulary(board)
    decoder = InputDecoder(vocabulary, run.signals, run.from_power_up)
    parts: Sequence[LogCone] = cones(board, decoder.seen, run.signals - vocabulary.inputs)
    found = _Moments(windows, every)
    follower = BoardFollower(
        parts, run.tolerance, decoder.seen, run.from_power_up, found.row, may_freeze=may_freeze
    )
    follower.heard = found.heard
    follower.grouping.told = found.told
    end = max((w.last for w in windows), default=0)
    for block in run.blocks():
        follower.block(block, decoder.decode(block))
        if block.ticks and block.ticks[0] > end:  # one more than is shown: late is known a tick later
            break
    follower.end()
    return [found.lanes(window) for window in windows]


class _Moments:
    """Keeps what a follower tells of the ticks that are wanted."""

    def __init__(self, windows: Sequence[ExcerptWindow], every: Sequence[Deviation]) -> None:
        self._windows, self._every = windows, every
        self._wanted = {name for w in windows for name in w.deviation.outputs}
        self._found: dict[str, dict[int, OutputMoment]] = {}
        self._marked: dict[DeviationScope, set[tuple[str, int]]] = {}
        """By deviation the outputs and ticks that belong to it."""

    def row(self, tracker: Tracker, row: TrackedRow, mismatch: LogMismatch | None) -> None:
        if not self._shows(row.tick):
            return
        required: Sequence[Raw | None] = tracker.required or [None] * len(row.logged)
        astray = tracker.astray(row.logged)
        for i, (output, due, got) in enumerate(zip(tracker.cone.outputs, required, row.logged, strict=True)):
            if output.name in self._wanted:
                domain = output.var.domain
                expected = "" if due is None else shown(domain, due)
                logged = "" if got is None else shown(domain, got)
                moment = OutputMoment(row.tick, expected, logged, other=i in astray)
                self._found.setdefault(output.name, {})[row.tick] = moment

    def heard(self, mismatches: Sequence[LogMismatch]) -> None:
        for one in mismatches:
            for d in one.differences:
                moments = self._found.get(d.output.name, {})
                if one.tick in moments:
                    expected, logged = d.values()
                    told = OutputMoment(one.tick, " or ".join(expected), logged, other=True)
                    moments[one.tick] = told

    def told(self, piece: LogMismatch, scope: DeviationScope) -> None:
        if not self._shows(piece.tick):
            return
        whole = whole_of(self._every, scope, piece.outputs)
        if whole is not None:
            self._marked.setdefault(whole.scope, set()).update((name, piece.tick) for name in piece.outputs)

    def _shows(self, tick: int) -> bool:
        return any(w.holds(tick) for w in self._windows)

    def lanes(self, window: ExcerptWindow) -> tuple[OutputLane, ...]:
        found = []
        marked = self._marked.get(window.deviation.scope, set())
        for name in window.deviation.outputs[:MOST_LANES]:
            kept = self._found.get(name, {})
            moments = tuple(
                replace(m, differs=True, other=False) if (name, tick) in marked else m
                for tick, m in sorted(kept.items())
                if window.holds(tick)
            )
            if moments:
                found.append(OutputLane(name, moments))
        return tuple(found)


__all__ = ["MOST_LANES", "ExcerptWindow", "excerpts"]
