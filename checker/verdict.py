"""What an engine answers about a goal, and what the answers mean for a property.

An *answer* speaks of reachability: a boolean variable (the goal) is true after some tick of some
run, or of none.  A *verdict* speaks of a property: Proved, Violated or Unknown.  Neither can be
built without its evidence, and an unfinished search is never a pass.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Union

from checker.trace import Trace


@dataclass(frozen=True)
class Run:
    """What determines a run: the frozen values and the inputs of each tick, as raw values."""

    frozen: Mapping[str, int]
    inputs: tuple[Mapping[str, int], ...]

    def __len__(self) -> int:
        return len(self.inputs)


@dataclass(frozen=True)
class Exhausted:
    """Every reachable valuation was visited.

    ``states`` counts distinct valuations of ``variables`` (those the goals depend on, the others
    being sliced away), ``transitions`` the distinct input cells tried, ``depth`` the number of
    ticks after which nothing new appeared.  With ``skipped`` quiet ticks (see docs/timers.md) these are
    the valuations stored; the others were visited in passing, and ``depth`` is an upper bound.
    """

    states: int
    transitions: int
    depth: int
    variables: tuple[str, ...]
    skipped: bool = False


@dataclass(frozen=True)
class Reached:
    """The goal is true after the last tick of the run.  ``shortest``: no shorter run reaches it."""

    run: Run
    shortest: bool = True


@dataclass(frozen=True)
class Unreachable:
    """The goal is false after every tick of every run."""

    because: Exhausted


@dataclass(frozen=True)
class Open:
    """Not decided: the reason, and the number of ticks up to which the goal is known not reached."""

    reason: str
    depth: int


Answer = Union[Reached, Unreachable, Open]


@dataclass(frozen=True)
class Proved:
    """The property holds: because the search was exhausted, or (reachability) because of a witness.

    ``claim`` says what was shown of those valuations when that is not the property itself but implies it.
    """

    because: Exhausted | Trace
    engine: str
    claim: str = ""
    word: str = field(default="proved", init=False)


@dataclass(frozen=True)
class Violated:
    """The property fails: a replayed counterexample, or (reachability) an exhausted search."""

    because: Trace | Exhausted
    engine: str
    word: str = field(default="violated", init=False)


@dataclass(frozen=True)
class Unknown:
    """Not decided, and why; ``depth`` ticks are known to be free of a counterexample."""

    reason: str
    depth: int
    engine: str
    word: str = field(default="unknown", init=False)


Verdict = Union[Proved, Violated, Unknown]
