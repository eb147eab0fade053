"""What an engine makes of a child process that is cut off; killing is what ``test_isolate`` tests."""

from collections.abc import Iterator
from types import ModuleType

import pytest

from checker.isolate import Stopped

LIMIT = "the time limit of 2.5 s is reached"


def cut_off(monkeypatch: pytest.MonkeyPatch, engine: ModuleType, *events: object) -> None:
    """Have the child of an engine send some events, say nothing for a while, and meet its time limit."""

    def messages(*_: object, **__: object) -> Iterator[object]:
        yield from events
        yield None
        raise Stopped(LIMIT)

    monkeypatch.setattr(engine, "messages", messages)
