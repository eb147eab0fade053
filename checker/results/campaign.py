"""What a campaign of logs found, as data: every format is written from this one record."""

from collections.abc import Sequence
from dataclasses import dataclass
from datetime import date
from typing import Literal

CampaignWord = Literal["new", "known", "expired", "changed", "unexpected"]
"""Of a finding; ``unexpected``: a property that is broken, though expected to be true."""

RecordingState = Literal["conforms", "deviates", "undecided", "not read", "internal error"]


@dataclass(frozen=True)
class OutputMoment:
    """An output in one tick, in words; empty where it is not known."""

    tick: int
    expected: str
    recorded: str
    differs: bool = False


@dataclass(frozen=True)
class OutputLane:
    """An output over successive ticks."""

    output: str
    moments: tuple[OutputMoment, ...]


@dataclass(frozen=True)
class CampaignOccurrence:
    """Where something is met: the tick, its time from the start in ms, the line, for how many ticks."""

    recording: str
    tick: int
    ms: int
    line: int
    ticks: int = 1

    @property
    def lasts(self) -> str:
        """How long, in words."""
        return "1 tick" if self.ticks == 1 else f"{self.ticks:,} ticks"


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
    terms: KnownTerms | None = None

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
    """All that is told of a campaign; ``noun`` is what its recordings are called."""

    title: str
    noun: tuple[str, str]
    charts: str
    recordings: Sequence[CampaignRecording]
    findings: Sequence[CampaignFinding]
    notes: Sequence[str] = ()
    """What came of known deviations, besides being there."""

    @property
    def headline(self) -> str:
        """``3 logs, 1 not read; 2 deviations new, 1 known``."""
        one, many = self.noun
        number = len(self.recordings)
        unread = sum(r.state in ("not read", "internal error") for r in self.recordings)
        parts = [f"{number} {one if number == 1 else many}" + (f", {unread} not read" if unread else "")]
        words = [f.word for f in self.findings]
        told = [f"{words.count(w)} {w}" for w in dict.fromkeys(words)]
        count = f"{len(words)} finding{'s' * (len(words) != 1)}"
        parts.append(f"{count}: {', '.join(told)}" if words else "nothing deviates")
        return "; ".join(parts)


__all__ = [
    "CampaignFinding", "CampaignOccurrence", "CampaignRecord", "CampaignRecording",
    "CampaignSighting", "KnownTerms", "OutputLane", "OutputMoment",
]  # fmt: skip
