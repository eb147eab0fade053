"""What is expected beside what was recorded, tick by tick, around the place where a recording deviates."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from rovercheck.checker.conformance.cones import LogCone, cones
from rovercheck.checker.conformance.decoder import InputDecoder
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
    """The outputs that are wanted, and the tick around which they are."""

    tick: int
    outputs: tuple[str, ...]

    @property
    def first(self) -> int:
        return max(1, self.tick - BEFORE)

    @property
    def last(self) -> int:
        return self.tick + AFTER


def excerpts(board: Board, run: Recording, windows: Sequence[ExcerptWindow]) -> list[tuple[OutputLane, ...]]:
    """For each window its outputs as lanes.  Reads no further than it must.

    Raises what reading the blocks of the run raises.
    """
    vocabulary = Vocabulary(board)
    decoder = InputDecoder(vocabulary, run.signals, run.from_power_up)
    parts: Sequence[LogCone] = cones(board, decoder.seen, run.signals - vocabulary.inputs)
    found = _Moments(windows)
    follower = BoardFollower(parts, run.tolerance, decoder.seen, run.from_power_up, found.row)
    follower.heard = found.heard
    end = max((w.last for w in windows), default=0)
    for block in run.blocks():
        follower.block(block, decoder.decode(block))
        if block.ticks and block.ticks[-1] >= end:
            break
    return [found.lanes(window) for window in windows]


class _Moments:
    """Keeps what a follower tells of the ticks that are wanted."""

    def __init__(self, windows: Sequence[ExcerptWindow]) -> None:
        self._windows = windows
        self._wanted = {name for w in windows for name in w.outputs}
        self._found: dict[str, dict[int, OutputMoment]] = {}

    def row(self, tracker: Tracker, row: TrackedRow, mismatch: LogMismatch | None) -> None:
        if not any(w.first <= row.tick <= w.last for w in self._windows):
            return
        required: Sequence[Raw | None] = tracker.required or [None] * len(row.logged)
        for output, due, got in zip(tracker.cone.outputs, required, row.logged, strict=True):
            if output.name in self._wanted:
                domain = output.var.domain
                expected = "" if due is None else shown(domain, due)
                logged = "" if got is None else shown(domain, got)
                self._found.setdefault(output.name, {})[row.tick] = OutputMoment(row.tick, expected, logged)

    def heard(self, mismatches: Sequence[LogMismatch]) -> None:
        for one in mismatches:
            for d in one.differences:
                moments: Mapping[int, OutputMoment] = self._found.get(d.output.name, {})
                if one.tick in moments:
                    expected, logged = d.values()
                    told = OutputMoment(one.tick, " or ".join(expected), logged, differs=True)
                    self._found[d.output.name][one.tick] = told

    def lanes(self, window: ExcerptWindow) -> tuple[OutputLane, ...]:
        found = []
        for name in window.outputs[:MOST_LANES]:
            kept = self._found.get(name, {})
            moments = tuple(m for t, m in sorted(kept.items()) if window.first <= t <= window.last)
            if moments:
                found.append(OutputLane(name, moments))
        return tuple(found)


__all__ = ["ExcerptWindow", "excerpts"]
