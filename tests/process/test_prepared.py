"""A process started in advance: the first child is it, and it never outlives what it was started for."""

import os
import sys
from collections.abc import Callable

import pytest

from rovercheck.checker.process import isolate
from rovercheck.checker.process.isolate import ChildStopped, Send, messages, prepared
from tests.process.test_isolate import gone

SELDOM_READ = "wave"


def _tell(send: Send) -> None:
    send((os.getpid(), SELDOM_READ in sys.modules))


def _waiting() -> int:
    [started] = isolate._ready
    return started.process.pid


def _first(work: Callable[[Send], None]) -> tuple[int, bool]:
    found: tuple[int, bool] = next(m for m in messages(work) if m is not None)
    return found


def test_the_first_child_is_the_one_that_waits_and_has_read_the_module() -> None:
    with prepared(SELDOM_READ):
        waiting = _waiting()
        assert _first(_tell) == (waiting, True)
        pid, _ = second = _first(_tell)
        assert second == (pid, False) and pid != waiting


def test_without_a_child_it_is_killed() -> None:
    with prepared(SELDOM_READ):
        waiting = _waiting()
    assert not isolate._ready and gone(waiting)


def test_an_error_does_not_leave_it_behind() -> None:
    with pytest.raises(LookupError), prepared(SELDOM_READ):
        waiting = _waiting()
        raise LookupError
    assert gone(waiting)


def test_one_that_dies_says_so() -> None:
    with prepared(SELDOM_READ):
        isolate._ready[0].process.kill()
        with pytest.raises(ChildStopped, match="ended by SIGKILL"):
            _first(_tell)


def test_a_module_that_is_not_there_is_reported() -> None:
    with prepared("no_such_module"), pytest.raises(ChildStopped, match="no_such_module"):
        _first(_tell)
