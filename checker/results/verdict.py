"""What an engine answers about a goal, and what the answers mean for a property.

An *answer* speaks of reachability: a boolean variable (the goal) is true after some tick of some
run, or of none.  A *verdict* speaks of a property: Proved, Violated or Unknown.  Neither can be
built without its evidence, and an unfinished search is never a pass.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Union

from rovercheck.checker.results.trace import Trace
from rovercheck.properties.expected import VerdictWord

if TYPE_CHECKING:
    from rovercheck.checker.results.closed_set import ClosedSet, ClosedUnion
    from rovercheck.checker.results.diagram import Diagram
    from rovercheck.spec_model.lang.expr import Expr


@dataclass(frozen=True)
class Run:
    """What determines a run: the frozen values and the inputs of each tick, as raw values."""

    frozen: Mapping[str, int]
    inputs: tuple[Mapping[str, int], ...]

    def __len__(self) -> int:
        return len(self.inputs)


@dataclass(frozen=True)
class Exhausted:
    """Every reachable state was visited.

    ``states`` counts distinct states of ``variables`` (those the goals depend on, the others
    being sliced away), ``transitions`` the distinct input cells tried (0: not counted), ``depth`` the
    number of ticks after which nothing new appeared.  With ``skipped`` quiet ticks (see docs/timers.md)
    these are the states stored; the others were visited in passing, and ``depth`` is an upper bound.
    """

    states: int
    transitions: int
    depth: int
    variables: tuple[str, ...]
    skipped: bool = False
    closed: "ClosedSet | ClosedUnion | None" = field(default=None, compare=False, repr=False)
    """The states themselves, as far as the engine kept them."""
    diagram: "Diagram | None" = field(default=None, compare=False, repr=False)
    """The set of them, where the engine kept a decision diagram of it; constants of the system included."""

    @property
    def how(self) -> str:
        """``all 154 reachable states``, or that these are only the stored ones of those visited."""
        what = "stored states (quiet ticks skipped)" if self.skipped else "reachable states"
        return f"all {self.states:,} {what}"


@dataclass(frozen=True)
class Inductive:
    """An inductive invariant that keeps every run away from the goals.

    ``conjuncts`` speak of the variables and frozen variables of the system at the tick boundary.  They
    hold before the first tick and, all together, pass from before a tick to after it.  The goal is
    false after the next tick wherever the conjuncts held and the goal was false for ``ticks`` - 1 ticks
    (``ticks`` = 1: the conjuncts alone exclude it), the first ``ticks`` ticks of every run being free
    of it.  With ``simple``, states on those ticks are taken to differ from each other.  Variables
    are taken to be within their domains; that no tick takes one out of them is part of the obligations.
    """

    conjuncts: tuple["Expr", ...]
    ticks: int = 1
    simple: bool = False

    @property
    def how(self) -> str:
        """``an invariant of 12 conjuncts``, ``3-induction with 5 conjuncts``."""
        return _induction(len(self.conjuncts), self.ticks)


def _induction(conjuncts: int, ticks: int) -> str:
    many = f"{conjuncts} conjunct{'s' * (conjuncts != 1)}"
    if ticks > 1:
        return f"{ticks}-induction" + (f" with {many}" if conjuncts else "")
    return f"an invariant of {many}" if conjuncts else "one tick from anywhere"


Evidence = Union[Exhausted, Inductive]
"""What shows that no run reaches a goal."""


@dataclass(frozen=True)
class StoredInvariant:
    """What is told of an inductive invariant that an earlier search found: see ``Inductive``."""

    conjuncts: int
    ticks: int = 1

    @property
    def how(self) -> str:
        """As ``Inductive`` says it."""
        return _induction(self.conjuncts, self.ticks)


@dataclass(frozen=True)
class StoredRun:
    """A run that was replayed when it was found, as it is kept: all that is needed to replay it again.

    Of a run without end ``loop`` is the tick after which it repeats, see ``Trace``; it takes ``total_ms``.
    ``trapped`` and ``shortest`` as there.
    """

    run: Run
    total_ms: int
    loop: int | None = None
    trapped: int | None = None
    shortest: bool = False

    def __len__(self) -> int:
        return len(self.run)

    def ms(self, tick: int) -> int:
        """The time in ms at the end of the last tick.  Raises ``ValueError`` for any other."""
        if tick != len(self):
            raise ValueError(f"only the end of a run of {len(self)} ticks is kept, not tick {tick}")
        return self.total_ms


Stored = StoredInvariant | StoredRun
"""What stands for a proof or a run that is kept."""


@dataclass(frozen=True)
class Reached:
    """The goal is true after the last tick of the run.  ``shortest``: no shorter run reaches it."""

    run: Run
    shortest: bool = True


@dataclass(frozen=True)
class Unreachable:
    """The goal is false after every tick of every run."""

    because: Evidence


@dataclass(frozen=True)
class Open:
    """Not decided: the reason, and the number of ticks up to which the goal is known not reached."""

    reason: str
    depth: int


Answer = Union[Reached, Unreachable, Open]


@dataclass(frozen=True)
class Proved:
    """The property holds: because the search was exhausted, or (reachability) because of a witness.

    ``claim`` says what was shown of those states when that is not the property itself but implies it.
    """

    because: Evidence | Trace | Stored
    engine: str
    claim: str = ""
    word: VerdictWord = field(default="proved", init=False)


@dataclass(frozen=True)
class Violated:
    """The property fails: a replayed counterexample, or (reachability) an exhausted search."""

    because: Trace | Evidence | Stored
    engine: str
    word: VerdictWord = field(default="violated", init=False)


@dataclass(frozen=True)
class Unknown:
    """Not decided, and why; ``depth`` ticks are known to be free of a counterexample."""

    reason: str
    depth: int
    engine: str
    word: VerdictWord = field(default="unknown", init=False)


Verdict = Union[Proved, Violated, Unknown]
