"""What a cross-check found: distinct mismatches, what was exercised, and what was not compared."""

from collections.abc import Sequence
from dataclasses import dataclass, field

from checker.conform.cross.beside import Mismatch
from checker.conform.cross.coverage import Arrow, Coverage, arrows
from spec_model.abstraction import Board

SHOWN = 5
"""Distinct mismatches that are made small and shown; how many there are is always said."""


@dataclass(frozen=True)
class Failure:
    """A run that the implementation did not survive, and what is to be said of it."""

    origin: str
    message: str


@dataclass(frozen=True)
class Result:
    """One cross-check of one implementation.

    ``mismatches`` are the distinct ones, by output and arrow, at most ``SHOWN`` of the ``distinct`` that were
    met.  ``uncompared`` are outputs that the implementation never gave.
    """

    board: Board
    coverage: Coverage
    mismatches: tuple[Mismatch, ...] = ()
    distinct: int = 0
    failures: tuple[Failure, ...] = ()
    uncompared: tuple[str, ...] = ()
    notes: Sequence[str] = field(default=())
    examples: int = 0
    seed: int = 0
    interrupted: bool = False

    @property
    def conclusive(self) -> bool:
        """Whether the runs that were asked for were made, and something was compared in them."""
        nothing = len(self.uncompared) == len(self.board.outputs)
        return not (self.failures or self.interrupted or nothing)

    @property
    def conforms(self) -> bool:
        """Whether every output compared was as the charts require, in every run that was asked for."""
        return self.conclusive and not self.mismatches

    @property
    def arrows(self) -> tuple[int, int]:
        """Arrows that the charts took, of how many."""
        return len(self.coverage.taken), len(arrows(self.board))

    @property
    def missing(self) -> tuple[Arrow, ...]:
        """Arrows that the charts took in no run."""
        return self.coverage.missing
