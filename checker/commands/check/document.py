"""Verdicts as JSON, as ``rovercheck check --json`` prints them (``checker/schemas/check-1.json``)."""

from collections.abc import Mapping, Sequence
from typing import Literal

from typing_extensions import TypedDict

from rovercheck.checker.commands.check.certificates import outcome
from rovercheck.checker.commands.check.chain_status import ChainStatus
from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.io.document import Count, Text
from rovercheck.checker.render.verdict_text import evidence
from rovercheck.checker.verify.checked import CheckedProperty, length, worst
from rovercheck.checker.verify.finding_order import FindingOrder
from rovercheck.properties.expected import Expected, VerdictWord
from rovercheck.properties.hazards import Severity

Case = Literal["occurs", "never", "unknown"]
CASE: dict[bool | None, Case] = {True: "occurs", False: "never", None: "unknown"}
"""Whether the case occurs that a proof speaks of."""


class ChainRow(TypedDict):
    """What becomes of a chain of the rover's promises across the link."""

    promise: str
    over: str
    """The property across the link that the chain leads to."""
    holds: bool | None
    """Whether every link holds; null if that is not known."""
    failing: list[str]
    """The links that are violated, or else not decided."""


class DecisionRow(TypedDict):
    """Whether somebody lives with a finding."""

    state: Literal["open", "accepted", "expired"]
    """Open as long as nobody does; expired once its last day is over."""
    because: str
    owner: str
    on: str | None
    """The day on which it was decided, such as 2026-03-01."""
    until: str | None
    """The last day on which it is accepted; null without an end."""


class VerdictRow(TypedDict):
    """A property with its verdict."""

    id: Text
    text: str
    """The property in words."""
    requirements: list[str]
    system: str
    """The system that the verdict is about."""
    verdict: VerdictWord
    in_part: bool
    """Proved for some runs only; see the notes of the system."""
    engine: str
    evidence: str
    """What the verdict rests on, in words."""
    ticks: Count | None
    """The length of the run, if it rests on one."""
    expected: VerdictWord
    """The verdict on record."""
    as_expected: bool
    certificate: dict[str, str] | None
    """What checking the proof again gave: its outcome, with who showed it or why it did not succeed."""
    case: Case | None
    """Whether the case occurs that a proof speaks of; null if it speaks of none, or that was not asked."""
    noticed: bool | None
    """Whether a fault of the charts is on record that the proof notices; null if none is looked for, or none
    are kept."""
    because: str
    """The reason on record for an expected violation."""
    effect: str
    """What goes wrong where it is violated, as far as that is on record."""
    hazard: str
    """The hazard of breaking it, by id; empty if none is known."""
    severity: Severity
    """How bad that would be."""
    place: Count | None
    """The place of what is violated, from 1 for the gravest; null for what is not violated."""
    since: str | None
    """The day on which the violation became known, such as 2026-03-01, if it is on record."""
    decision: DecisionRow | None
    """What was decided about a violation that is on record; null for what is expected to be proved."""


class CheckDocument(TypedDict):
    """What ``rovercheck check --json`` prints."""

    schema: Literal["rovercheck/check/1"]
    variant: str
    """How the charts were changed; empty for the charts as specified."""
    complete: bool
    """False if the command was ended before it had decided every property: by Ctrl-C, or by a mistake in the
    model."""
    exit: Exit
    chains: list[ChainRow]
    """What becomes of the chains of the rover's promises across the link; empty where they were not asked
    for."""
    results: list[VerdictRow]


def document(
    found: Sequence[CheckedProperty],
    ended: Exit | None = None,
    faulty: bool = False,
    chains: Sequence[ChainStatus] = (),
    order: FindingOrder | None = None,
) -> CheckDocument:
    """The verdicts as JSON; ``ended`` is the exit code of what ended the command before it was complete.

    ``faulty``: an engine failed, which is an internal error whatever the others found.  ``order`` knows the
    hazards.
    """
    order = order or FindingOrder()
    places = order.places([c for c in found if c.verdict.word == "violated"])
    return {
        "schema": "rovercheck/check/1",
        "variant": found[0].variant if found else "",
        "complete": ended is None,
        "exit": Exit.INTERNAL if faulty else worst(found) if ended is None else ended,
        "chains": [
            {
                "promise": one.promise.id,
                "over": one.chain.across,
                "holds": one.holds,
                "failing": [*one.failing],
            }
            for one in chains
        ],
        "results": [_row(c, order, places) for c in sorted(found, key=lambda c: c.result.property.id)],
    }


def _row(compared: CheckedProperty, order: FindingOrder, places: Mapping[str, int]) -> VerdictRow:
    prop, verdict = compared.result.property, compared.verdict
    hazard, since = order.hazard(compared), compared.expected.since
    return {
        "id": prop.id,
        "text": prop.text,
        "requirements": list(prop.covers),
        "system": compared.result.system,
        "verdict": verdict.word,
        "in_part": compared.result.in_part,
        "engine": verdict.engine,
        "evidence": evidence(compared.result),
        "ticks": length(verdict),
        "expected": compared.expected.verdict,
        "as_expected": compared.as_expected,
        "certificate": outcome(compared.result.certificate),
        "case": None if compared.case is None else CASE[compared.case.occurs],
        "noticed": compared.noticed,
        "because": compared.expected.because,
        "effect": compared.expected.effect,
        "hazard": hazard.id,
        "severity": hazard.severity,
        "place": places[prop.id] + 1 if prop.id in places else None,
        "since": None if since is None else since.isoformat(),
        "decision": decided(compared.expected),
    }


def decided(entry: Expected) -> DecisionRow | None:
    """What was decided about a finding that is on record."""
    if entry.verdict == "proved":
        return None
    one = entry.accepted
    if one is None:
        return {"state": "open", "because": "", "owner": "", "on": None, "until": None}
    return {
        "state": "expired" if one.expired else "accepted",
        "because": one.because,
        "owner": one.owner,
        "on": None if one.on is None else one.on.isoformat(),
        "until": None if one.until is None else one.until.isoformat(),
    }


__all__ = ["document"]
