"""The contract of an engine, and how engines are found: by being in this folder.

An engine module has a ``NAME``, a one-line ``SUMMARY`` and a function ``check`` with the signature
of ``Engine.check``.  It never raises for a hard problem (it answers ``Open`` with the reason) and
never guesses.  One that looks at some runs only says so with ``SAMPLES = True``; one that can show what an
earlier proof says has a function ``show`` as well (``Prover``).
"""

import importlib
import pkgutil
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from enum import StrEnum
from time import monotonic
from typing import TYPE_CHECKING, Protocol, runtime_checkable

if TYPE_CHECKING:  # the command line reads this module for its options
    from rovercheck.checker.results.verdict import Answer
    from rovercheck.spec_model.lang.expr import Expr, Var
    from rovercheck.spec_model.lang.system import TransitionSystem

ALL, AUTO = "all", "auto"
"""What may be written instead of the name of an engine: every engine, or engines in turn."""

LOADED = (
    "rovercheck.checker.verify.search_worker",
    "rovercheck.checker.verify.decide",
    "rovercheck.checker.engines.explicit.answers",
    "rovercheck.checker.verify.stored",
)
"""The modules of nearly every search: a process loads them while the command reads its model."""


class Timers(StrEnum):
    """How timers are searched, with the same verdicts (docs/timers.md)."""

    EXACT = "exact"
    """Every state of the saturating counters is stored."""
    SKIP = "skip"
    """States reached by ticks in which only counters move on are visited and not stored."""
    FREE = "free"
    """First on the system whose timers may expire at any time; what that leaves open, exactly."""


@dataclass(frozen=True)
class Limits:
    """What an engine may spend: ticks of depth (None: no bound), wall seconds, bytes of memory.

    ``transitions`` bounds what an enumeration tries, so that a turn ends after the same work on any machine.
    ``timers`` is how; an engine that does not store states need not look at either.
    """

    depth: int | None = None
    seconds: float | None = None
    memory: int = 8 << 30
    transitions: int | None = None
    timers: Timers = Timers.EXACT

    def deadline(self) -> float | None:
        """The moment on ``time.monotonic()`` at which the time is over."""
        return None if self.seconds is None else monotonic() + self.seconds

    def until(self, deadline: float | None) -> "Limits":
        """These limits with the seconds that are left until a deadline, if there is one."""
        return self if deadline is None else replace(self, seconds=max(0.0, deadline - monotonic()))


class Stage(str):
    """A line of progress that says what may take long and looks at no clock, as compiling: told at once."""


Progress = Callable[[str], None]
"""Called now and then with one line that says what is being done (phase, depth, counts)."""


def quiet(_: str) -> None:
    """A progress that shows nothing."""


class Engine(Protocol):
    """Decides for each goal, a boolean variable of the system, whether it is ever true after a tick."""

    NAME: str
    SUMMARY: str

    def check(
        self, system: "TransitionSystem", goals: Sequence["Var"], limits: Limits, progress: Progress
    ) -> Mapping[str, "Answer"]:
        """An answer for each goal, by name.  Runs in ``Reached`` start before the first tick."""
        ...


@runtime_checkable
class Prover(Engine, Protocol):
    """An engine that can also show what an earlier proof says, if that still holds."""

    def show(
        self,
        system: "TransitionSystem",
        goals: Sequence["Var"],
        limits: Limits,
        progress: Progress,
        candidates: "Sequence[Expr]",
    ) -> Mapping[str, "Answer"]:
        """An answer for each goal, by name: open where those of the candidates that are inductive are not
        enough.  No other invariant is searched for."""
        ...


def engines() -> dict[str, Engine]:
    """The engines in ``checker/engines``, by name."""
    found: dict[str, Engine] = {}
    for entry in sorted(pkgutil.iter_modules(__path__), key=lambda e: e.name):
        module = importlib.import_module(f"{__name__}.{entry.name}")
        if hasattr(module, "NAME"):
            found[module.NAME] = module
    return found
