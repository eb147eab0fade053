"""What a search reports of its goals while it works, whatever its algorithm."""

from dataclasses import dataclass
from typing import Union

from rovercheck.checker.results.verdict import Evidence, Run


@dataclass(frozen=True)
class GoalReached:
    """A run to a goal.  ``shortest``: no shorter run reaches it."""

    goal: str
    run: Run
    shortest: bool = True


@dataclass(frozen=True)
class GoalsExcluded:
    """No run of any length reaches the goals."""

    goals: tuple[str, ...]
    because: Evidence


@dataclass(frozen=True)
class DepthSearched:
    """No run of at most ``depth`` ticks reaches the goals; ``details`` are for the progress line."""

    goals: tuple[str, ...]
    depth: int
    details: str = ""


@dataclass(frozen=True)
class GoalsLeftOpen:
    """Nothing more will be said of the goals, for this reason."""

    goals: tuple[str, ...]
    reason: str


@dataclass(frozen=True)
class SearchPhase:
    """What is being done, for the progress line."""

    text: str


SearchEvent = Union[GoalReached, GoalsExcluded, DepthSearched, GoalsLeftOpen, SearchPhase]
