"""Verdicts as JSON, as ``rovercheck check --json`` prints them (``checker/schemas/check-1.json``)."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

from rovercheck.checker.commands.check.certificates import outcome
from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.render.verdict_text import evidence
from rovercheck.checker.verify.checked import CheckedProperty, length, worst

if TYPE_CHECKING:
    from rovercheck.checker.commands.check.chain_status import ChainStatus

SCHEMA = 1
CASE = {True: "occurs", False: "never", None: "unknown"}
"""Whether the case occurs that a proof speaks of."""


def document(
    found: Sequence[CheckedProperty],
    ended: Exit | None = None,
    faulty: bool = False,
    chains: Sequence["ChainStatus"] = (),
) -> dict[str, object]:
    """The verdicts as JSON; ``ended`` is the exit code of what ended the command before it was complete.

    ``faulty``: an engine failed, which is an internal error whatever the others found.
    """
    code = Exit.INTERNAL if faulty else worst(found) if ended is None else ended
    return {
        "schema": f"rovercheck/check/{SCHEMA}",
        "variant": found[0].variant if found else "",
        "complete": ended is None,
        "exit": int(code),
        "chains": [
            {
                "promise": one.promise.id,
                "over": one.chain.across,
                "holds": one.holds,
                "failing": [*one.failing],
            }
            for one in chains
        ],
        "results": [_row(c) for c in sorted(found, key=lambda c: c.result.property.id)],
    }


def _row(compared: CheckedProperty) -> dict[str, object]:
    prop, verdict = compared.result.property, compared.verdict
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
    }


__all__ = ["document"]
