"""Engines without child processes: cut off as a test wants it, or at work in the process of the test."""

from collections.abc import Iterator
from contextlib import contextmanager
from types import ModuleType
from typing import Any

import pytest

from checker.certify import solver
from checker.engine import engines
from checker.isolate import Stopped
from tests.certifying import inline

LIMIT = "the time limit of 2.5 s is reached"


def cut_off(monkeypatch: pytest.MonkeyPatch, engine: ModuleType, *events: object) -> None:
    """Have the child of an engine send some events, say nothing for a while, and meet its time limit.

    Killing is what ``test_isolate`` tests.
    """

    def messages(*_: object, **__: object) -> Iterator[object]:
        yield from events
        yield None
        raise Stopped(LIMIT)

    monkeypatch.setattr(engine, "messages", messages)


def here(work: Any, *args: Any, seconds: float | None, memory: int | None) -> Iterator[Any]:
    """``checker.isolate.messages`` in this process."""
    return inline(work, *args)


@contextmanager
def engines_here() -> Iterator[None]:
    """Every engine, and the certifier's solver, in this process."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(solver, "messages", inline)
        for engine in engines().values():
            if isinstance(engine, ModuleType) and hasattr(engine, "messages"):
                patch.setattr(engine, "messages", here)
        yield
