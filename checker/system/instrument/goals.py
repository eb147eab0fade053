"""What a covering test set must reach: arrows, boundaries of comparisons and timers, pairs of arrows."""

from dataclasses import dataclass
from enum import StrEnum

from rovercheck.spec_model.lang.expr import Var
from rovercheck.spec_model.lang.system import System


class GoalKind(StrEnum):
    """What a goal is about."""

    ARROWS = "arrows"
    """Each segment of each arrow, default transitions included, lies on a path that is taken."""
    BOUNDARIES = "boundaries"
    """Each comparison is evaluated at its boundary and just beside it, each timer at N - 1, N and N + 1."""
    PAIRS = "pairs"
    """Each arrow that enters a state is followed by each that leaves it."""

    @property
    def one(self) -> str:
        """The word for one of them."""
        return {GoalKind.ARROWS: "arrow", GoalKind.BOUNDARIES: "boundary", GoalKind.PAIRS: "pair"}[self]


@dataclass(frozen=True)
class CoverGoal:
    """A goal: reached in a tick after which its flag is true.

    ``id`` stays the same as long as the part, a chart or block, is drawn as it is; ``text`` says it in words.
    """

    id: str
    kind: GoalKind
    part: str
    text: str
    flag: Var


@dataclass(frozen=True)
class Watched:
    """A system that behaves as before and raises the flag of each goal that a tick reaches."""

    system: System
    goals: tuple[CoverGoal, ...]

    def of(self, *kinds: GoalKind) -> tuple[CoverGoal, ...]:
        """The goals of some kinds."""
        return tuple(g for g in self.goals if g.kind in kinds)
