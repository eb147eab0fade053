"""Engines and commands without child processes: cut off as a test wants it, or at work in its own process."""

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, nullcontext
from typing import Any

import pytest

from rovercheck.checker.certify import solver
from rovercheck.checker.engines.localisation import orders
from rovercheck.checker.engines.simulation import batches
from rovercheck.checker.process import isolate, pool
from rovercheck.checker.process.isolate import ChildStopped, End
from rovercheck.checker.search import runner
from tests.certifying import inline

LIMIT = "the time limit of 2.5 s is reached"


def cut_off(monkeypatch: pytest.MonkeyPatch, *events: object) -> None:
    """Have the child of an engine send some events, say nothing for a while, and meet its time limit.

    Killing is what ``test_isolate`` tests.
    """

    def messages(*_: object, **__: object) -> Iterator[object]:
        yield from events
        yield None
        raise ChildStopped(LIMIT)

    monkeypatch.setattr(runner, "messages", messages)


def here(
    work: Any, *args: Any, seconds: float | None, memory: int | None, modules: Sequence[str] = ()
) -> Iterator[Any]:
    """``checker.process.isolate.messages`` in this process."""
    return inline(work, *args)


class ChildHere:
    """``checker.process.isolate.Child`` in this process: orders are carried out when they are given."""

    def __init__(self, tell: Callable[[object], None], make: Any, *args: object, memory: int | None) -> None:
        self._tell, self._do = tell, make(*args)

    def order(self, *order: object) -> None:
        self._do(self._tell, *order)
        self._tell(End(None))

    def kill(self) -> None:
        """There is nothing to end."""


@contextmanager
def engines_here() -> Iterator[None]:
    """Every engine, and the certifier's solver, in this process; simulations are short."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(batches, "EFFORT", 10_000)
        patch.setattr(solver, "messages", inline)
        patch.setattr(orders, "Child", ChildHere)
        patch.setattr(runner, "messages", here)
        yield


@contextmanager
def commands_here() -> Iterator[None]:
    """Every search of a command, and every mutant that it judges, in this process, one after the other."""
    with engines_here(), pytest.MonkeyPatch.context() as patch:
        patch.setattr(pool, "Child", ChildHere)
        patch.setattr(isolate, "Child", None)  # what starts one all the same fails
        patch.setattr(isolate, "prepared", lambda *_: nullcontext())
        yield
