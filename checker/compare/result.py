"""What a cross-check found: distinct mismatches, what was exercised, and what was not compared."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from rovercheck.checker.compare.beside import ComparedStep, StepMismatch
from rovercheck.checker.compare.coverage import (
    CoveredTransition,
    TransitionCoverage,
    transitions,
)
from rovercheck.checker.compare.notable_runs import NotableRuns
from rovercheck.checker.conformance.deviations import Deviation, DeviationScope, DeviationTally
from rovercheck.checker.conformance.follower import Situation
from rovercheck.spec_model.abstraction import Board

FIXED, RANDOM, DECIDING = "fixed runs", "random runs", "runs for the causes found"
"""The kinds of runs, in the order in which they are tried; the last only where causes are asked for."""


@dataclass(frozen=True)
class Allowance:
    """What is spent on an implementation that differs; the rest is told, but not looked into."""

    mismatches: int = 5
    """Distinct mismatches that are made small and told in full, those that explain most."""
    failures: int = 3
    """Runs that the implementation may fail to survive before no more are tried."""
    budget: int = 30_000
    """Steps that may be spent on making one mismatch small."""
    total: int = 150_000
    """Steps that may be spent on making mismatches small, on all of them together."""


ALLOWED = Allowance()


@dataclass(frozen=True)
class CompareStage:
    """How many runs of a kind were tried, of how many (None: not counted), and why not all, if not all."""

    kind: str
    tried: int
    of: int | None
    because: str = ""


@dataclass(frozen=True)
class Failure:
    """A run in which the implementation crashed, hung or answered without meaning, in its last step.

    It has no steps where that happened at power-up.  ``number``: which of the runs it is, from 1.
    """

    board: Board
    origin: str
    message: str
    steps: tuple[ComparedStep, ...] = ()
    number: int = 0

    @property
    def tick(self) -> int:
        """The number of the step, from 1; 0 at power-up."""
        return len(self.steps)


@dataclass(frozen=True)
class CompareResult:
    """One cross-check of one implementation.

    ``mismatches`` are the distinct ones, one for each deviation over all runs, what explains most first; the
    first ``small`` of them are told in full. ``uncompared`` are outputs that it never gave, ``compared`` the
    steps in which it answered.  ``stages`` say what was tried.  ``undecided``: parts of which, after a
    mismatch, not all could be decided, with the reason and in how many runs.  ``situations`` are what was put
    to the test and was as required, if that was asked for; ``tally`` holds the deviations of all runs.
    """

    board: Board
    coverage: TransitionCoverage
    mismatches: tuple[StepMismatch, ...] = ()
    small: int = 0
    failures: tuple[Failure, ...] = ()
    uncompared: tuple[str, ...] = ()
    notes: Sequence[str] = field(default=())
    examples: int = 0
    seed: int = 0
    interrupted: bool = False
    stages: tuple[CompareStage, ...] = ()
    compared: int = 0
    allowance: Allowance = ALLOWED
    undecided: Mapping[tuple[str, str], int] = field(default_factory=dict)
    situations: frozenset[Situation] = frozenset()
    tally: DeviationTally = field(default_factory=DeviationTally)
    notable: NotableRuns = field(default_factory=NotableRuns)
    """The runs in which a deviation is met first, or for longest."""
    lost: bool = False
    """Whether runs could not be tried where they were sent."""

    @property
    def met(self) -> Mapping[DeviationScope, Deviation]:
        """The deviations as they were met in the runs, before any run was made small."""
        return {one.scope: one for one in self.tally.deviations()}

    @property
    def complete(self) -> bool:
        """Whether all runs that were asked for were tried."""
        return not self.interrupted and not any(stage.because for stage in self.stages)

    @property
    def deviations(self) -> tuple[Deviation, ...]:
        """Those that the mismatches are of, in their order."""
        return tuple(m.deviation for m in self.mismatches if m.deviation is not None)

    @property
    def conclusive(self) -> bool:
        """Whether the search came to its end, and something was compared in it."""
        nothing = len(self.uncompared) == len(self.board.outputs)
        return not (self.interrupted or self.lost or nothing)

    @property
    def differs(self) -> bool:
        """Whether the implementation does something else than the charts: other outputs, or no answer."""
        return bool(self.mismatches or self.failures)

    @property
    def conforms(self) -> bool:
        """Whether every output compared was as the charts require, in every run that was asked for."""
        return self.conclusive and not self.differs

    @property
    def transitions(self) -> tuple[int, int]:
        """Transitions that the charts took, of how many."""
        return len(self.coverage.taken), len(transitions(self.board))

    @property
    def missing(self) -> tuple[CoveredTransition, ...]:
        """Transitions that the charts took in no run."""
        return self.coverage.missing
