"""Verdicts as SARIF 2.1.0, the format of GitHub's code scanning and of many editors.

Rules are the properties, results what is not simply proved; a counterexample is a code flow along the lines
of the charts at which its transitions are written.
"""

import json
import os
from collections.abc import Iterator, Mapping, Sequence
from hashlib import sha256
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any
from urllib.parse import quote

from rovercheck.checker.render.ci import CiFinding, CiReport, FindingLevel
from rovercheck.checker.render.periods import RepeatedTicks, folded
from rovercheck.checker.render.story import (
    Quiet,
    Repeats,
    StoryChange,
    StoryEvent,
    ending,
    false_parts,
    start_of,
)
from rovercheck.checker.results.trace import Trace
from rovercheck.properties.expected import Acceptance
from rovercheck.properties.hazards import Severity
from rovercheck.spec_model.lang.place import Place

# --- A trace as a code flow of SARIF -------------------------------------------------------------------

LOCATIONS = 1_000
"""Locations of a code flow that GitHub shows (it takes ten times as many)."""

Location = dict[str, Any]


def located(place: Place | None, name: str, message: str = "") -> Location:
    """A location; without a place in a file only the name of what is meant."""
    return {
        **({"physicalLocation": _physical(place)} if place is not None else {}),
        "logicalLocations": [{"fullyQualifiedName": name}],
        **({"message": {"text": message}} if message else {}),
    }


def _physical(place: Place) -> Location:
    path = place.path
    whole = Path(path).is_absolute()
    artifact = (
        {"uri": Path(path).as_uri()} if whole else {"uri": quote(os.fsencode(path)), "uriBaseId": "%SRCROOT%"}
    )
    return {"artifactLocation": artifact, "region": {"startLine": place.line}}


def code_flow(finding: CiFinding) -> tuple[list[Location], str]:
    """The run as the list of its one code flow, and a sentence where steps had to be left out."""
    assert finding.trace is not None
    trace = finding.trace.focused() if finding.trace.property.relevant else finding.trace
    steps = list(_steps(trace, finding))
    if not steps:
        return [], ""
    cut = ""
    if len(steps) > LOCATIONS:
        left, half = len(steps) - LOCATIONS + 1, LOCATIONS // 2
        cut = f"{left:,} of {len(steps):,} steps are left out of the code flow; all: {finding.shown_with}."
        gap = _step(finding.place, finding.id, cut, steps[half]["executionOrder"], {}, "unimportant")
        steps = [*steps[: half - 1], gap, *steps[len(steps) - half :]]
    return [{"message": {"text": finding.text or finding.id}, "threadFlows": [{"locations": steps}]}], cut


def _steps(trace: Trace, finding: CiFinding) -> Iterator[Location]:
    now = 1
    for row in folded(trace):
        match row:
            case StoryEvent():
                now = row.number
                yield from _event(row, finding)
            case Quiet(first, _, _, counters):
                now = first
                yield _step(finding.place, finding.id, row.what, now, _values(counters), "unimportant")
            case RepeatedTicks():
                now = row.first
                yield _step(finding.place, finding.id, row.what, now, _values(row.progress), "unimportant")
            case Repeats(first, _):
                now = first
                yield _step(finding.place, finding.id, row.what, now, {}, "essential")
    if not trace.ticks:
        return
    last = [ending(trace)] if ending(trace) else []
    for part in false_parts(trace):
        state = {name: {"text": shown} for name, shown in part.values}
        text = f"{part.verdict}: {part.name or part.formula}"
        yield _step(finding.place, finding.id, text, len(trace), state, "essential")
    for text in last:
        yield _step(finding.place, finding.id, text, len(trace), {}, "essential")


def _event(event: StoryEvent, finding: CiFinding) -> Iterator[Location]:
    """First what was given and computed, then each transition."""
    when, state = f"tick {event.number}, {event.ms} ms", _values(event.changes)
    given = ", ".join(f"{c} (needed)" if c.needed else str(c) for c in event.changes)
    if given or not event.transitions:
        importance = "essential" if any(c.needed for c in event.changes) else "important"
        yield _step(
            finding.place, finding.id, f"{when}: {given or 'the end'}", event.number, state, importance
        )
    for transition in event.transitions:
        text = f"{when}: {transition.chart}: {start_of(transition)}" + (
            f"  {transition.label}" if transition.label else ""
        )
        name = f"{transition.chart}.{transition.target}"
        yield _step(transition.place or finding.place, name, text, event.number, state)


def _step(
    place: Place | None,
    name: str,
    text: str,
    tick: int,
    state: Mapping[str, Any],
    importance: str = "important",
) -> Location:
    return {
        "location": located(place, name, text),
        "executionOrder": tick,
        "importance": importance,
        **({"state": state} if state else {}),
    }


def _values(changes: tuple[StoryChange, ...]) -> dict[str, dict[str, str]]:
    return {c.name: {"text": c.new} for c in changes}


SCHEMA = "https://docs.oasis-open.org/sarif/sarif/v2.1.0/errata01/os/schemas/sarif-schema-2.1.0.json"
SOURCES = {"%SRCROOT%": {"description": {"text": "The folder with the sources."}}}
RESULTS = 5_000
"""Results that GitHub shows of a file."""
TAGS = 20
"""Tags that GitHub takes of a rule."""
_LEVELS = {
    FindingLevel.REJECTED: "error",
    FindingLevel.FAILED: "error",
    FindingLevel.OPEN: "none",
    FindingLevel.EXPIRED: "warning",
    FindingLevel.KNOWN: "note",
}

RANKS = {
    Severity.CATASTROPHIC: 95.0,
    Severity.CRITICAL: 75.0,
    Severity.MARGINAL: 50.0,
    Severity.UNRATED: 40.0,
    Severity.NEGLIGIBLE: 10.0,
}
"""How important a result is, from 0 to 100; none is given where no hazard is known."""


def sarif(report: CiReport, witnesses: bool = False) -> str:
    """The report as JSON text; with ``witnesses`` also runs that show what is wanted."""
    return json.dumps(document(report, witnesses), indent=1, ensure_ascii=False) + "\n"


def document(report: CiReport, witnesses: bool = False) -> dict[str, Any]:
    """The report as plain lists and dictionaries."""
    rules = sorted(report.findings, key=lambda f: f.id)
    told = [
        f
        for f in report.worst_first()
        if f.level is not FindingLevel.PASSED or (witnesses and f.trace is not None)
    ]
    indices = {f.id: number for number, f in enumerate(rules)}
    run = {
        "tool": {
            "driver": {"name": "rovercheck", "version": tool_version(), "rules": [_rule(f) for f in rules]}
        },
        "automationDetails": {"id": f"rovercheck/{report.variant}"},
        "columnKind": "unicodeCodePoints",
        "originalUriBaseIds": SOURCES,
        "invocations": [_invocation(report, told[RESULTS:])],
        "results": [_result(f, indices[f.id]) for f in told[:RESULTS]],
    }
    return {"$schema": SCHEMA, "version": "2.1.0", "runs": [run]}


def tool_version() -> str:
    try:
        return version("rovercheck")
    except PackageNotFoundError:  # used from its sources
        return "0"


def _invocation(report: CiReport, left_out: Sequence[CiFinding]) -> dict[str, Any]:
    told = [] if report.complete else [("error", report.missing)]
    told += [
        ("warning", f"{f.id} is unknown: {f.evidence}")
        for f in report.findings
        if f.level is FindingLevel.OPEN
    ]
    if left_out:
        all_ = RESULTS + len(left_out)
        told.append(("warning", f"{all_ - RESULTS} of {all_} results are left out: GitHub shows {RESULTS}."))
    notes = [{"level": level, "message": {"text": text}} for level, text in told]
    return {
        "executionSuccessful": report.complete,
        **({"toolExecutionNotifications": notes} if notes else {}),
    }


def _rule(finding: CiFinding) -> dict[str, Any]:
    text = finding.text or finding.id
    help_text = finding.help or text
    tags = list(finding.tags[:TAGS])
    return {
        "id": finding.id,
        "shortDescription": {"text": text},
        "fullDescription": {"text": help_text},
        "help": {"text": f"{help_text}\n\nShow its run, if it has one: {finding.shown_with}"},
        "defaultConfiguration": {"level": "error"},
        **({"properties": {"tags": tags}} if tags else {}),
    }


def _result(finding: CiFinding, index: int) -> dict[str, Any]:
    open_ = finding.level is FindingLevel.OPEN or finding.word == "unknown"
    kind = "open" if open_ else "informational" if finding.level is FindingLevel.PASSED else "fail"
    reason = f" {finding.because}" if finding.because else ""
    decision = f" Decision: {finding.decision}" if finding.lapsed else ""
    shown = f"{finding.evidence[:1].upper()}{finding.evidence[1:]}"
    text = f"{finding.headline}: {finding.says} {shown}.{reason}{decision}"
    key = fingerprint(finding)
    flows, cut = code_flow(finding) if finding.trace is not None else ([], "")
    return {
        "ruleId": finding.id,
        "ruleIndex": index,
        "kind": kind,
        "level": _LEVELS[finding.level] if kind == "fail" else "none",
        "message": {"text": f"{text} {cut}".rstrip()},
        "locations": [located(finding.place, finding.id)],
        "partialFingerprints": {
            "primaryLocationLineHash": f"{key[:16]}:1",  # the one that GitHub reads
            "rovercheckVerdict/v1": key,
        },
        **({"rank": RANKS[finding.severity]} if kind == "fail" and finding.hazard else {}),
        **({"baselineState": _compared(finding)} if finding.recorded else {}),
        **({"suppressions": [_suppression(finding.accepted)]} if _accepted(finding) else {}),
        **({"codeFlows": flows} if flows else {}),
        **({"properties": told} if (told := {**finding.details, **_gravity(finding)}) else {}),
    }


def _gravity(finding: CiFinding) -> dict[str, str]:
    """How bad it is, and since when it is known."""
    since = {"since": finding.since.isoformat()} if finding.since else {}
    return {"severity": finding.severity, "hazard": finding.hazard, **since} if finding.hazard else since


def _accepted(finding: CiFinding) -> bool:
    """Whether somebody lives with it: it is then shown as suppressed, which no expired acceptance does."""
    return finding.level is FindingLevel.KNOWN and finding.accepted is not None


def _suppression(one: Acceptance | None) -> dict[str, Any]:
    """An acceptance as SARIF has it: decided outside of the sources."""
    assert one is not None
    said = {
        "owner": one.owner,
        "on": one.on and one.on.isoformat(),
        "until": one.until and one.until.isoformat(),
    }
    known = {name: value for name, value in said.items() if value}
    return {
        "kind": "external",
        "status": "accepted",
        "justification": one.because,
        **({"properties": known} if known else {}),
    }


def fingerprint(finding: CiFinding) -> str:
    """What makes two results the same one: the property and its verdict, wherever it is written."""
    return sha256(f"{finding.id}\0{finding.word}".encode()).hexdigest()


def _compared(finding: CiFinding) -> str:
    """How the result stands to the expected verdict."""
    if finding.level is FindingLevel.KNOWN or finding.lapsed:
        return "unchanged"
    return "new" if finding.recorded.startswith("proved") else "updated"
