"""``rovercheck certify --json``: what came of each certificate (``checker/schemas/certify-1.json``)."""

from collections.abc import Sequence
from typing import Literal

from typing_extensions import TypedDict

from rovercheck.checker.certify.outcome import Accepted, Rejected, Undecided
from rovercheck.checker.commands.certify.derive import DerivedVerdict
from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.io.document import Count, Text


class CertificateRow(TypedDict):
    """A property that a file proves."""

    id: Text
    file: Text
    """The file of certificates, as it was named."""


class AcceptedCertificate(CertificateRow):
    """A proof whose every obligation is met."""

    outcome: Literal["accepted"]
    verdict: str
    """What was derived: proved of relay."""
    how: str
    """Who showed every obligation."""


class RejectedCertificate(CertificateRow):
    """A certificate that proves nothing."""

    outcome: Literal["rejected"]
    verdict: str
    """Empty."""
    obligation: str
    """The obligation that is not met."""
    shown: str
    """What shows that."""


class UndecidedCertificate(CertificateRow):
    """Neither could be shown."""

    outcome: Literal["undecided"]
    verdict: str
    """Empty."""
    reason: str


class CertifyDocument(TypedDict):
    """What ``rovercheck certify --json`` prints."""

    schema: Literal["rovercheck/certify/1"]
    exit: Exit
    files: Count
    """Files of certificates that were read."""
    properties: list[AcceptedCertificate | RejectedCertificate | UndecidedCertificate]


def document(found: Sequence[DerivedVerdict], count: int, code: Exit) -> CertifyDocument:
    """All of it for machines; ``count`` files were read."""
    told = sorted(found, key=lambda one: (one.id, one.file))
    return {
        "schema": "rovercheck/certify/1",
        "exit": code,
        "files": count,
        "properties": [_row(one) for one in told],
    }


def _row(one: DerivedVerdict) -> AcceptedCertificate | RejectedCertificate | UndecidedCertificate:
    row: CertificateRow = {"id": one.id, "file": one.file}
    match one.outcome:
        case Accepted(how):
            return {**row, "outcome": "accepted", "verdict": one.verdict, "how": how}
        case Rejected(obligation, shown):
            said = one.verdict
            return {**row, "outcome": "rejected", "verdict": said, "obligation": obligation, "shown": shown}
        case Undecided(reason):
            return {**row, "outcome": "undecided", "verdict": one.verdict, "reason": reason}


__all__ = ["document"]
