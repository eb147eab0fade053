"""A campaign as Markdown, for a pull request or an issue."""

import re
from collections.abc import Iterator

from rovercheck.checker.io.printable import one_line
from rovercheck.checker.render.campaign import UNREAD, when
from rovercheck.checker.results.campaign import CampaignRecord


def campaign_markdown(record: CampaignRecord) -> str:
    """The campaign as text of Markdown; nothing that was read can become markup."""
    return "\n".join(_lines(record)) + "\n"


def _lines(record: CampaignRecord) -> Iterator[str]:
    words = record.words
    yield f"# {_plain(record.title)}"
    yield ""
    yield f"{_plain(record.headline)}."
    yield from (f"\n{_plain(note)}" for note in record.notes)
    if record.charts:
        yield f"\nCharts: {_plain(record.charts)}."
    heads = [record.words.one, "result", *(f"#{k}" for k in range(1, len(record.findings) + 1))]
    yield ""
    yield f"| {' | '.join(heads)} |"
    yield f"|{'---|' * len(heads)}"
    for one in record.recordings:
        met = [f.sighting(one.name) for f in record.findings]
        unread = "?" if one.state in UNREAD else "–"
        cells = [f"{s.ticks:,} from {s.first.ms / 1000:g} s" if s else unread for s in met]
        yield f"| {' | '.join([_plain(one.name), one.state, *cells])} |"
    for number, f in enumerate(record.findings, 1):
        yield ""
        yield f"## {number}. {_plain(f.says)} ({f.word})"
        yield ""
        if f.cause:
            yield f"- cause: {_plain(f.cause)}"
        if f.terms:
            until = f"until {f.terms.until}" if f.terms.until else ""
            terms = "; ".join(filter(None, (f.terms.reason or "no reason given", f.terms.owner, until)))
            yield f"- on record: {_plain(terms)}"
        for label, text in f.evidence:
            yield f"- {label}: {_plain(text)}"
        yield f"- first: {_plain(f.first.recording)}: {when(f.first, words)}"
        if f.worst.ticks:
            worst = f"{words.ticks(f.worst.ticks)} from {when(f.worst, words)}"
            yield f"- worst: {_plain(f.worst.recording)}: {worst}"
        if record.of and f.places:
            yield f"- see: {_plain(', '.join(map(str, f.places)))}"
        if f.undrawn:
            yield f"- No timeline: {_plain(f.undrawn)}"
    gaps = [r for r in record.recordings if r.gaps or r.message]
    if gaps or record.gaps:
        yield "\n## What was not compared, and why\n"
    for what, why in record.gaps:
        yield f"- {_plain(f'{what}: {why}')}"
    for one in gaps:
        told = [("", one.message)] if one.message else []
        for what, why in (*told, *one.gaps):
            yield f"- {_plain(one.name)}: {_plain(f'{what}: {why}' if what else f'{one.state}: {why}')}"


def _plain(text: str) -> str:
    """A text that is no markup: with what means something escaped."""
    escaped = re.sub(r"([\\`*_{}\[\]<>#|~@])", r"\\\1", one_line(text))
    return escaped.replace("\\<", "&lt;").replace("\\>", "&gt;")


__all__ = ["campaign_markdown"]
