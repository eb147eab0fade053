"""``rovercheck check --record-invariants``: proofs recorded, to be shown again without a search."""

from collections.abc import Sequence
from dataclasses import dataclass

from rovercheck.checker.commands.check.premises import recordable
from rovercheck.checker.commands.shared.output import counted, err, wrapped, write
from rovercheck.checker.model import Model
from rovercheck.checker.model.kept_invariants import MOST_NODES, invariants_of, row, text
from rovercheck.checker.model.kept_runs import INVARIANTS, file_of
from rovercheck.checker.results.verdict import Inductive, Unknown
from rovercheck.checker.verify.checked import CheckedProperty


@dataclass(frozen=True)
class InvariantRecorder:
    """Keeps the invariants of what was asked; those of other properties stay as they are.

    Raises ``UsageError`` where none can be kept, before anything is searched.
    """

    model: Model
    variant: str

    def __post_init__(self) -> None:
        recordable(self.model, self.variant, INVARIANTS)

    def __call__(self, found: Sequence[CheckedProperty]) -> None:
        """Keep them.  Raises ``UsageError`` where the file cannot be written."""
        asked = {one.result.property.id for one in found}
        before = invariants_of(self.model)
        kept = {id: trees for id, trees in before.items() if id in self.model.properties and id not in asked}
        rows = {
            one.result.property.id: row(one.verdict.because)
            for one in found
            if not isinstance(one.verdict, Unknown) and isinstance(one.verdict.because, Inductive)
        }
        new = {id: trees for id, trees in rows.items() if trees is not None}
        write(text({**kept, **new}), file_of(self.model, INVARIANTS))
        err.print(f"{counted(len(new), 'invariant is', 'invariants are')} recorded for what was checked.")
        if large := sorted(rows.keys() - new.keys()):
            more = f"of more than {MOST_NODES:,} operators and operands"
            err.print(wrapped(f"Formulas {more} are not kept: those of {', '.join(large)}.", 0), markup=False)
