"""What is told of a verdict: one plain record, from which lines, counts and documents are made.

It holds no formula and no run, so that it can be kept and read again without any chart.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Literal

from rovercheck.checker.results.exit_code import Exit

if TYPE_CHECKING:
    from rovercheck.checker.verify.checked import CheckedProperty
    from rovercheck.spec_model.lang.system import System

LAST = 3
"""Transitions that are told of a run."""
Word = Literal["proved", "violated", "unknown"]


@dataclass(frozen=True)
class ToldVerdict:
    """A verdict beside the one that is expected, in words.

    ``covers`` are the requirements; ``situation``: it is to be reached, not kept.  ``system`` is what the
    verdict is about, with so many ``charts``.  ``in_part``: only some runs were searched.  ``short`` and
    ``evidence`` say what it rests on, in half a line and in a few words; ``ticks`` is the length of the run.
    ``recorded`` says what is expected.  ``certificate`` is what came of checking the proof again.

    ``occurs``: whether the case occurs that a proof speaks of, where it was ``asked`` for; ``noticed``:
    whether a fault is known that it notices, ``idle`` where that is an omission.  ``code`` is the exit code
    that it leads to, ``strict_code`` where vacuous and idle proofs are errors.  ``fired`` are the last
    transitions of a run that was not expected, ``area`` the file of properties that it is stated in.
    """

    id: str
    text: str
    covers: tuple[str, ...]
    situation: bool
    on: str
    system: str
    charts: int
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
    def empty(self) -> bool:
        """Whether it is a proof of a case that never occurs."""
        return self.asked and self.occurs is False


def told(one: "CheckedProperty", systems: Mapping[str, "System"]) -> ToldVerdict:
    """What is told of a checked property."""
    from rovercheck.checker.commands.check.certificates import outcome
    from rovercheck.checker.render.verdict_text import evidence, in_short, recorded
    from rovercheck.properties.forms import Reachable

    result, prop = one.result, one.result.property
    return ToldVerdict(
        prop.id,
        prop.text,
        prop.covers,
        isinstance(prop.form, Reachable),
        prop.on,
        result.system,
        len(systems[result.system].charts) if result.system in systems else 0,
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
