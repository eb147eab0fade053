"""Proofs on record, tried before anything is searched: what they say is shown again, or it does not count."""

from collections.abc import Mapping, Sequence

from checker.engines import Limits, Progress, Prover
from checker.results.verdict import Answer
from spec_model.lang.expr import Expr, Var
from spec_model.lang.system import TransitionSystem


class RecordedInvariants:
    """An engine that tries the conjuncts of earlier proofs and searches for nothing."""

    SUMMARY = "the invariants on record"

    def __init__(self, prover: Prover, candidates: Sequence[Expr]) -> None:
        self.NAME = prover.NAME
        self._prover, self._candidates = prover, candidates

    def check(
        self, system: TransitionSystem, goals: Sequence[Var], limits: Limits, progress: Progress
    ) -> Mapping[str, Answer]:
        """An answer for each goal, by name: open what the conjuncts do not exclude."""
        return self._prover.show(system, goals, limits, progress, self._candidates)
