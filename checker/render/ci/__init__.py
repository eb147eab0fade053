"""Verdicts for machines that build and review: what each format is told, whatever the command."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from datetime import date
from enum import StrEnum
from textwrap import wrap

from rovercheck.checker.render import trace_table
from rovercheck.checker.render.waves import outcome
from rovercheck.checker.results.trace import Trace
from rovercheck.properties.expected import Acceptance
from rovercheck.properties.hazards import Severity
from rovercheck.spec_model.lang.place import Place


class FindingLevel(StrEnum):
    """How a verdict counts: as it should be, an expected violation, not decided, or not as it should be."""

    PASSED = "passed"
    KNOWN = "known"
    OPEN = "open"
    FAILED = "failed"
    REJECTED = "rejected"
    """The proof does not hold: a fault of the checker, not of what it checks."""
    EXPIRED = "expired"
    """An expected violation that somebody accepted until a day that is over."""


@dataclass(frozen=True)
class CiFinding:
    """One property as it was decided.

    ``word`` is its verdict, ``recorded`` the expected one (empty if there is no record), ``evidence`` what
    the verdict rests on, and ``because`` the reason in the baseline.  ``help`` says in words what is checked,
    ``tags`` are the requirements, ``details`` what a machine may want to count.  ``effect`` is what goes
    wrong, ``severity`` and ``hazard`` (id and sentence) how bad that is, ``since`` when it became known,
    ``accepted`` who lives with it.
    """

    id: str
    text: str
    system: str
    word: str
    level: FindingLevel
    evidence: str
    recorded: str = ""
    because: str = ""
    help: str = ""
    tags: tuple[str, ...] = ()
    place: Place | None = None
    trace: Trace | None = None
    details: Mapping[str, str] = field(default_factory=dict)
    options: str = ""
    variant: str = ""
    effect: str = ""
    severity: Severity = Severity.UNRATED
    hazard: str = ""
    since: date | None = None
    accepted: Acceptance | None = None
    lapsed: bool = False
    """Whether the time is over for which it was accepted."""

    @property
    def says(self) -> str:
        """What goes wrong, if that is on record, else what should be true."""
        return self.effect or self.text

    @property
    def gravity(self) -> str:
        """How bad it is, in a line; empty where no hazard is known."""
        return f"{self.severity}: {self.hazard}" if self.hazard else ""

    @property
    def decision(self) -> str:
        """What was decided about a violation that is on record, in a line; empty for any other verdict."""
        if self.level is not FindingLevel.KNOWN and not self.lapsed:
            return ""
        if self.accepted is None:
            return "open: nobody has accepted it"
        ended = ", which is over" if self.lapsed else ""
        return f"{' '.join(filter(None, ('accepted', self.accepted.term)))}{ended}: {self.accepted.because}"

    @property
    def headline(self) -> str:
        """The verdict, and what is recorded of it, in one sentence."""
        if self.level is FindingLevel.REJECTED:
            return f"The proof of {self.id} does not hold when it is checked again"
        verdict = " ".join(filter(None, (self.id, "is", self.word, self.variant)))
        if self.lapsed and self.accepted is not None:
            return f"{verdict}, as expected, but was accepted {self.accepted.term} only"
        if self.level is FindingLevel.KNOWN:
            return f"{verdict}, as expected"
        if self.level is FindingLevel.PASSED or not self.recorded:
            return verdict
        return (
            f"{verdict}; as specified it is {self.recorded}"
            if self.variant
            else f"{verdict}; expected: {self.recorded}"
        )

    @property
    def shown_with(self) -> str:
        """The command that shows the run."""
        known = self.trace.again if self.trace is not None else ""
        return known or f"rovercheck trace {self.id}{self.options}"


@dataclass(frozen=True)
class CiReport:
    """What was decided; ``wanted`` counts the properties asked for, more than are here if it ended early.

    ``ended`` says why: an error, in the words of the message; nothing where somebody interrupted it.  It may
    be one that ended nothing, as of an engine that failed where others did not.
    """

    findings: tuple[CiFinding, ...]
    wanted: int
    variant: str = ""
    ended: str = ""

    @property
    def complete(self) -> bool:
        return len(self.findings) >= self.wanted and not self.ended

    @property
    def missing(self) -> str:
        """What was left undecided, and why, in a sentence or two."""
        if len(self.findings) >= self.wanted:
            return self.ended
        counts = f"Incomplete: {len(self.findings)} of {self.wanted} properties were decided."
        return f"{self.ended} {counts}" if self.ended else counts

    @property
    def end(self) -> str:
        """What came before all was decided, or besides, in a word."""
        if len(self.findings) >= self.wanted:
            return "faulty"
        return "stopped" if self.ended else "interrupted"

    def worst_first(self) -> list[CiFinding]:
        """What failed first, then what is open, then what is known; of each kind in the order given."""
        order = [
            FindingLevel.REJECTED,
            FindingLevel.FAILED,
            FindingLevel.OPEN,
            FindingLevel.EXPIRED,
            FindingLevel.KNOWN,
            FindingLevel.PASSED,
        ]
        return sorted(self.findings, key=lambda f: order.index(f.level))


def of_trace(trace: Trace) -> CiReport:
    """The report about the one property of a trace; of a run that is on no record, a violation failed."""
    broken = outcome(trace) == "violated"
    count = len(trace)
    evidence = f"{'counterexample' if broken else 'witness'} of {count} tick{'s' * (count != 1)}"
    one = CiFinding(
        id=trace.property.id or trace.system.name,
        text=trace.property.text,
        system=trace.system.name,
        word="violated" if broken else "proved",
        level=FindingLevel.FAILED if broken else FindingLevel.PASSED,
        evidence=f"{evidence} on {trace.system.name}",
        because=trace.property.because,
        place=trace.property.place,
        trace=trace.with_reason(""),
        details={"ticks": str(count)},
    )
    return CiReport((one,), 1)


def explained(finding: CiFinding) -> str:
    """All that a person wants to read below the headline, in lines of 80 columns."""
    told = [
        finding.says,
        f"Demanded: {finding.text}" if finding.effect else "",
        f"How bad: {finding.gravity}" if finding.gravity and finding.level is not FindingLevel.PASSED else "",
        f"Since: {finding.since}" if finding.since else "",
        f"Why: {finding.because}" if finding.because else "",
        f"Decision: {finding.decision}" if finding.decision else "",
        finding.evidence,
    ]
    lines = [line for text in told for line in wrap(text, 80, break_long_words=False)]
    if finding.trace is not None:
        shown = finding.trace.focused() if finding.trace.property.relevant else finding.trace
        lines += ["", trace_table.render(shown).rstrip("\n"), "", f"Again: {finding.shown_with}"]
    return "\n".join(lines)


def counts(findings: Sequence[CiFinding]) -> str:
    """``400 proved, 93 violated``."""
    words = [f.word.split()[0] for f in findings]
    return ", ".join(f"{words.count(w):,} {w}" for w in ("proved", "violated", "unknown") if w in words)
