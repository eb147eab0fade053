"""A campaign as one page: recordings x findings, each finding with its evidence and a timeline."""

from collections.abc import Sequence
from importlib.resources import files
from itertools import groupby

from markupsafe import Markup

from rovercheck.checker.io.printable import one_line
from rovercheck.checker.render.page import Part, page, templates
from rovercheck.checker.results.campaign import (
    CampaignFinding,
    CampaignOccurrence,
    CampaignRecord,
    CampaignRecording,
    CampaignWords,
    OutputLane,
    OutputMoment,
)

TEMPLATES = templates("campaign")
COLUMNS = 8
"""Findings side by side in a table."""


def campaign_page(record: CampaignRecord) -> str:
    """The page as HTML that fetches nothing."""
    style = files(__name__).joinpath("campaign.css").read_text(encoding="utf-8")
    body = TEMPLATES.get_template("campaign.html").render(
        record=record,
        words=record.words,
        segments=segments,
        when=when,
        line=one_line,
        unread=UNREAD,
        has_others=has_others,
        state_class=state_class,
        tables=tables,
        in_words=in_words,
        rows=rows,
    )
    return page(one_line(record.title), [Part(Markup(body), (style,))])


def tables(findings: Sequence[CampaignFinding]) -> list[list[tuple[int, CampaignFinding]]]:
    """The findings with their numbers, as the columns of tables that a sheet of paper is wide enough for."""
    numbered = list(enumerate(findings, 1))
    return [numbered[start : start + COLUMNS] for start in range(0, len(numbered), COLUMNS)] or [[]]


def rows(record: CampaignRecord, columns: Sequence[tuple[int, CampaignFinding]]) -> list[CampaignRecording]:
    """The recordings of a table: all of them, or of those that were chosen the ones with a finding of it."""
    if record.of is None:
        return list(record.recordings)
    return [r for r in record.recordings if any(f.sighting(r.name) for _, f in columns)]


def segments(lane: OutputLane, which: str) -> list[tuple[str, int, str]]:
    """Successive ticks with the same text: the text, how many ticks, and how they are marked."""
    told = [(str(getattr(m, which)), _mark(m)) for m in lane.moments]
    return [(text, len(list(group)), mark) for (text, mark), group in groupby(told)]


def in_words(lane: OutputLane, words: CampaignWords) -> list[str]:
    """A lane as text, for paper and small screens, on which no pointer shows what a narrow bar holds."""
    told = [(m.expected or "?", m.recorded or "?") for m in lane.moments]
    found, start = [], 0
    for (expected, recorded), group in groupby(told):
        end = start + len(list(group)) - 1
        first, last = lane.moments[start].tick, lane.moments[end].tick
        start = end + 1
        ticks = f"{words.tick} {first}" if first == last else f"{words.tick}s {first} to {last}"
        same = expected == recorded
        found.append(f"{ticks}: {expected}" if same else f"{ticks}: {expected}, {words.recorded} {recorded}")
    return found


def _mark(moment: OutputMoment) -> str:
    return "differs" if moment.differs else "other" if moment.other else ""


def has_others(finding: CampaignFinding) -> bool:
    """Whether other findings differ in the ticks that are drawn."""
    return any(m.other for lane in finding.lanes for m in lane.moments)


def when(one: CampaignOccurrence, words: CampaignWords) -> str:
    """``tick 61 (1.22 s), line 62``."""
    if not one.tick:
        return "at power-up"
    return f"{words.tick} {one.tick} ({one.ms / 1000:g} s)" + (f", line {one.line}" if one.line else "")


def state_class(state: str) -> str:
    """The state of a recording as the name of a style."""
    return state.replace(" ", "-")


UNREAD = ("not read", "internal error")
"""States of recordings of which nothing is known."""

__all__ = ["UNREAD", "campaign_page", "when"]
