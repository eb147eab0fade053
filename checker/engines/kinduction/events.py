"""What the search reports of its goals."""

from dataclasses import dataclass
from typing import Union

from rovercheck.checker.results.verdict import Inductive, Run


@dataclass(frozen=True)
class InductionFound:
    """A run to a goal, and whether no shorter one exists."""

    goal: str
    run: Run
    shortest: bool


@dataclass(frozen=True)
class InductionClosed:
    """No run of any length reaches the goal."""

    goal: str
    because: Inductive


@dataclass(frozen=True)
class InductionBound:
    """The goals are not reached by any run of at most ``depth`` ticks."""

    goals: tuple[str, ...]
    depth: int


@dataclass(frozen=True)
class InductionStuck:
    """The goals are left open, for this reason."""

    goals: tuple[str, ...]
    reason: str


@dataclass(frozen=True)
class InductionProgress:
    """What is being done, for a progress line."""

    text: str


Event = Union[InductionFound, InductionClosed, InductionBound, InductionStuck, InductionProgress]
