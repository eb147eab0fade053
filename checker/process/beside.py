"""Work in copies of this process, several at a time (Linux; elsewhere one after the other).

A copy has all that its parent has, so that nothing but results has to travel.  What is to be killed at any
moment, or must not be trusted, is work for ``checker.process.isolate``.
"""

import os
import pickle
import selectors
import signal
import sys
import threading
import warnings
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from typing import Generic, TypeVar

from rovercheck.checker.process.child import end_with_parent

T = TypeVar("T")


@dataclass
class _Copy(Generic[T]):
    """A copy at work: the number of its work, its process, and what it has said so far."""

    number: int
    pid: int
    said: list[bytes] = field(default_factory=list)


def beside(works: Sequence[Callable[[], T]], at_once: int) -> Iterator[tuple[int, T]]:
    """The results of all works, which must be picklable, with their numbers, as they are found.

    Up to ``at_once`` copies work at a time.  What a copy did not end, is done here: so errors are raised
    here.  All copies end with the iterator.
    """
    if at_once < 2 or len(works) < 2 or not _can_copy():
        yield from ((number, work()) for number, work in enumerate(works))
        return
    waiting = list(reversed(range(len(works))))
    with selectors.DefaultSelector() as pipes:
        try:
            while waiting or pipes.get_map():
                while waiting and len(pipes.get_map()) < at_once:
                    number = waiting.pop()
                    end, pid = _copied(works[number])
                    pipes.register(end, selectors.EVENT_READ, _Copy[T](number, pid))
                for key, _ in pipes.select():
                    copy: _Copy[T] = key.data
                    if part := os.read(key.fd, 1 << 16):
                        copy.said.append(part)
                        continue
                    pipes.unregister(key.fd)
                    os.close(key.fd)
                    _, status = os.waitpid(copy.pid, 0)
                    whole = b"".join(copy.said)
                    yield copy.number, pickle.loads(whole) if status == 0 else works[copy.number]()
        finally:
            for key in list(pipes.get_map().values()):
                with suppress(ProcessLookupError):
                    os.kill(key.data.pid, signal.SIGKILL)
                os.waitpid(key.data.pid, 0)
                os.close(key.fd)


def _can_copy() -> bool:
    """A copy has only the thread that made it: what others hold would be held for ever."""
    return sys.platform == "linux" and threading.active_count() == 1


def _copied(work: Callable[[], object]) -> tuple[int, int]:
    """A new copy that does the work: the pipe from which its result is read, and its process."""
    end, into = os.pipe()
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", DeprecationWarning)  # of threads that Python does not know of
        pid = os.fork()
    if pid:
        os.close(into)
        return end, pid
    status = 1
    try:
        end_with_parent()
        signal.signal(signal.SIGINT, signal.SIG_IGN)  # the parent is told, too, and ends its copies
        os.close(end)
        with os.fdopen(into, "wb") as out:
            out.write(pickle.dumps(work()))
        status = 0
    finally:
        os._exit(status)


__all__ = ["beside"]
