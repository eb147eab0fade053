"""The values that the formulas of a part had in the recordings, from which limits are made."""

from collections.abc import Mapping, Sequence
from fractions import Fraction
from itertools import zip_longest

from rovercheck.checker.conformance.recording import Raw
from rovercheck.checker.diagnosis.evidence import PartEvidence
from rovercheck.spec_model.abstraction.signals import computed
from rovercheck.spec_model.lang.evaluate import evaluate
from rovercheck.spec_model.lang.expr import Expr, Temporal
from rovercheck.spec_model.lang.walk import nodes, structure, variables

BEFORE = 260
"""Rows before a case whose values may have brought it about."""
MOST_MET = 80
"""Values met before a case that are tried as limits."""


class MetValues:
    """The values that formulas had: all of them, and those just before a case or behind what is decided."""

    def __init__(self, evidence: PartEvidence) -> None:
        self._evidence = evidence
        self._known: dict[object, tuple[list[Fraction], list[Fraction]]] = {}

    def of(self, formula: Expr) -> tuple[list[Fraction], list[Fraction]]:
        """All values, sorted; those before cases, the latest first.  Of formulas of what is recorded only."""
        key = structure(formula)
        if key not in self._known:
            self._known[key] = self._met(formula)
        return self._known[key]

    def of_all(self, formulas: Sequence[Expr]) -> tuple[list[Fraction], list[Fraction]]:
        """The values of several formulas together, in the same order."""
        if len(formulas) == 1:
            return self.of(formulas[0])
        every, recent = zip(*map(self.of, formulas), strict=True)
        latest = (value for rank in zip_longest(*recent) for value in rank if value is not None)
        return sorted({value for some in every for value in some}), list(dict.fromkeys(latest))

    def _met(self, formula: Expr) -> tuple[list[Fraction], list[Fraction]]:
        names = list(variables(formula))
        every: set[Fraction] = set()
        recent: dict[Fraction, None] = {}
        if any(isinstance(n, Temporal) for n in nodes(formula)):
            return [], []
        cases: list[list[Fraction]] = []
        for run in self._evidence.runs:
            if not all(name in run.columns for name in names):
                continue
            columns = [run.columns[name] for name in names]
            values = [self._value(formula, names, row) for row in zip(*columns, strict=True)]
            every.update(v for v in values if v is not None)
            firsts = [case.first for case in run.cases(self._evidence.name)]
            windows = [values[max(0, first - BEFORE) : first + 1][::-1] for first in firsts]
            if (lost := run.undecided.get(self._evidence.name)) is not None:
                windows.append(values[lost : lost + BEFORE])
            for window in windows:
                cases.append(list(dict.fromkeys(v for v in window if v is not None))[:MOST_MET])
        for rank in range(max(map(len, cases), default=0)):
            recent.update((case[rank], None) for case in cases if rank < len(case))
            if len(recent) >= 4 * MOST_MET:
                break
        return sorted(every), list(recent)

    @staticmethod
    def _value(formula: Expr, names: Sequence[str], row: Sequence[Raw | None]) -> Fraction | None:
        if any(v is None for v in row):
            return None
        at: Mapping[str, Raw] = {n: v for n, v in zip(names, row, strict=True) if v is not None}
        return Fraction(evaluate(formula, computed(at)))


__all__ = ["MetValues"]
