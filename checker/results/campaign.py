"""What a campaign of logs or runs found, as data: every format is written from this one record."""

from collections.abc import Sequence
from dataclasses import dataclass
from datetime import date
from typing import Literal

from rovercheck.spec_model.lang.place import Place

CampaignWord = Literal["new", "known", "expired", "changed", "unexpected"]
"""Of a finding; ``unexpected``: a property that is broken, though expected to be true."""

FindingKind = Literal["deviation", "property", "failure"]
"""``failure``: an implementation did not answer as it must."""

RecordingState = Literal["conforms", "deviates", "undecided", "not survived", "not read", "internal error"]


@dataclass(frozen=True)
class CampaignWords:
    """What things are called: a recording, and several; a tick; what was recorded in it."""

    one: str
    many: str
    tick: str
    recorded: str

    def ticks(self, number: int) -> str:
        """``1 tick``, ``1,204 ticks``."""
        return f"{number:,} {self.tick}{'s' * (number != 1)}"


OF_LOGS = CampaignWords("log", "logs", "tick", "logged")
OF_RUNS = CampaignWords("run", "runs", "step", "implementation")


@dataclass(frozen=True)
class OutputMoment:
    """An output in one tick, in words; empty where it is not known.

    ``differs``: by the finding that is shown; ``other``: by another one alone, or as what follows from one.
    """

    tick: int
    expected: str
    recorded: str
    differs: bool = False
    other: bool = False


@dataclass(frozen=True)
class OutputLane:
    """An output over successive ticks."""

    output: str
    moments: tuple[OutputMoment, ...]


@dataclass(frozen=True)
class CampaignOccurrence:
    """Where something is met: the tick, its time from the start in ms, for how many ticks.

    ``line`` is that of the file, 0 where it is met in no file.
    """

    recording: str
    tick: int
    ms: int
    line: int = 0
    ticks: int = 1


@dataclass(frozen=True)
class CampaignSighting:
    """A finding in one recording: where it is first and worst, in how many ticks, how often it begins."""

    recording: str
    first: CampaignOccurrence
    worst: CampaignOccurrence
    ticks: int
    times: int


@dataclass(frozen=True)
class KnownTerms:
    """What is on record of a known deviation."""

    reason: str = ""
    owner: str = ""
    until: date | None = None


@dataclass(frozen=True)
class CampaignFinding:
    """A deviation, or a property that is broken: its sentence, its evidence, where it is met."""

    id: str
    system: str
    word: CampaignWord
    says: str
    evidence: tuple[tuple[str, str], ...]
    """What is known of it, each with a label."""
    sightings: tuple[CampaignSighting, ...]
    lanes: tuple[OutputLane, ...] = ()
    more_lanes: int = 0
    """Outputs that differ, too, and are not drawn."""
    undrawn: str = ""
    """Why there are no lanes, where there might be some."""
    terms: KnownTerms | None = None
    cause: str = ""
    """The change of the charts that explains it, in words, where one was looked for and found."""
    change: tuple[str, ...] = ()
    """That change: of what kind, in which chart, where, from what, to what, and what else would do."""
    other_places: tuple[tuple[str, ...], ...] = ()
    """The same change in other places."""
    rivals: tuple[tuple[str, ...], ...] = ()
    """Other changes that explain exactly as much."""
    places: tuple[Place, ...] = ()
    """Where to look for it, the best first: lines that assign the output, a map, or the recording."""
    key: str = ""
    """What it is called wherever and whenever it is met, known or not; by default its id."""
    kind: FindingKind = "deviation"

    @property
    def first(self) -> CampaignOccurrence:
        """The occurrence after the fewest ticks of a recording."""
        return min((s.first for s in self.sightings), key=lambda o: (o.tick, o.recording))

    @property
    def worst(self) -> CampaignOccurrence:
        """The longest one."""
        return max((s.worst for s in self.sightings), key=lambda o: (o.ticks, -o.tick))

    @property
    def ticks(self) -> int:
        """All ticks that differ."""
        return sum(s.ticks for s in self.sightings)

    def sighting(self, recording: str) -> CampaignSighting | None:
        """Where it is met in one recording, if it is."""
        return next((s for s in self.sightings if s.recording == recording), None)


@dataclass(frozen=True)
class CampaignRecording:
    """A log, or what was compared: what came of it, and what of it was not compared, each with the reason."""

    name: str
    system: str
    state: RecordingState
    size: str
    message: str = ""
    """Why it could not be read, or not to its end."""
    gaps: tuple[tuple[str, str], ...] = ()
    """What was not compared, and why."""


@dataclass(frozen=True)
class CampaignRecord:
    """All that is told of a campaign.

    ``recordings`` are all of them, or those of ``of`` in which some finding is first or worst.
    """

    title: str
    words: CampaignWords
    charts: str
    recordings: Sequence[CampaignRecording]
    findings: Sequence[CampaignFinding]
    notes: Sequence[str] = ()
    """What else is to be said: what came of known deviations, which recordings are shown."""
    of: int | None = None
    gaps: Sequence[tuple[str, str]] = ()
    """What was compared in no recording, and why."""

    @property
    def headline(self) -> str:
        """``3 logs, 1 not read; 3 findings: 2 new, 1 known``."""
        one, many = self.words.one, self.words.many
        number = len(self.recordings) if self.of is None else self.of
        unread = sum(r.state in ("not read", "internal error") for r in self.recordings)
        parts = [f"{number:,} {one if number == 1 else many}" + (f", {unread} not read" if unread else "")]
        words = [f.word for f in self.findings]
        told = [f"{words.count(w)} {w}" for w in dict.fromkeys(words)]
        count = f"{len(words)} finding{'s' * (len(words) != 1)}"
        parts.append(f"{count}: {', '.join(told)}" if words else "nothing deviates")
        return "; ".join(parts)


__all__ = [
    "OF_LOGS", "OF_RUNS", "CampaignFinding", "CampaignOccurrence", "CampaignRecord", "CampaignRecording",
    "CampaignSighting", "CampaignWords", "FindingKind", "KnownTerms", "OutputLane", "OutputMoment",
]  # fmt: skip
