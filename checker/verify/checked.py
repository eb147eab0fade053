"""Checked properties: a verdict beside the one that is expected, which every output shows."""

from collections.abc import Sequence
from dataclasses import dataclass

from rovercheck.checker.certify.outcome import Rejected
from rovercheck.checker.model.kept_runs import KeptRun
from rovercheck.checker.results.exit_code import Exit
from rovercheck.checker.results.trace import Trace
from rovercheck.checker.results.verdict import Proved, StoredRun, Unknown, Verdict, Violated
from rovercheck.checker.verify.result import Result
from rovercheck.properties.expected import Acceptance, Expected


@dataclass(frozen=True)
class PremiseCase:
    """Whether the case occurs of which a proof speaks (None: not known), and what shows it, in words."""

    occurs: bool | None
    said: str
    kept: KeptRun | None = None


@dataclass(frozen=True)
class CheckedProperty:
    """A result beside the expected verdict; ``variant`` says how the charts differ from those specified.

    ``case``: whether the case occurs that a proof speaks of, ``noticed``: whether a fault is known that it
    notices, each if that was asked.  With ``strict``, a proof of a case that never occurs is not enough, nor
    one that notices no known fault, nor a finding that is no longer accepted.
    """

    result: Result
    expected: Expected
    variant: str = ""
    case: PremiseCase | None = None
    noticed: bool | None = None
    strict: bool = False

    @property
    def verdict(self) -> Verdict:
        return self.result.verdict

    @property
    def word(self) -> str:
        """The verdict for people; ``proved for a restricted model`` if that has only some of the runs."""
        said = f"{self.verdict.word} for a restricted model" if self.result.in_part else self.verdict.word
        return f"{said}, vacuously" if self.empty else said

    @property
    def empty(self) -> bool:
        """Whether it is a proof of a case that never occurs."""
        return self.case is not None and self.case.occurs is False

    @property
    def idle(self) -> bool:
        """Whether it is a proof that notices no known fault, and the baseline does not say why."""
        return self.noticed is False and not self.expected.no_fault

    @property
    def lapsed(self) -> Acceptance | None:
        """The acceptance of a finding that is as expected, if its time is over."""
        return self.expected.expired if self.as_expected and not self.variant else None

    @property
    def as_expected(self) -> bool:
        """Same verdict, and for a recorded counterexample the same length."""
        if self.verdict.word != self.expected.verdict:
            return False
        depth = None if self.variant else self.expected.depth
        return depth is None or not isinstance(self.verdict, Violated) or self.length == depth

    @property
    def length(self) -> int | None:
        """The number of ticks of the run that the verdict rests on, if it rests on one."""
        return length(self.verdict)

    @property
    def code(self) -> Exit:
        """The exit code that this property alone leads to."""
        if isinstance(self.result.certificate, Rejected):
            return Exit.INTERNAL
        if self.strict and self.case is not None and not self.case.occurs:
            return Exit.FAILED if self.empty else Exit.INCONCLUSIVE
        if self.strict and self.idle and not self.variant:
            return Exit.INCONCLUSIVE
        if self.strict and self.lapsed is not None:
            return Exit.FAILED
        if self.as_expected or (self.variant and isinstance(self.verdict, Proved)):
            return Exit.AS_EXPECTED
        return Exit.INCONCLUSIVE if isinstance(self.verdict, Unknown) else Exit.FAILED


def length(verdict: Verdict) -> int | None:
    """The number of ticks of the trace a verdict rests on, if it rests on one."""
    because = None if isinstance(verdict, Unknown) else verdict.because
    return len(because) if isinstance(because, Trace | StoredRun) else None


def worst(found: Sequence[CheckedProperty]) -> Exit:
    """An internal error outweighs a change, and that an inconclusive search."""
    codes = {c.code for c in found}
    for code in (Exit.INTERNAL, Exit.FAILED, Exit.INCONCLUSIVE):
        if code in codes:
            return code
    return Exit.AS_EXPECTED
