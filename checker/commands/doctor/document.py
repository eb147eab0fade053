"""``rovercheck doctor --json``: what was looked at (``checker/schemas/doctor-1.json``)."""

from collections.abc import Sequence
from typing import Literal

from typing_extensions import TypedDict

from rovercheck.checker.commands.doctor.run import DoctorFinding, FindingKind


class FindingRow(TypedDict):
    """One thing looked at."""

    kind: FindingKind
    name: str
    found: str
    ok: bool
    """Whether it is as needed."""
    required: bool
    """Whether rovercheck needs it to work."""
    adds: str
    """What it is for, or how to get it."""


class DoctorDocument(TypedDict):
    """What ``rovercheck doctor --json`` prints."""

    schema: Literal["rovercheck/doctor/1"]
    ok: bool
    """Nothing that is required is missing or does not work."""
    findings: list[FindingRow]


def document(found: Sequence[DoctorFinding], ok: bool) -> DoctorDocument:
    """All of it for machines."""
    return {"schema": "rovercheck/doctor/1", "ok": ok, "findings": [_row(one) for one in found]}


def _row(one: DoctorFinding) -> FindingRow:
    return {
        "kind": one.kind,
        "name": one.name,
        "found": one.found,
        "ok": one.ok,
        "required": one.required,
        "adds": one.adds,
    }


__all__ = ["document"]
