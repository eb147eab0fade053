"""``rovercheck requirements --json``: the matrix for machines (``checker/schemas/requirements-1.json``)."""

from collections.abc import Mapping, Sequence
from typing import Literal

from typing_extensions import TypedDict

from rovercheck.checker.commands.requirements.run import Verdicts
from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.io.document import Text
from rovercheck.properties.coverage import RequirementCoverage
from rovercheck.properties.forms import Reachable
from rovercheck.properties.hazards import Hazard, Severity, gravest_of


class CoveringRow(TypedDict):
    """A property that speaks of a requirement."""

    id: Text
    verdict: str
    covers: bool
    """False where it only shows that a situation is reached."""


class RequirementStatus(TypedDict):
    """A requirement, and what is known of it."""

    id: Text
    text: str
    source: str
    """A section, table or figure of the document."""
    bounds: str
    kind: str
    checkable: str
    state: str
    """The gravest verdict of what covers it; or that there is a reason instead, or nothing."""
    reason: str
    """Why no property covers it."""
    properties: list[CoveringRow]
    """The gravest first, of one severity in the order of the model."""
    hazards: list[str]
    """What may come of breaking it, by id, the gravest first."""
    severity: Severity
    """How bad that would be."""


class RequirementsDocument(TypedDict):
    """What ``rovercheck requirements --json`` prints."""

    schema: Literal["rovercheck/requirements/1"]
    verdicts: str
    """Where the verdicts are from."""
    exit: Exit
    requirements: list[RequirementStatus]


def document(
    rows: Sequence[RequirementCoverage],
    verdicts: Verdicts,
    origin: str,
    code: Exit,
    hazards: Mapping[str, Hazard],
) -> RequirementsDocument:
    """The matrix as JSON."""
    return {
        "schema": "rovercheck/requirements/1",
        "verdicts": origin,
        "exit": code,
        "requirements": [_row(row, verdicts, hazards) for row in rows],
    }


def _row(row: RequirementCoverage, verdicts: Verdicts, hazards: Mapping[str, Hazard]) -> RequirementStatus:
    item = row.requirement
    own = [one for one in hazards.values() if item.id in one.requirements]
    return {
        "id": item.id,
        "text": item.text,
        "source": item.source,
        "bounds": item.bounds,
        "kind": item.kind,
        "checkable": item.checkable,
        "state": row.state(verdicts),
        "reason": item.reason,
        "properties": [
            {"id": p.id, "verdict": verdicts[p.id], "covers": not isinstance(p.form, Reachable)}
            for p in row.properties
        ],
        "hazards": [one.id for one in own],
        "severity": gravest_of([item.id], hazards).severity,
    }


__all__ = ["document"]
