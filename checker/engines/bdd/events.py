"""What the search reports while it goes deeper."""

from dataclasses import dataclass
from typing import Union

from checker.results.verdict import Exhausted, Run


@dataclass(frozen=True)
class BddFound:
    """A shortest run to a goal."""

    goal: str
    run: Run


@dataclass(frozen=True)
class BddBound:
    """The goals are not reached by any run of at most ``depth`` ticks.

    So far ``states`` states are reached; the diagrams take ``nodes`` nodes.
    """

    goals: tuple[str, ...]
    depth: int
    states: int
    nodes: int


@dataclass(frozen=True)
class BddClosed:
    """No tick leads out of the states reached, and none from them to the goals."""

    goals: tuple[str, ...]
    because: Exhausted


@dataclass(frozen=True)
class BddStuck:
    """Nothing more can be said of the goals, for this reason."""

    goals: tuple[str, ...]
    reason: str


Event = Union[BddFound, BddBound, BddClosed, BddStuck]
