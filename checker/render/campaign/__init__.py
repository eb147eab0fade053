"""A campaign as one page: recordings x findings, each finding with its evidence and a timeline."""

from importlib.resources import files
from itertools import groupby

from markupsafe import Markup

from rovercheck.checker.io.printable import one_line
from rovercheck.checker.render.page import Part, page, templates
from rovercheck.checker.results.campaign import CampaignOccurrence, CampaignRecord, OutputLane

TEMPLATES = templates("campaign")


def campaign_page(record: CampaignRecord) -> str:
    """The page as HTML that fetches nothing."""
    style = files(__name__).joinpath("campaign.css").read_text(encoding="utf-8")
    body = TEMPLATES.get_template("campaign.html").render(
        record=record, segments=segments, when=when, line=one_line
    )
    return page(one_line(record.title), [Part(Markup(body), (style,))])


def segments(lane: OutputLane, which: str) -> list[tuple[str, int, bool]]:
    """Successive ticks with the same text: the text, how many ticks, and whether they differ."""
    told = [(str(getattr(m, which)), m.differs) for m in lane.moments]
    return [(text, len(list(group)), differs) for (text, differs), group in groupby(told)]


def when(one: CampaignOccurrence) -> str:
    """``tick 61 (1.22 s), line 62``."""
    return f"tick {one.tick} ({one.ms / 1000:g} s), line {one.line}"


__all__ = ["campaign_page"]
