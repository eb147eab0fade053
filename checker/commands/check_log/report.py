"""The record of a campaign of logs, from which its reports are written."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import Path

from rovercheck.checker.commands.check_log.campaign import LogCampaign
from rovercheck.checker.commands.check_log.causes import LOGS, not_searched
from rovercheck.checker.commands.check_log.text import LogFault, Outcome
from rovercheck.checker.commands.shared.campaign_findings import deviation_finding, sightings
from rovercheck.checker.commands.shared.cause_text import also, untold, with_cause
from rovercheck.checker.commands.shared.known import known_lines
from rovercheck.checker.conformance.deviations import Deviation
from rovercheck.checker.conformance.excerpt import ExcerptWindow, excerpts
from rovercheck.checker.diagnosis.causes import DeviationCause
from rovercheck.checker.diagnosis.logs import logged_run
from rovercheck.checker.logs import ColumnMap, LogError, LogResult
from rovercheck.checker.results.campaign import (
    OF_LOGS,
    CampaignFinding,
    CampaignOccurrence,
    CampaignRecord,
    CampaignRecording,
    CampaignSighting,
    OutputLane,
    RecordingState,
)
from rovercheck.spec_model.abstraction import Board, boards
from rovercheck.spec_model.lang.place import Place
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
        causes = [(b, c) for b in self.campaign.deviations for c in self.campaign.groups(b).causes]
        drawn = self._lanes([(board, cause.first) for board, cause in causes])
        findings = [self._finding(board, c, drawn.get(n, ())) for n, (board, c) in enumerate(causes)]
        notes = [line for j in self.campaign.judgements.values() for line in known_lines(j)]
        for groups in self.campaign.causes.values():
            notes += not_searched(groups)
        return CampaignRecord(
            f"{self.folder.name}: logs beside the charts", OF_LOGS, self.charts,
            [_recording(name, one) for name, one in self.found.items()],
            [*findings, *self._broken()], notes,
        )  # fmt: skip

    def _lanes(self, every: list[tuple[str, Deviation]]) -> dict[int, tuple[OutputLane, ...] | str]:
        """The timeline of each deviation by its number, or why it has none."""
        lanes: dict[int, tuple[OutputLane, ...] | str] = {}
        known = self.boards or boards()
        for name in dict.fromkeys(d.origin for _, d in every):
            own = [(n, board, d) for n, (board, d) in enumerate(every) if d.origin == name]
            board = own[0][1]
            windows = [ExcerptWindow(d) for _, _, d in own]
            try:
                run = logged_run(self.folder / name, self.how, board, known).run
                found = excerpts(known[board], run, windows, self.campaign.deviations[board])
            except (LogError, OSError) as error:  # changed or gone meanwhile
                lanes |= {n: f"{name} could not be read again: {error}" for n, _, _ in own}
                continue
            lanes |= {n: one for (n, _, _), one in zip(own, found, strict=True)}
        return lanes

    def _finding(
        self, board: str, cause: DeviationCause, drawn: tuple[OutputLane, ...] | str
    ) -> CampaignFinding:
        """The first deviation of a cause, with what is known of all."""
        every = self.campaign.deviations[board]
        of_board = [log for log in self.campaign.logs if log.layout.board == board]
        groups = ((log.name, log.behaviour.tally.groups.values()) for log in of_board)
        met = sightings(cause.deviations, groups, every, TICK_MS, lines=True)
        more = [("or", told)] if (told := untold(cause, LOGS[1])) else []
        more += [("also", also(one, cause, LOGS)) for one in cause.deviations[1:]]
        found = deviation_finding(board, cause.first, self.campaign.judgements[board], OF_LOGS, met, more)
        found = with_cause(found, cause)
        place = Place(str(self.folder / found.first.recording), found.first.line)
        if isinstance(drawn, str):
            return replace(found, undrawn=drawn, places=(place,))
        return replace(found, lanes=drawn, places=(place,))

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
        for (board, id), shown in met.items():
            found = CampaignFinding(
                id, board, "unexpected", says[board, id], (), tuple(shown),
                key=f"{board} {id}", kind="property",
            )  # fmt: skip
            at = found.first
            yield replace(found, places=(Place(str(self.folder / at.recording), at.line),))


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
