"""What the child reports while it works."""

from dataclasses import dataclass
from typing import Union

from checker.results.verdict import Reached, Unreachable


@dataclass(frozen=True)
class PdrAnswer:
    """The answer about a goal, with its evidence."""

    goal: str
    answer: Reached | Unreachable


@dataclass(frozen=True)
class PdrBound:
    """The goal is not reached by any run of at most ``depth`` ticks; ``lemmas`` are in use for that."""

    goal: str
    depth: int
    lemmas: int


@dataclass(frozen=True)
class PdrUndefined:
    """Nothing is said of the goals: a tick of some run takes the variables out of their domains."""

    goals: tuple[str, ...]
    variables: tuple[str, ...]
    tick: int


Event = Union[PdrAnswer, PdrBound, PdrUndefined]
