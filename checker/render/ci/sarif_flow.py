"""A trace as a code flow of SARIF: a location for each thing that happened, where it is written."""

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any
from urllib.parse import quote

from checker.render.ci import CiFinding
from checker.render.story import Quiet, Repeats, StoryChange, StoryEvent, ending, false_parts, rows, start_of
from checker.results.trace import Trace
from spec_model.lang.place import Place

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
    artifact = {"uri": Path(path).as_uri()} if whole else {"uri": quote(path), "uriBaseId": "%SRCROOT%"}
    return {"artifactLocation": artifact, "region": {"startLine": place.line}}


def code_flow(finding: CiFinding) -> tuple[list[Location], str]:
    """The run as the list of its one code flow, and a sentence where steps had to be left out."""
    assert finding.trace is not None
    trace = finding.trace.focused() if finding.trace.relevant else finding.trace
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
    for row in rows(trace):
        match row:
            case StoryEvent():
                now = row.number
                yield from _event(row, finding)
            case Quiet(first, _, _, counters):
                now = first
                yield _step(finding.place, finding.id, row.what, now, _values(counters), "unimportant")
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
    """First what was given and computed, then each arrow."""
    when, state = f"tick {event.number}, {event.ms} ms", _values(event.changes)
    given = ", ".join(f"{c} (needed)" if c.needed else str(c) for c in event.changes)
    if given or not event.arrows:
        importance = "essential" if any(c.needed for c in event.changes) else "important"
        yield _step(
            finding.place, finding.id, f"{when}: {given or 'the end'}", event.number, state, importance
        )
    for arrow in event.arrows:
        text = f"{when}: {arrow.chart}: {start_of(arrow)}" + (f"  {arrow.label}" if arrow.label else "")
        name = f"{arrow.chart}.{arrow.target}"
        yield _step(arrow.place or finding.place, name, text, event.number, state)


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
