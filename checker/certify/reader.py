"""The engine that reads certificates: it finds nothing itself, and answers what a checked certificate shows.

Verdicts that are decided with it are derived again, from the model as it is now and certificates alone.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field

from rovercheck.checker.certify.certificate import Certificate
from rovercheck.checker.certify.diagram import CertifiedDiagram
from rovercheck.checker.certify.outcome import Accepted, Outcome
from rovercheck.checker.engines import Limits, Progress
from rovercheck.checker.results.verdict import Answer, Exhausted, Inductive, Open, Unreachable
from rovercheck.spec_model.lang.expr import Var
from rovercheck.spec_model.lang.system import TransitionSystem

Checked = Callable[[Certificate, TransitionSystem], Outcome]
"""How a certificate is checked against a system (``checker.certify.check.check``)."""


@dataclass
class CertificateReader:
    """Answers from certificates, each checked against every system of its name that is asked about.

    ``outcomes`` has what came of each that was checked, by its position; one system that accepts it will do.
    """

    certificates: Sequence[Certificate]
    checked: Checked
    outcomes: dict[int, Outcome] = field(default_factory=dict)
    NAME: str = "certificate"
    SUMMARY: str = "answers from certificates that were checked"

    @property
    def ways(self) -> str:
        """Who showed what was accepted."""
        return "; ".join({o.how: None for o in self.outcomes.values() if isinstance(o, Accepted)})

    def check(
        self, system: TransitionSystem, goals: Sequence[Var], limits: Limits, progress: Progress
    ) -> Mapping[str, Answer]:
        """Unreachable for each goal of which an accepted certificate says so, else open."""
        found: dict[str, Answer] = {g.name: Open("no accepted certificate speaks of it", 0) for g in goals}
        for position, one in enumerate(self.certificates):
            if one.system != system.name or found.keys().isdisjoint(one.claims):
                continue
            outcome = self.checked(one, system)
            if isinstance(outcome, Accepted):
                found |= {claim: _unreachable(one) for claim in one.claims if claim in found}
            if not isinstance(self.outcomes.get(position), Accepted):
                self.outcomes[position] = outcome
        return found


def _unreachable(one: Certificate) -> Unreachable:
    if isinstance(one.invariant, CertifiedDiagram):
        counted = one.found.get("valuations", 0), 0, one.found.get("depth", 0)
        return Unreachable(Exhausted(*counted, one.invariant.variables))
    return Unreachable(Inductive((), one.invariant.ticks, one.invariant.simple))
