"""Checking a certificate against the system it speaks of, with nothing of the engine that wrote it."""

from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum

from rovercheck.checker.certify import solver
from rovercheck.checker.certify.certificate import Certificate, meaningful
from rovercheck.checker.certify.diagram import CertifiedDiagram, size
from rovercheck.checker.certify.enumeration import enumerated
from rovercheck.checker.certify.invariant import Invariant
from rovercheck.checker.certify.obligations import Obligation, obligations, too_long
from rovercheck.checker.certify.outcome import (
    Accepted,
    Outcome,
    Rejected,
    TooMuch,
    Undecided,
    assignment_text,
)
from rovercheck.checker.certify.question import CertifyQuestion, question
from rovercheck.checker.certify.sweep import swept
from rovercheck.checker.certify.terms import Malformed
from rovercheck.checker.certify.tick import SymbolicStep, executed
from rovercheck.spec_model.lang.domain import Bool
from rovercheck.spec_model.lang.system import TransitionSystem

LARGE = 20_000
"""Nodes and edges of a diagram above which all states are tried.

Where that takes a second or two, a solver takes a quarter of a minute or, of those of the steered scenes,
all of its time in vain: it is asked only if it alone is.
"""


class CheckMethod(StrEnum):
    """Who checks."""

    SOLVER = "bitwuzla"
    ENUMERATION = "enumeration"
    BOTH = "both"


@dataclass(frozen=True)
class CheckEffort:
    """Who checks, and the wall seconds that the solver may take for one certificate (None: no bound)."""

    by: CheckMethod = CheckMethod.BOTH
    seconds: float | None = 600


def rebuilt(certificate: Certificate, step: SymbolicStep) -> CertifyQuestion | Rejected:
    """The question of the certificate put to the system as it is now, if that is still the same one."""
    try:
        asked = question(step, certificate.claims, certificate.kept, certificate.about)
    except (KeyError, IndexError) as error:
        return Rejected("question", f"{step.system.name} has no {error.args[0]}")
    state = [v.name for v in asked.state]
    goals = [v.name for v in asked.tick.variables if isinstance(v.sort, Bool)]
    if not certificate.claims or not set(certificate.claims) <= set(goals):
        return Rejected("question", "what is claimed is not that boolean variables are never true")
    if not set(certificate.about) <= set(state) or len(set(certificate.about)) < len(certificate.about):
        return Rejected("question", "it is about something that is no variable, or about one twice")
    if asked.digest != certificate.digest:
        other = f"it is about another {certificate.system} than the present one"
        return Rejected("question", f"{other}, whose digest is {asked.digest}")
    if asked.text != certificate.text:
        return Rejected("question", "the text of the question is not the one its digest was made of")
    return asked


def check(certificate: Certificate, system: TransitionSystem, effort: CheckEffort) -> Outcome:
    """Whether the certificate proves that the system never makes a claimed goal true."""
    asked = rebuilt(certificate, executed(system))
    if isinstance(asked, Rejected):
        return asked
    try:
        meaningful(certificate.invariant, asked)
        return _checked(certificate, system, asked, effort)
    except Malformed as error:
        return Rejected("invariant", str(error))


def _checked(
    certificate: Certificate, system: TransitionSystem, asked: CertifyQuestion, effort: CheckEffort
) -> Outcome:
    """By enumeration where that is feasible, and by the solver."""
    tried = _tried(certificate.invariant, system, asked, effort)
    if effort.by is CheckMethod.ENUMERATION or (
        effort.by is CheckMethod.BOTH and _large(certificate.invariant)
    ):
        return Undecided(tried.reason) if isinstance(tried, TooMuch) else tried
    if too_long(asked, certificate.invariant):
        return Undecided("k-induction with so large a k needs scripts too long to write")
    wanted = list(obligations(asked, certificate.invariant))
    shown = solved(asked, wanted, effort.seconds)
    return shown if isinstance(tried, TooMuch) else _together([tried, shown])


def _tried(
    invariant: Invariant, system: TransitionSystem, asked: CertifyQuestion, effort: CheckEffort
) -> Accepted | Rejected | TooMuch:
    """By enumeration, slow and obvious, or on all states at once where that is what is left."""
    if effort.by is CheckMethod.SOLVER:
        return TooMuch("only the solver is queried")
    tried = enumerated(system, asked, invariant)
    fast = isinstance(invariant, CertifiedDiagram) and (
        effort.by is CheckMethod.ENUMERATION or _large(invariant)
    )
    if isinstance(tried, TooMuch) and isinstance(invariant, CertifiedDiagram) and fast:
        return swept(asked, invariant)
    return tried


def _large(invariant: Invariant) -> bool:
    """Whether a solver would take long over it."""
    return isinstance(invariant, CertifiedDiagram) and size(invariant) > LARGE


def _together(outcomes: Sequence[Outcome]) -> Outcome:
    """One that rejects, else those that accept, else the reason why nothing is known."""
    for outcome in outcomes:
        if isinstance(outcome, Rejected):
            return outcome
    accepted = [o.how for o in outcomes if isinstance(o, Accepted)]
    return Accepted(" and ".join(accepted)) if accepted else outcomes[-1]


def solved(asked: CertifyQuestion, wanted: Sequence[Obligation], seconds: float | None) -> Outcome:
    """What the solver says of the obligations."""
    symbols = [[s for at in range(o.ticks + 1) for s in _symbols(asked, at, o.ticks)] for o in wanted]
    for decided in solver.decide(wanted, symbols, seconds):
        match decided:
            case solver.BrokenSolver(name, values):
                ticks = next(o.ticks for o in wanted if o.name == name)
                return Rejected(name, _words(asked, ticks, values))
            case solver.SolverLate(name, reason):
                return Undecided(f"{name}: {reason}")
    return Accepted(f"{len(wanted)} obligations by {solver.name()}")


def _symbols(asked: CertifyQuestion, at: int, ticks: int) -> list[str]:
    names = [v.name for v in (asked.state if not at else asked.tick.variables)]
    names += [v.name for v in asked.tick.inputs] if at < ticks else []
    return [asked.symbols(at)[name] for name in names]


def _words(asked: CertifyQuestion, ticks: int, values: solver.Values) -> str:
    """The states and inputs, tick by tick."""
    parts = []
    for at in range(ticks + 1):
        found = {name: values[s] for name, s in asked.symbols(at).items() if s in values}
        parts.append(
            f"after {at} ticks {assignment_text(asked.state, found)}"
            if at
            else assignment_text(asked.state, found)
        )
        if at < ticks and asked.tick.inputs:
            parts.append(f"inputs {assignment_text(asked.tick.inputs, found)}")
    return "; ".join(parts)
