"""A campaign as part of a JSON document: all that its page shows."""

from typing import Literal

from typing_extensions import TypedDict

from rovercheck.checker.io.document import Count, Ordinal, PlaceRow, Text, place_row
from rovercheck.checker.io.printable import one_line
from rovercheck.checker.results.campaign import (
    CampaignFinding,
    CampaignOccurrence,
    CampaignRecord,
    CampaignRecording,
    CampaignSighting,
    CampaignWord,
    FindingKind,
    OutputLane,
    RecordingState,
)


class LabelledText(TypedDict):
    """A sentence with its label."""

    label: str
    text: str


class GapRow(TypedDict):
    """What was not compared, and why."""

    what: str
    because: str


class RecordingRow(TypedDict):
    """A log, or a run of the implementation."""

    name: str
    system: str
    state: RecordingState
    size: str
    message: str
    """Why it could not be read, or not to its end."""
    not_compared: list[GapRow]


class OccurrenceRow(TypedDict):
    """Where something is met."""

    recording: str
    tick: Count
    """0: at power-up."""
    ms: Count
    line: Ordinal | None
    """Of the file; null where there is none."""
    ticks: Count
    """How long it lasts there."""


class SightingRow(TypedDict):
    """A finding in one recording."""

    recording: str
    first: OccurrenceRow
    worst: OccurrenceRow
    ticks: Count
    times: Count


class MomentRow(TypedDict):
    """An output in one tick, in words; empty where it is not known."""

    tick: Ordinal
    expected: str
    recorded: str
    differs: Literal["", "here", "other"]
    """``here``: by this finding; ``other``: by another one alone, or as what follows from one."""


class LaneRow(TypedDict):
    """An output over successive ticks."""

    output: str
    moments: list[MomentRow]


class TermsRow(TypedDict):
    """What is on record of a known deviation."""

    reason: str
    owner: str
    until: str | None


class FindingChangeRow(TypedDict):
    """A change of the charts, as a variant holds it."""

    kind: str
    chart: str
    at: str
    old: str
    """What stands there as drawn."""
    new: str
    """What stands there as changed."""
    note: str
    """What else would do: the values that the recordings allow; often empty."""


class CampaignFindingRow(TypedDict):
    """A deviation, a broken property, or that the implementation does not answer."""

    id: str
    system: str
    kind: FindingKind
    word: CampaignWord
    says: str
    evidence: list[LabelledText]
    cause: str
    """The change of the charts that explains it; empty where none was looked for or found."""
    change: FindingChangeRow | None
    """That change; null where there is none, or where an input explains it."""
    other_places: list[FindingChangeRow]
    """The same change in other places, as a limit that two charts have in common."""
    rivals: list[FindingChangeRow]
    """Other changes that explain exactly as much, up to two of those that were tried."""
    first: OccurrenceRow
    worst: OccurrenceRow
    sightings: list[SightingRow]
    timeline: list[LaneRow]
    more_outputs: Count
    """Outputs that differ, too, and have no timeline."""
    no_timeline: str
    """Why there is none, where there might be one."""
    on_record: TermsRow | None
    places: list[PlaceRow]
    """Where to look for it, the best first."""


class CampaignDocument(TypedDict):
    """All that the page of a campaign shows."""

    title: Text
    headline: Text
    charts: str
    notes: list[str]
    recordings: list[RecordingRow]
    findings: list[CampaignFindingRow]
    not_compared: list[GapRow]
    """In no recording."""


def campaign_document(record: CampaignRecord) -> CampaignDocument:
    """The record as JSON."""
    return {
        "title": one_line(record.title),
        "headline": record.headline,
        "charts": record.charts,
        "notes": list(record.notes),
        "recordings": [_recording(r) for r in record.recordings],
        "findings": [_finding(f) for f in record.findings],
        "not_compared": [_gap(one) for one in record.gaps],
    }


def _gap(one: tuple[str, str]) -> GapRow:
    return {"what": one[0], "because": one[1]}


def _recording(one: CampaignRecording) -> RecordingRow:
    return {
        "name": one.name,
        "system": one.system,
        "state": one.state,
        "size": one.size,
        "message": one.message,
        "not_compared": [_gap(gap) for gap in one.gaps],
    }


def _finding(one: CampaignFinding) -> CampaignFindingRow:
    terms = one.terms
    return {
        "id": one.id,
        "system": one.system,
        "kind": one.kind,
        "word": one.word,
        "says": one.says,
        "evidence": [{"label": label, "text": text} for label, text in one.evidence],
        "cause": one.cause,
        "change": _change(*one.change) if one.change else None,
        "other_places": [_change(*change) for change in one.other_places],
        "rivals": [_change(*change) for change in one.rivals],
        "first": _occurrence(one.first),
        "worst": _occurrence(one.worst),
        "sightings": [_sighting(s) for s in one.sightings],
        "timeline": [_lane(lane) for lane in one.lanes],
        "more_outputs": one.more_lanes,
        "no_timeline": one.undrawn,
        "on_record": None
        if terms is None
        else {
            "reason": terms.reason,
            "owner": terms.owner,
            "until": terms.until.isoformat() if terms.until else None,
        },
        "places": [row for place in one.places if (row := place_row(place)) is not None],
    }


def _change(kind: str, chart: str, at: str, old: str, new: str, note: str) -> FindingChangeRow:
    return {"kind": kind, "chart": chart, "at": at, "old": old, "new": new, "note": note}


def _occurrence(one: CampaignOccurrence) -> OccurrenceRow:
    return {
        "recording": one.recording,
        "tick": one.tick,
        "ms": one.ms,
        "line": one.line or None,
        "ticks": one.ticks,
    }


def _sighting(one: CampaignSighting) -> SightingRow:
    return {
        "recording": one.recording,
        "first": _occurrence(one.first),
        "worst": _occurrence(one.worst),
        "ticks": one.ticks,
        "times": one.times,
    }


def _lane(lane: OutputLane) -> LaneRow:
    return {
        "output": lane.output,
        "moments": [
            {
                "tick": m.tick,
                "expected": m.expected,
                "recorded": m.recorded,
                "differs": "here" if m.differs else "other" if m.other else "",
            }
            for m in lane.moments
        ],
    }


__all__ = ["CampaignDocument", "campaign_document"]
