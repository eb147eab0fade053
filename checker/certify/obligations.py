"""What has to be shown for an invariant to prove a claim: each obligation is an SMT-LIB script.

A script asks for a counterexample, so the obligation is met if and only if it is unsatisfiable:

    initiation   some state before the first tick breaks the invariant
    consecution  some tick leads from the invariant to a state that breaks it
    domains      some tick from the invariant gives a variable a value outside its domain
    safety       some tick from the invariant makes a claimed goal true

and for k-induction (Sheeran, Singh, Stålmarck, *Checking safety properties using induction and a SAT-solver*,
FMCAD 2000), instead of the last one, for each claim:

    base         some run makes it true within k - 1 ticks
    step         k ticks from the invariant make it true for the first time in the last of them
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations

from rovercheck.checker.certify.invariant import Conjuncts, Invariant, holds
from rovercheck.checker.certify.question import CertifyQuestion
from rovercheck.checker.certify.smtlib import joined, own, quoted

LONGEST = 1 << 30
"""Characters of a script above which it is not written."""


@dataclass(frozen=True)
class Obligation:
    """A name, the script that must be unsatisfiable, and how many ticks it speaks of."""

    name: str
    script: str
    ticks: int


def obligations(question: CertifyQuestion, invariant: Invariant) -> Iterator[Obligation]:
    """All obligations of a certificate."""
    valuation, first = question.valuation(), question.one_tick(0)
    here, there = holds(invariant, question, 0), holds(invariant, question, 1)
    start = [*valuation, *question.initial(), *here]
    yield _obligation("initiation", 0, start, _all(own("init", 0)), f"(not {own('invariant', 0)})")
    tick = [*valuation, *first, *here]
    before = _all(own("invariant", 0), own("assume", 0))
    broken = f"(not {own('invariant', 1)})"
    yield _obligation("consecution", 1, [*tick, *there], before, broken)
    yield _obligation("domains", 1, tick, before, f"(not {own('stays', 0)})")
    if isinstance(invariant, Conjuncts) and invariant.ticks > 1:
        for claim in question.claims:
            yield from _induction(question, invariant, claim)
    else:
        reached = joined("or", [quoted(claim, 1) for claim in question.claims])
        yield _obligation("safety", 1, tick, before, reached)


def too_long(question: CertifyQuestion, invariant: Invariant) -> bool:
    """Whether the number of ticks is out of all reason: a file may say anything."""
    if not isinstance(invariant, Conjuncts):
        return False
    pairs = invariant.ticks**2 // 2 if invariant.simple else 0
    apart = sum(2 * len(v.name) + 20 for v in question.tick.variables)
    return invariant.ticks * len(question.text) + pairs * apart > LONGEST


def _induction(question: CertifyQuestion, invariant: Conjuncts, claim: str) -> Iterator[Obligation]:
    k = invariant.ticks
    ticks = [line for at in range(k) for line in question.one_tick(at)]
    start = [*question.valuation(), *question.initial(), *ticks]
    reached = "false"
    for at in reversed(range(k - 1)):
        reached = f"(and {own('assume', at)} (or {quoted(claim, at + 1)} {reached}))"
    yield _obligation(f"base of {claim}", k - 1, start, _all(own("init", 0)), reached)
    lines = [*question.valuation(), *ticks, *holds(invariant, question, 0)]
    assumed = [own("assume", at) for at in range(k)]
    spared = [f"(not {quoted(claim, at)})" for at in range(1, k)]
    apart = _apart(question, k) if invariant.simple else []
    before = _all(own("invariant", 0), *assumed, *spared, *apart)
    yield _obligation(f"step of {claim}", k, lines, before, quoted(claim, k))


def _apart(question: CertifyQuestion, k: int) -> list[str]:
    """No two of the states before the k ticks are the same."""
    names = [v.name for v in question.tick.variables]
    return [
        joined("or", [f"(distinct {quoted(n, a)} {quoted(n, b)})" for n in names])
        for a, b in combinations(range(k), 2)
    ]


def _all(*parts: str) -> list[str]:
    return [own("domain", 0), *parts]


def _obligation(
    name: str, ticks: int, lines: Sequence[str], before: Sequence[str], broken: str
) -> Obligation:
    asserted = [f"(assert {part})" for part in (*before, broken)]
    script = "\n".join(["(set-logic QF_BV)", *lines, *asserted, "(check-sat)", ""])
    return Obligation(name, script, ticks)
