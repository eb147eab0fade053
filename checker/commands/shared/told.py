"""What is told of a verdict: one plain record, from which lines, counts and documents are made.

It holds no formula and no run, so that it can be kept and read again without any chart.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Literal

from typing_extensions import TypedDict

from rovercheck.checker.results.exit_code import Exit
from rovercheck.checker.results.gravity import Gravity

if TYPE_CHECKING:
    from rovercheck.checker.verify.checked import CheckedProperty
    from rovercheck.checker.verify.finding_order import FindingOrder
    from rovercheck.properties.expected import Expected

LAST = 3
"""Transitions that are told of a run."""
Word = Literal["proved", "violated", "unknown"]
Severity = Literal["catastrophic", "critical", "marginal", "unrated", "negligible"]
"""How bad a hazard is (``properties.hazards``)."""


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


@dataclass(frozen=True)
class ToldVerdict:
    """A verdict beside the one that is expected, in words.

    ``covers`` are the requirements; ``situation``: it is to be reached, not kept.  ``system`` is what the
    verdict is about.  ``in_part``: only some runs were searched.  ``short`` and
    ``evidence`` say what it rests on, in half a line and in a few words; ``ticks`` is the length of the run.
    ``recorded`` says what is expected.  ``certificate`` is what came of checking the proof again.

    ``occurs``: whether the case occurs that a proof speaks of, where it was ``asked`` for; ``noticed``:
    whether a fault is known that it notices, ``idle`` where that is an omission.  ``code`` is the exit code
    that it leads to, ``strict_code`` where vacuous and idle proofs and lapsed acceptances are errors.
    ``fired`` are the last transitions of a run that was not expected, ``area`` the file of properties that it
    is stated in.

    ``gravity`` orders what is violated, ``headline`` names its hazard.  ``effect`` is what goes wrong, as on
    record, ``says`` the sentence to tell; ``lapsed`` says of an acceptance that is over what it was.
    """

    id: str
    text: str
    covers: tuple[str, ...]
    situation: bool
    on: str
    system: str
    word: Word
    in_part: bool
    engine: str
    short: str
    evidence: str
    ticks: int | None
    expected: Word
    recorded: str
    because: str
    as_expected: bool
    code: Exit
    strict_code: Exit
    gravity: Gravity
    hazard: str
    headline: str
    severity: Severity
    effect: str
    says: str
    since: str | None
    decision: DecisionRow | None
    lapsed: str
    variant: str = ""
    certificate: Mapping[str, str] | None = None
    asked: bool = False
    occurs: bool | None = None
    noticed: bool | None = None
    idle: bool = False
    strict: bool = False
    fired: tuple[str, ...] = ()
    area: str = ""

    @property
    def exit(self) -> Exit:
        """The exit code that this property alone leads to."""
        return self.strict_code if self.strict else self.code

    @property
    def hazards(self) -> bool:
        """Whether a hazard is known."""
        return bool(self.hazard)

    @property
    def empty(self) -> bool:
        """Whether it is a proof of a case that never occurs."""
        return self.asked and self.occurs is False


def told(one: "CheckedProperty", order: "FindingOrder") -> ToldVerdict:
    """What is told of a checked property; ``order`` says how grave it is if it is broken."""
    from rovercheck.checker.commands.check.certificates import outcome
    from rovercheck.checker.render.verdict_text import evidence, in_short, recorded
    from rovercheck.properties.forms import Reachable

    result, prop, hazard = one.result, one.result.property, order.hazard(one)
    since, lapsed = one.expected.since, one.lapsed
    return ToldVerdict(
        prop.id,
        prop.text,
        prop.covers,
        isinstance(prop.form, Reachable),
        prop.on,
        result.system,
        one.verdict.word,
        result.in_part,
        one.verdict.engine,
        in_short(result),
        evidence(result),
        one.length,
        one.expected.verdict,
        recorded(one.expected),
        one.expected.because,
        one.as_expected,
        replace(one, strict=False).code,
        replace(one, strict=True).code,
        order.gravity(one),
        hazard.id,
        f"{', '.join(filter(None, (hazard.severity.value, hazard.id)))}: {hazard.text}",
        hazard.severity.value,
        one.expected.effect,
        _says(one),
        None if since is None else since.isoformat(),
        decided(one.expected),
        "" if lapsed is None else f"{lapsed.term}: {lapsed.because}",
        one.variant,
        outcome(result.certificate),
        one.case is not None,
        None if one.case is None else one.case.occurs,
        one.noticed,
        one.idle,
        one.strict,
        () if one.as_expected else _fired(one),
        prop.area,
    )


def _says(one: "CheckedProperty") -> str:
    """What goes wrong, as far as that is on record, or what should be true."""
    from rovercheck.properties.forms import Reachable

    if one.expected.effect and one.expected.verdict == one.verdict.word and not one.variant:
        return one.expected.effect
    prop = one.result.property
    return f"Cannot be reached: {prop.text}" if isinstance(prop.form, Reachable) else prop.text


def decided(entry: "Expected") -> DecisionRow | None:
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


def _fired(one: "CheckedProperty") -> tuple[str, ...]:
    from rovercheck.checker.results.trace import Trace
    from rovercheck.checker.results.verdict import Unknown

    if isinstance(one.verdict, Unknown) or not isinstance(one.verdict.because, Trace):
        return ()
    fired = [a for t in one.verdict.because.ticks for a in t.transitions if a.order]
    return tuple(map(str, fired[-LAST:]))


def worst(codes: Sequence[Exit]) -> Exit:
    """An internal error outweighs a change, and that an inconclusive search."""
    ranked = (Exit.INTERNAL, Exit.FAILED, Exit.INCONCLUSIVE)
    return next((code for code in ranked if code in codes), Exit.AS_EXPECTED)
