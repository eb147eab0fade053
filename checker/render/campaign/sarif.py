"""A campaign as SARIF 2.1.0, for code scanning and editors: a result for each finding.

A result is an error unless it is known, which makes it a suppressed note; an acceptance that has expired is
a warning.  Its fingerprint is that of the deviation, wherever and whenever it is met.
"""

import json
from collections.abc import Iterator, Mapping
from hashlib import sha256
from typing import Any

from rovercheck.checker.io.printable import one_line
from rovercheck.checker.render.campaign import UNREAD, when
from rovercheck.checker.render.ci.sarif import RESULTS, SCHEMA, SOURCES, located, tool_version
from rovercheck.checker.results.campaign import (
    CampaignFinding,
    CampaignRecord,
    CampaignWord,
    FindingKind,
    KnownTerms,
)

RULES: Mapping[FindingKind, tuple[str, str]] = {
    "deviation": ("deviation", "Outputs are what the charts require."),
    "property": ("broken-property", "Properties that are expected to hold do so in what was recorded."),
    "failure": ("no-answer", "The implementation answers in every step."),
}
"""The id of the rule that a finding breaks, and what the rule demands."""
LEVELS: Mapping[CampaignWord, str] = {
    "new": "error",
    "changed": "error",
    "unexpected": "error",
    "expired": "warning",
    "known": "note",
}


def campaign_sarif(record: CampaignRecord) -> str:
    """The campaign as JSON text."""
    return json.dumps(_document(record), indent=1, ensure_ascii=False) + "\n"


def _document(record: CampaignRecord) -> dict[str, Any]:
    rules = [
        {"id": id, "shortDescription": {"text": text}, "defaultConfiguration": {"level": "error"}}
        for id, text in RULES.values()
    ]
    run = {
        "tool": {"driver": {"name": "rovercheck", "version": tool_version(), "rules": rules}},
        "automationDetails": {"id": f"rovercheck/{record.words.many}/{one_line(record.title)}"},
        "columnKind": "unicodeCodePoints",
        "originalUriBaseIds": SOURCES,
        "invocations": [_invocation(record)],
        "results": [_result(f, record) for f in record.findings[:RESULTS]],
    }
    return {"$schema": SCHEMA, "version": "2.1.0", "runs": [run]}


def _invocation(record: CampaignRecord) -> dict[str, Any]:
    notes = [{"level": level, "message": {"text": one_line(text)}} for level, text in _notifications(record)]
    return {
        "executionSuccessful": not any(r.state in UNREAD for r in record.recordings),
        **({"toolExecutionNotifications": notes} if notes else {}),
    }


def _notifications(record: CampaignRecord) -> Iterator[tuple[str, str]]:
    """What was not compared, and why."""
    for r in record.recordings:
        if r.state in UNREAD:
            yield "error", f"{r.name}: {r.state}: {r.message}"
        elif r.message:
            yield "warning", f"{r.name}: {r.message}"
        for what, why in r.gaps:
            yield "note", f"{r.name}: not compared: {what}: {why}"
    for what, why in record.gaps:
        yield "note", f"Not compared: {what}: {why}"
    if (left := len(record.findings) - RESULTS) > 0:
        yield "warning", f"{left} of {len(record.findings)} results are left out: GitHub shows {RESULTS}."


def _result(finding: CampaignFinding, record: CampaignRecord) -> dict[str, Any]:
    rule, _ = RULES[finding.kind]
    key = sha256((finding.key or finding.id).encode(errors="backslashreplace")).hexdigest()
    places: tuple[Any, ...] = finding.places or (None,)
    others = [{"id": n, **located(place, finding.id)} for n, place in enumerate(places[1:], 1)]
    known = finding.word == "known"
    return {
        "ruleId": rule,
        "ruleIndex": [id for id, _ in RULES.values()].index(rule),
        "kind": "fail",
        "level": LEVELS[finding.word],
        "message": {"text": " ".join(_message(finding, record))},
        "locations": [located(places[0], finding.id)],
        **({"relatedLocations": others} if others else {}),
        "partialFingerprints": {
            "primaryLocationLineHash": f"{key[:16]}:1",  # the one that GitHub reads
            "rovercheckFinding/v1": key,
        },
        **({"suppressions": [_suppression(finding.terms or KnownTerms())]} if known else {}),
        "properties": {"id": finding.id, "word": finding.word, "system": finding.system},
    }


def _message(finding: CampaignFinding, record: CampaignRecord) -> Iterator[str]:
    words = record.words
    yield f"{one_line(finding.says).rstrip('.')}."
    yield f"First in {one_line(finding.first.recording)}, {when(finding.first, words)}."
    if finding.worst.ticks > 1:
        worst = one_line(finding.worst.recording)
        yield f"Longest in {worst}: {words.ticks(finding.worst.ticks)} from {when(finding.worst, words)}."
    if finding.cause:
        yield f"Cause: {one_line(finding.cause)}."
    if finding.word in ("expired", "changed"):
        yield f"It is on record as {finding.id}, {finding.word}."


def _suppression(terms: KnownTerms) -> dict[str, Any]:
    """A known deviation as SARIF has it: accepted outside of the sources."""
    said = {"owner": terms.owner, "until": terms.until and terms.until.isoformat()}
    kept = {name: value for name, value in said.items() if value}
    return {
        "kind": "external",
        "status": "accepted",
        **({"justification": one_line(terms.reason)} if terms.reason else {}),
        **({"properties": kept} if kept else {}),
    }


__all__ = ["campaign_sarif"]
