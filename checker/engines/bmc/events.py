"""What the search reports while it goes deeper."""

from dataclasses import dataclass
from typing import Union

from rovercheck.checker.results.verdict import Run


@dataclass(frozen=True)
class BmcFound:
    """A shortest run to a goal."""

    goal: str
    run: Run


@dataclass(frozen=True)
class BmcBound:
    """The goals are not reached by any run of at most ``depth`` ticks."""

    goals: tuple[str, ...]
    depth: int


@dataclass(frozen=True)
class BmcUndefined:
    """Nothing more can be said of the goals beyond ``depth``: the variables may leave their domains."""

    goals: tuple[str, ...]
    variables: tuple[str, ...]
    depth: int


Event = Union[BmcFound, BmcBound, BmcUndefined]
