"""The record of a campaign of logs, from which its reports are written."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

from rovercheck.checker.commands.check_log.campaign import LogCampaign, joins
from rovercheck.checker.commands.check_log.text import LogFault, Outcome
from rovercheck.checker.commands.shared.deviation_text import headline
from rovercheck.checker.commands.shared.known import known_lines
from rovercheck.checker.conformance.deviations import Deviation
from rovercheck.checker.conformance.excerpt import MOST_LANES, ExcerptWindow, excerpts
from rovercheck.checker.diagnosis.logs import logged_run
from rovercheck.checker.logs import ColumnMap, LogError, LogResult
from rovercheck.checker.results.campaign import (
    CampaignFinding,
    CampaignOccurrence,
    CampaignRecord,
    CampaignRecording,
    CampaignSighting,
    KnownTerms,
    OutputLane,
    RecordingState,
)
from rovercheck.spec_model.abstraction import Board, boards
from rovercheck.spec_model.lang.system import TICK_MS


@dataclass(frozen=True)
class LogReport:
    """What a report is made of: what came of each log by name, where the logs are, how they are read."""

    found: Mapping[str, Outcome]
    campaign: LogCampaign
    folder: Path
    how: ColumnMap
    charts: str = ""
    boards: Mapping[str, Board] | None = None

    def record(self) -> CampaignRecord:
        """The record.  A log that cannot be read again has no timeline."""
        every = [(board, d) for board, found in self.campaign.deviations.items() for d in found]
        lanes = self._lanes(every)
        findings = [self._finding(board, d, lanes.get(n, ())) for n, (board, d) in enumerate(every)]
        notes = [line for j in self.campaign.judgements.values() for line in known_lines(j)]
        return CampaignRecord(
            f"Logs of {self.folder.name}", ("log", "logs"), self.charts,
            [_recording(name, one) for name, one in self.found.items()],
            [*findings, *self._broken()], notes,
        )  # fmt: skip

    def _lanes(self, every: list[tuple[str, Deviation]]) -> dict[int, tuple[OutputLane, ...]]:
        lanes: dict[int, tuple[OutputLane, ...]] = {}
        known = self.boards or boards()
        for name in dict.fromkeys(d.origin for _, d in every):
            own = [(n, board, d) for n, (board, d) in enumerate(every) if d.origin == name]
            board = own[0][1]
            windows = [ExcerptWindow(d.first.tick, d.outputs) for _, _, d in own]
            try:
                run = logged_run(self.folder / name, self.how, board, known).run
                found = excerpts(known[board], run, windows)
            except (LogError, OSError):  # changed or gone meanwhile
                continue
            lanes |= {n: one for (n, _, _), one in zip(own, found, strict=True)}
        return lanes

    def _finding(self, board: str, one: Deviation, lanes: tuple[OutputLane, ...]) -> CampaignFinding:
        judgement = self.campaign.judgements[board]
        judged = judgement.of(one)
        terms = [KnownTerms(k.reason, k.owner, k.until) for k, _ in judgement.known if k.id == judged.id]
        return CampaignFinding(
            judged.id, board, judged.word, headline(one), tuple(_evidence(one)),
            tuple(self._sightings(board, one)), lanes, max(0, len(one.outputs) - MOST_LANES),
            terms[0] if terms else None,
        )  # fmt: skip

    def _sightings(self, board: str, one: Deviation) -> Iterator[CampaignSighting]:
        for log in self.campaign.logs:
            groups = log.behaviour.tally.groups.values() if log.layout.board == board else ()
            own = [g for g in groups if self._whole(board, g) is one]
            if own:
                first = min((g.first for g in own), key=lambda m: m.tick)
                worst = max((g.worst for g in own), key=lambda w: (w.ticks, -w.tick))
                yield CampaignSighting(
                    log.name,
                    CampaignOccurrence(log.name, first.tick, first.tick * TICK_MS, first.line),
                    CampaignOccurrence(log.name, worst.tick, worst.tick * TICK_MS, worst.line, worst.ticks),
                    sum(g.count for g in own),
                    sum(g.times for g in own),
                )

    def _whole(self, board: str, group: Deviation) -> Deviation | None:
        """The deviation over all logs that stands for a group of one: itself, or what it was joined with."""
        every, scope = self.campaign.deviations[board], group.scope
        same = [d for d in every if d.scope == scope] or [d for d in every if joins(d, group)]
        alike = (d for d in every if (d.scope.part, d.scope.differences) == (scope.part, scope.differences))
        return next(iter(same), None) or next(alike, None)

    def _broken(self) -> Iterator[CampaignFinding]:
        """Properties that are broken though expected to hold, each once."""
        met: dict[tuple[str, str], list[CampaignSighting]] = {}
        says: dict[tuple[str, str], str] = {}
        for log in self.campaign.logs:
            for v in log.unexpected:
                if v.first is None:
                    continue
                key = log.layout.board, v.prop.id
                at = CampaignOccurrence(log.name, v.first.tick, v.first.tick * TICK_MS, v.first.line, 0)
                met.setdefault(key, []).append(CampaignSighting(log.name, at, at, v.count, 1))
                says[key] = f"{v.prop.id} is {v.word}: {v.prop.text}"
        for (board, id), sightings in met.items():
            yield CampaignFinding(id, board, "unexpected", says[board, id], (), tuple(sightings))


def _evidence(one: Deviation) -> Iterator[tuple[str, str]]:
    for d in one.differences[:MOST_LANES]:
        expected, logged = d.values()
        yield "expected", f"{d.output.name}: {' or '.join(expected) or 'a value'}; logged {logged}"
    if len(one.differences) > MOST_LANES:
        yield "and", f"{len(one.differences) - MOST_LANES} more pairs of values"
    if one.first.moves:
        yield "charts", "; ".join(one.first.moves)
    if one.first.inputs:
        yield "inputs", ", ".join(f"{n} = {v}" for n, v in one.first.inputs.items())


def _recording(name: str, one: Outcome) -> CampaignRecording:
    match one:
        case LogResult():
            open_ = one.behaviour.undecided or one.ended
            state: RecordingState = "deviates" if one.deviates else "undecided" if open_ else "conforms"
            size = f"{one.ticks:,} ticks = {one.seconds:g} s"
            return CampaignRecording(name, one.layout.board, state, size, one.ended, tuple(_gaps(one)))
        case LogFault(message):
            return CampaignRecording(name, "", "internal error", "", message)
    return CampaignRecording(name, "", "not read", "", str(one))


def _gaps(one: LogResult) -> Iterator[tuple[str, str]]:
    if one.behaviour.left_out:
        yield ", ".join(one.behaviour.left_out), "computed from inputs that are not logged"
    for u in one.behaviour.undecided:
        yield f"{u.part} from tick {u.tick} on", u.because
    if one.missing:
        yield f"{one.missing:,} steps", "missing in the log"
    for cell in one.invalid.cells:
        yield f"{cell.name}, {cell.count:,} cells from line {cell.line} on", cell.because
    for column, count in one.invalid.others.items():
        yield f"{column}, {count:,} more cells", "without meaning, with other values"
    if one.choice.missing:
        names = dict.fromkeys(name for o in one.choice.missing for name in o.missing)
        yield f"{len(one.choice.missing)} properties", f"for want of columns: {', '.join(names)}"
