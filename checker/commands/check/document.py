"""Verdicts as JSON, as ``rovercheck check --json`` prints them (``checker/schemas/check-1.json``)."""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Literal

from typing_extensions import TypedDict

from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.commands.shared.told import DecisionRow, Severity, ToldVerdict, Word, worst
from rovercheck.checker.io.document import Count, Text
from rovercheck.checker.results.gravity import gravest_first

if TYPE_CHECKING:
    from rovercheck.checker.commands.check.chain_status import ChainStatus

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


class VerdictRow(TypedDict):
    """A property with its verdict."""

    id: Text
    text: str
    """The property in words."""
    requirements: list[str]
    system: str
    """The system that the verdict is about."""
    verdict: Word
    in_part: bool
    """Proved for some runs only; see the notes of the system."""
    engine: str
    evidence: str
    """What the verdict rests on, in words."""
    ticks: Count | None
    """The length of the run, if it rests on one."""
    expected: Word
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
    found: Sequence[ToldVerdict],
    ended: Exit | None = None,
    faulty: bool = False,
    chains: Sequence["ChainStatus"] = (),
) -> CheckDocument:
    """The verdicts as JSON; ``ended`` is the exit code of what ended the command before it was complete.

    ``faulty``: an engine failed, which is an internal error whatever the others found.
    """
    broken = gravest_first([one for one in found if one.word == "violated"], lambda one: one.gravity)
    places = {one.id: place for place, one in enumerate(broken, 1)}
    return {
        "schema": "rovercheck/check/1",
        "variant": found[0].variant if found else "",
        "complete": ended is None,
        "exit": Exit.INTERNAL if faulty else worst([c.exit for c in found]) if ended is None else ended,
        "chains": [
            {
                "promise": one.promise.id,
                "over": one.chain.across,
                "holds": one.holds,
                "failing": [*one.failing],
            }
            for one in chains
        ],
        "results": [_row(c, places) for c in sorted(found, key=lambda c: c.id)],
    }


def _row(one: ToldVerdict, places: Mapping[str, int]) -> VerdictRow:
    return {
        "id": one.id,
        "text": one.text,
        "requirements": list(one.covers),
        "system": one.system,
        "verdict": one.word,
        "in_part": one.in_part,
        "engine": one.engine,
        "evidence": one.evidence,
        "ticks": one.ticks,
        "expected": one.expected,
        "as_expected": one.as_expected,
        "certificate": None if one.certificate is None else dict(one.certificate),
        "case": CASE[one.occurs] if one.asked else None,
        "noticed": one.noticed,
        "because": one.because,
        "effect": one.effect,
        "hazard": one.hazard,
        "severity": one.severity,
        "place": places.get(one.id),
        "since": one.since,
        "decision": one.decision,
    }


__all__ = ["document"]
