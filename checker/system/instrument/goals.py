"""What a covering test set must reach: transitions, their pairs, boundaries, conditions that decide."""

from dataclasses import dataclass
from enum import StrEnum

from rovercheck.spec_model.lang.expr import Var
from rovercheck.spec_model.lang.system import System


class GoalKind(StrEnum):
    """What a goal is about; the values are the words of kept tests and of ``testgen-1.json``."""

    TRANSITIONS = "arrows"
    """Each segment of each transition, default transitions included, lies on a path that is taken."""
    BOUNDARIES = "boundaries"
    """Each comparison is evaluated at its boundary and just beside it, each timer at N - 1, N and N + 1."""
    PAIRS = "pairs"
    """Each transition that enters a state is followed by each that leaves it."""
    CONDITIONS = "conditions"
    """Each condition of a decision decides it, true and false, beside its limit where it has one (MC/DC)."""

    @property
    def word(self) -> str:
        """What people call such goals: ``transitions``."""
        return self.name.lower()

    @property
    def in_id(self) -> str:
        """How the id of such a goal calls it."""
        return "arrow" if self is GoalKind.TRANSITIONS else _SINGULAR[self]


_SINGULAR = {GoalKind.BOUNDARIES: "boundary", GoalKind.PAIRS: "pair", GoalKind.CONDITIONS: "condition"}
KEPT = (GoalKind.TRANSITIONS, GoalKind.BOUNDARIES, GoalKind.PAIRS)
"""Kinds of goals of the tests that come with rovercheck, and of those that a user keeps."""


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
