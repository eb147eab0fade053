"""Proofs on record, tried before anything is searched: what they say is shown again, or it does not count."""

from collections.abc import Mapping, Sequence

from checker.engine import Limits, Progress
from checker.engines import kinduction
from checker.verdict import Answer
from spec_model.lang.expr import Expr, Var
from spec_model.lang.system import TransitionSystem


class Recorded:
    """k-induction with the conjuncts of earlier proofs, as an engine: it looks for no others."""

    NAME = kinduction.NAME
    SUMMARY = "k-induction with the invariants on record"

    def __init__(self, candidates: Sequence[Expr]) -> None:
        self._candidates = candidates

    def check(
        self, system: TransitionSystem, goals: Sequence[Var], limits: Limits, progress: Progress
    ) -> Mapping[str, Answer]:
        """An answer for each goal, by name: open what the conjuncts do not exclude."""
        return kinduction.check(system, goals, limits, progress, self._candidates)
