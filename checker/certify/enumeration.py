"""Checking by plain enumeration: every state of the invariant, every input, the reference semantics.

Slow and obvious.  The system is run as it is: neither slicing nor the formulas of a tick are trusted.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from itertools import product
from math import prod

from rovercheck.checker.certify.diagram import CertifiedDiagram, count, members
from rovercheck.checker.certify.invariant import Conjuncts, Invariant
from rovercheck.checker.certify.outcome import Accepted, Rejected, TooMuch, assignment_text
from rovercheck.checker.certify.question import CertifyQuestion
from rovercheck.checker.certify.smtlib import width
from rovercheck.checker.certify.terms import Value, definitions, evaluate
from rovercheck.checker.certify.tick import conjuncts
from rovercheck.spec_model.lang.domain import Bool
from rovercheck.spec_model.lang.evaluate import evaluate as value_of
from rovercheck.spec_model.lang.evaluate import step
from rovercheck.spec_model.lang.expr import Var
from rovercheck.spec_model.lang.system import TransitionSystem
from rovercheck.spec_model.lang.walk import nodes, variables

MOST = 4_000_000
"""Nodes of formulas that are evaluated at most: a few seconds."""

Valuation = Mapping[str, int]
Member = Callable[[Valuation], bool]


Tried = Accepted | Rejected | TooMuch


def enumerated(system: TransitionSystem, asked: CertifyQuestion, invariant: Invariant) -> Tried:
    """Whether the invariant meets its obligations, shown by trying all there is."""
    if isinstance(invariant, Conjuncts) and invariant.ticks > 1:
        return TooMuch("the enumeration tries single ticks, not k-induction")
    ticks = _size(asked, invariant) * _choices(asked.tick.inputs)
    work = (ticks + _choices(asked.tick.frozen)) * sum(1 for _ in nodes(*asked.tick.next.values()))
    if work > MOST:
        return TooMuch(f"about {ticks:,} ticks are too many to try one by one")
    member = _member(asked, invariant)
    for frozen in _vectors(asked.tick.frozen):
        initial = {v.name: v.init for v in asked.tick.variables} | frozen
        if not member(initial):
            return Rejected("initiation", assignment_text(asked.state, initial))
    tried = 0
    for before in filter(member, _valuations(asked, invariant)):
        for inputs in _vectors(asked.tick.inputs):
            tried += 1
            broken = _broken(system, asked, member, before, inputs)
            if broken is not None:
                return broken
    return Accepted(f"{tried:,} ticks tried")


def _broken(
    system: TransitionSystem, asked: CertifyQuestion, member: Member, before: Valuation, inputs: Valuation
) -> Rejected | None:
    """What is wrong with a tick.  What is outside the question has any value: it does not matter."""
    at = {v.name: v.init for v in (*system.variables, *system.frozen)} | dict(before)
    given = {v.name: v.domain.low for v in system.inputs} | dict(inputs)
    assume = conjuncts(system.assume)
    if not all(value_of(assume[i], {**at, **given}) for i in asked.kept):
        return None
    after = step(system, at, given)
    words = "; after 1 ticks ".join(
        (_words(asked, before, inputs), assignment_text(asked.tick.variables, after))
    )
    if any(after[v.name] not in v.domain for v in asked.tick.variables):
        return Rejected("domains", words)
    if any(after[claim] for claim in asked.claims):
        return Rejected("safety", words)
    return None if member(after) else Rejected("consecution", words)


def _words(asked: CertifyQuestion, before: Valuation, inputs: Valuation) -> str:
    here = assignment_text(asked.state, before)
    return f"{here}; inputs {assignment_text(asked.tick.inputs, inputs)}" if inputs else here


# --- the states of an invariant ----------------------------------------------------------------


def _size(asked: CertifyQuestion, invariant: Invariant) -> int:
    """How many states are looked at."""
    own, rest = _split(asked, invariant)
    found = (
        count(invariant, [v.domain for v in own])
        if isinstance(invariant, CertifiedDiagram)
        else _choices(own)
    )
    return found * _choices(rest)


def _valuations(asked: CertifyQuestion, invariant: Invariant) -> Iterator[Valuation]:
    """All of the invariant, perhaps among others."""
    own, rest = _split(asked, invariant)
    domains = [v.domain for v in own]
    found = members(invariant, domains) if isinstance(invariant, CertifiedDiagram) else _vectors(own)
    return ({**a, **b} for a in found for b in _vectors(rest))


def _split(asked: CertifyQuestion, invariant: Invariant) -> tuple[list[Var], list[Var]]:
    """The variables of the invariant, in its order, and others that a tick reads."""
    by_name = {v.name: v for v in asked.state}
    names = invariant.variables if isinstance(invariant, CertifiedDiagram) else asked.about
    own = [by_name.pop(name) for name in names]
    read = variables(*asked.tick.next.values(), *asked.tick.assume)
    return own, [v for v in by_name.values() if v.name in read]


def _member(asked: CertifyQuestion, invariant: Invariant) -> Member:
    if isinstance(invariant, CertifiedDiagram):
        return invariant.__contains__
    symbols = asked.symbols(0)
    own = [v for v in asked.state if v.name in asked.about]
    found, _ = definitions(invariant.definitions, asked.spoken)

    def member(at: Valuation) -> bool:
        values: dict[str, Value] = {symbols[v.name]: _encoded(v, at[v.name]) for v in own}
        for symbol, body in found.items():
            values[symbol] = evaluate(body, values)
        return all(evaluate(c, values) is True for c in invariant.conjuncts)

    return member


def _encoded(var: Var, raw: int) -> Value:
    if isinstance(var.sort, Bool):
        return bool(raw)
    bits = width(var.domain)
    return raw % (1 << bits), bits


def _choices(variables: Sequence[Var]) -> int:
    return prod(len(v.domain) for v in variables)


def _vectors(variables: Sequence[Var]) -> Iterator[dict[str, int]]:
    names = [v.name for v in variables]
    for values in product(*(v.domain.values for v in variables)):
        yield dict(zip(names, values, strict=True))
