"""``rovercheck doctor --json``: what was looked at (``checker/schemas/doctor-1.json``)."""

from collections.abc import Sequence
from typing import Literal

from typing_extensions import TypedDict

from rovercheck.checker.commands.doctor.run import DoctorFinding, FindingKind
from rovercheck.checker.io.document import Count


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
    bytes: Count
    """What a package takes on the disk; `rovercheck` with all that it requires.  0 for what is no package."""


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
        "bytes": one.bytes,
    }


__all__ = ["document"]
