"""The record of a cross-check, from which its reports are written."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from hashlib import sha256

from rovercheck.checker.commands.compare.cause_text import RUNS, in_all, searched
from rovercheck.checker.commands.compare.places import ImplementationPlaces
from rovercheck.checker.commands.compare.text import CrosscheckReport, failure_cause, untried
from rovercheck.checker.commands.shared.campaign_findings import deviation_finding, sightings
from rovercheck.checker.commands.shared.cause_text import also, untold, with_cause
from rovercheck.checker.commands.shared.known import known_lines
from rovercheck.checker.commands.shared.output import counted
from rovercheck.checker.compare.beside import differences
from rovercheck.checker.compare.notable_runs import NotableRun
from rovercheck.checker.compare.result import Failure
from rovercheck.checker.compare.run_follower import RecordedRun
from rovercheck.checker.conformance.deviations import Deviation
from rovercheck.checker.conformance.excerpt import MOST_LANES, ExcerptWindow, excerpts
from rovercheck.checker.conformance.follower import MISSING
from rovercheck.checker.diagnosis.causes import DeviationCause
from rovercheck.checker.results.campaign import (
    OF_RUNS,
    CampaignFinding,
    CampaignOccurrence,
    CampaignRecord,
    CampaignRecording,
    CampaignSighting,
    OutputLane,
    OutputMoment,
    RecordingState,
)


def campaign_record(reports: Sequence[CrosscheckReport]) -> CampaignRecord:
    """All boards as one record; only runs in which something is first or worst are recordings of it."""
    boards = [BoardRecord(one, len(reports) > 1) for one in reports]
    addresses = dict.fromkeys(one.address for one in reports)
    shown = [r for b in boards for r in b.recordings()]
    return CampaignRecord(
        f"{', '.join(addresses)} beside the charts",
        OF_RUNS,
        reports[0].charts if reports else "",
        shown,
        [f for b in boards for f in b.findings()],
        [note for b in boards for note in b.notes()],
        sum(one.result.coverage.runs for one in reports),
        [gap for b in boards for gap in b.gaps()],
    )


@dataclass(frozen=True)
class BoardRecord:
    """What is told of one board; ``several``: names say which one."""

    of: CrosscheckReport
    several: bool = False

    def _named(self, one: NotableRun | Failure) -> str:
        origin = one.run.origin if isinstance(one, NotableRun) else one.origin
        name = origin if origin.startswith("random run") else f"run {one.number}, {origin}"
        return f"{self.of.result.board.name}: {name}" if self.several else name

    @cached_property
    def _every(self) -> list[Deviation]:
        """The deviations as they were met in the runs, before any run was made small."""
        met = self.of.result.met
        return [met.get(one.scope, one) for one in self.of.result.deviations]

    def recordings(self) -> Iterator[CampaignRecording]:
        """The runs that are shown."""
        result, failed = self.of.result, {one.number: one for one in self._failures}
        for one in result.notable:
            if one.number not in failed:
                yield self._recording(self._named(one), len(one.run.steps))
        for failure in failed.values():
            yield self._recording(self._named(failure), failure.tick, failure.message)

    def _recording(self, name: str, steps: int, message: str = "") -> CampaignRecording:
        board = self.of.result.board
        size = f"{OF_RUNS.ticks(steps)} = {steps * board.tick_ms / 1000:g} s"
        state: RecordingState = "not survived" if message else "deviates"
        return CampaignRecording(name, board.name, state, size, message)

    def notes(self) -> Iterator[str]:
        """How much was tried, which runs are shown, what came of known deviations."""
        result = self.of.result
        (took, every), (met, sides) = result.transitions, result.coverage.boundaries()
        yield (
            f"{result.board.name}: {OF_RUNS.ticks(result.coverage.steps)} in "
            f"{counted(result.coverage.runs, 'run', 'runs')}; the charts took {took} of {every} transitions, "
            f"and inputs met {met} of {sides} sides of boundaries."
        )
        if len(result.notable) < result.notable.deviating:
            yield (
                f"{result.board.name}: {counted(result.notable.deviating, 'run deviates', 'runs deviate')}; "
                f"shown are the {len(result.notable)} in which a finding is met first or for longest."
            )
        yield from known_lines(self.of.judgement)
        yield from (f"{result.board.name}: {line}" for line in searched(self.of.groups))

    def gaps(self) -> Iterator[tuple[str, str]]:
        """What was compared in no run, and why."""
        result, board = self.of.result, self.of.result.board.name
        if result.uncompared:
            yield f"{board}: {', '.join(result.uncompared)}", "the implementation never gave them"
        for (part, because), runs in result.undecided.items():
            yield f"{board}: {part}, after a deviation in {counted(runs, 'run', 'runs')}", because
        for stage in result.stages:
            if stage.because:
                yield board, untried(stage)
        if result.missing:
            told = counted(len(result.missing), "transition", "transitions")
            yield f"{board}: {told}", f"no run took them: {'; '.join(map(str, result.missing))}"

    # --- findings -----------------------------------------------------------------------------------------

    def findings(self) -> Iterator[CampaignFinding]:
        """The deviations by cause, what explains most first, then each way in which it fails to answer."""
        places = ImplementationPlaces(self.of.address, self.of.result.board)
        met = {one.scope: one for one in self._every}
        for cause in self.of.findings:
            group = [met[one.scope] for one in cause.deviations]
            outputs = list(dict.fromkeys(name for one in group for name in one.outputs))
            found = with_cause(self._finding(cause, group), cause)
            yield replace(found, places=places.of(outputs))
        for failure in self._failures:
            yield replace(self._failed(failure), places=places.of(()))

    def _finding(self, cause: DeviationCause, group: Sequence[Deviation]) -> CampaignFinding:
        """The first deviation, with what is known of all; drawn is the one that is met first."""
        result = self.of.result
        tick_ms = result.board.tick_ms
        groups = [(self._named(r), r.groups) for r in result.notable]
        met = sightings(group, groups, self._every, tick_ms)
        more = [("in all", in_all(cause, result))]
        more += [("or", told)] if (told := untold(cause, RUNS[1])) else []
        more += [("also", also(one, cause, RUNS)) for one in group[1:]]
        found = deviation_finding(result.board.name, group[0], self.of.judgement, OF_RUNS, met, more)
        drawn = next(
            (one for one in group if any(s.first == found.first for s in self._sightings(one, groups))),
            group[0],
        )
        lanes = self._lanes[id(drawn)]
        return replace(found, lanes=lanes, undrawn="" if lanes else "its run was not kept to its end")

    def _sightings(
        self, one: Deviation, groups: Sequence[tuple[str, Iterable[Deviation]]]
    ) -> tuple[CampaignSighting, ...]:
        return sightings([one], groups, self._every, self.of.result.board.tick_ms)

    @cached_property
    def _lanes(self) -> dict[int, tuple[OutputLane, ...]]:
        """The timeline of each deviation, in the run in which it is first."""
        board, found = self.of.result.board, dict[int, tuple[OutputLane, ...]]()
        for kept in self.of.result.notable:
            own = [d for d in self._every if id(d) not in found and kept.first(d, self._every)]
            windows = [ExcerptWindow(d) for d in own]
            if not windows:
                continue
            run = kept.run.up_to(max(w.last for w in windows) + 2)  # late is known a step later
            lanes = excerpts(board, run.recording, windows, self._every, may_freeze=False)
            for window, drawn in zip(windows, lanes, strict=True):
                marked = any(m.differs for lane in drawn for m in lane.moments)
                found[id(window.deviation)] = drawn if marked else whole_lanes(kept.run, window)
        return {id(d): found.get(id(d), ()) for d in self._every}

    @cached_property
    def _failures(self) -> list[Failure]:
        """Each way to fail, at its shortest."""
        ways: dict[str, Failure] = {}
        for failure in self.of.result.failures:
            ways.setdefault(failure_cause(failure), failure)
        return list(ways.values())

    def _failed(self, failure: Failure) -> CampaignFinding:
        board, name = failure.board, self._named(failure)
        cause = failure_cause(failure)
        same = [f for f in self.of.result.failures if failure_cause(f) == cause]
        at = CampaignOccurrence(name, failure.tick, failure.tick * board.tick_ms, ticks=0)
        digest = sha256(repr((board.name, cause)).encode(errors="backslashreplace")).hexdigest()[:6]
        inputs = failure.steps[-1].inputs if failure.steps else {}
        shown = {s.name: s for s in board.inputs}
        given = ", ".join(f"{n} = {v if shown[n].stamp else shown[n].show(v)}" for n, v in inputs.items())
        evidence = [("it says", failure.message), *([("inputs", given)] if given else [])]
        evidence.append(("in all", counted(len(same), "run", "runs")))
        id = f"{board.name}-answers-{digest}"
        return CampaignFinding(
            id, board.name, "new", "The implementation does not answer as it must", tuple(evidence),
            (CampaignSighting(name, at, at, 1, 1),), key=id, kind="failure",
        )  # fmt: skip


def whole_lanes(run: RecordedRun, window: ExcerptWindow) -> tuple[OutputLane, ...]:
    """The lanes of a deviation that no part of the board has by itself: beside the charts as a whole."""
    signals = {o.name: o.signal for o in run.board.outputs}
    moments: dict[str, list[OutputMoment]] = {name: [] for name in window.deviation.outputs[:MOST_LANES]}
    seen = set[str]()
    for tick, (step, actual) in enumerate(zip(run.steps, run.outputs, strict=True), 1):
        seen.update(actual)
        if not window.holds(tick):
            continue
        wrong = {d.name for d in differences(run.board, step.expected, actual, seen)}
        for name, lane in moments.items():
            due, got = step.expected.get(name), actual.get(name)
            expected = "" if due is None else signals[name].show(due)
            given = (MISSING if name in seen else "") if got is None else signals[name].show(got)
            lane.append(OutputMoment(tick, expected, given, name in wrong))
    return tuple(OutputLane(name, tuple(lane)) for name, lane in moments.items() if lane)


__all__ = ["campaign_record"]
