"""Work in child processes that can be killed at any moment: a solver cannot be trusted to stop.

The work is a function of a module.  It gets a ``send`` function, whose messages arrive in the
parent one by one.  A child dies when the time is over, when the parent stops listening (Ctrl-C
too) and when the parent dies.  Its own side is ``checker.process.child``.
"""

import os
import pickle
import signal
import struct
import subprocess
import sys
import tempfile
import threading
from collections.abc import Callable, Generator, Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from queue import Empty, SimpleQueue
from time import monotonic
from typing import IO, Any

from rovercheck.checker.process.faults import Fault, has_listener, report
from rovercheck.checker.process.fork_server import (
    AVAILABLE,
    SERVER_MAIN,
    ForkedProcess,
    ForkServer,
    NoServer,
)

Send = Callable[[object], None]
DEEP = 100_000
"""Levels of nested calls: Python's own limit allows a pickled formula about 250."""
LENGTH = struct.Struct("<Q")
"""What precedes each order: its length."""
_WINDOWS_FAULTS = 0xC0000000
"""From here on a status says on Windows what POSIX says by a signal."""
_MAIN = "from rovercheck.checker.process.child import child; child()"


class ChildStopped(Exception):
    """The work did not come to its end; the message says why, for a person."""


@dataclass(frozen=True)
class End:
    """A child is done with an order: what went wrong, or None.  ``dead``: it takes no further order.

    ``crashed``: a fault of the code that it ran has ended it, and nobody from outside.  ``error``: what was
    raised, with its place, if that was an internal error.
    """

    failure: str | None
    dead: bool = False
    crashed: bool = False
    error: str = ""


class Child:
    """A process that carries out orders one after the other until it is killed.

    ``make(*args)`` is called once in the child and gives the function that is called for each order,
    as ``do(send, *order)``.  What it sends reaches ``report`` (in a thread of the parent), after each
    order an ``End``.  ``memory`` limits the address space, in bytes.  All must be picklable.
    ``modules`` are what it will import.
    """

    def __init__(
        self,
        report: Callable[[object], None],
        make: Callable[..., Callable[..., None]],
        *args: object,
        memory: int | None = None,
        modules: Sequence[str] = (),
    ) -> None:
        self._tell = report
        started = _ready.pop() if _ready else _started(modules)
        self._process, self._errors, self._group = started.process, started.errors, started.group
        self._orders: SimpleQueue[bytes | None] = SimpleQueue()
        self._threads = [threading.Thread(target=t, daemon=True) for t in (self._feed, self._read)]
        for thread in self._threads:
            thread.start()
        self._orders.put(_packed((memory, make, args)))

    def order(self, *order: object) -> None:
        """Have one more order carried out."""
        self._orders.put(_packed(order))

    def kill(self) -> None:
        """End the process, whatever it does, with all processes that it started."""
        _killed(self._process, self._group)
        self._orders.put(None)
        for thread in self._threads:
            thread.join()
        with suppress(OSError):  # what was not written yet
            self._process.__exit__(None, None, None)
        self._errors.close()

    def _feed(self) -> None:
        """Write orders; the pipe is left open until the end: the child ends when it is closed."""
        stdin = self._process.stdin
        assert stdin is not None
        with suppress(OSError):
            while (order := self._orders.get()) is not None:
                stdin.write(order)
                stdin.flush()

    def _read(self) -> None:
        """Hand on messages until the child ends."""
        stdout = self._process.stdout
        assert stdout is not None
        try:
            while True:
                self._tell(pickle.load(stdout))
        except (EOFError, OSError, pickle.UnpicklingError):
            end = End(self._cause(), dead=True, crashed=_is_fault(self._process.wait()))
        except Exception as error:  # the child itself would go on
            _killed(self._process, self._group)
            why = f"a message of the solver process cannot be read: {type(error).__name__}: {error}"
            end = End(why, dead=True)
        self._tell(end)

    def _cause(self) -> str:
        """Why the process ended without a word."""
        status = self._process.wait()
        if status < 0:
            return f"the solver process was ended by {_signal(-status)}"
        self._errors.seek(0)
        said = self._errors.read().decode(errors="replace").strip().splitlines()
        return f"the solver process ended with status {status}" + (f": {said[-1]}" if said else "")


@dataclass(frozen=True)
class _Started:
    """A process that waits for its first order; ``group``: it leads a group that is killed with it."""

    process: subprocess.Popen[bytes] | ForkedProcess
    errors: IO[bytes]
    group: bool


_ready: list[_Started] = []
"""Processes started in advance, which the next ``Child`` takes."""


_servers: list[ForkServer] = []
"""The process that children are forked from, once there is one."""
_servers_lost: list[NoServer] = []
_MOST_LOST = 3


def _started(modules: Sequence[str] = ()) -> _Started:
    """The process, in a session of its own so that Ctrl-C reaches the parent alone."""
    errors = tempfile.TemporaryFile()  # noqa: SIM115, closed when the process is killed
    forked = _forked(modules, errors) if modules and _is_child() else None
    if forked is not None:
        return _Started(forked, errors, False)
    group = not _is_child() and hasattr(os, "killpg")
    process = subprocess.Popen(
        [sys.executable, "-P", "-c", _MAIN],  # -P: no module is taken from the folder we happen to be in
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=errors,
        env=_environment(),
        start_new_session=group,
    )
    return _Started(process, errors, group)


def _environment() -> dict[str, str]:
    """That of a child: one hash seed, so that a question is put to a solver in the same words every time."""
    path = os.pathsep.join(filter(None, sys.path))
    return {**os.environ, "PYTHONPATH": path, "PYTHONHASHSEED": "0"}


def _forked(modules: Sequence[str], errors: IO[bytes]) -> ForkedProcess | None:
    """One forked from a process that has imported the modules; None where that does not work.

    A child has many children of its own one after the other, the parent of all has few.
    """
    while AVAILABLE and len(_servers_lost) < _MOST_LOST:
        try:
            if not _servers:
                _servers.append(ForkServer(_environment()))
            return _servers[0].fork(modules, errors)
        except NoServer as lost:
            _servers_lost.append(lost)
            while _servers:
                _servers.pop().close()
    return None


def _signal(number: int) -> str:
    named = {s.value: s.name for s in signal.Signals}  # those for real time have no names
    return named.get(number, f"signal {number}")


def _is_fault(status: int) -> bool:
    """Whether a process has ended by its own fault, as an invalid address is one."""
    names = ("SIGSEGV", "SIGBUS", "SIGILL", "SIGFPE", "SIGABRT", "SIGTRAP", "SIGSYS")
    return -status in {getattr(signal, name, 0) for name in names} - {0} or status >= _WINDOWS_FAULTS


def _killed(process: subprocess.Popen[bytes] | ForkedProcess, group: bool) -> None:
    if group:
        with suppress(ProcessLookupError, PermissionError):
            os.killpg(process.pid, signal.SIGKILL)
    process.kill()


@contextmanager
def prepared(*modules: str) -> Iterator[None]:
    """Start a process for the first child made inside; it imports modules while the parent is busy."""
    started = _started()
    _ready.append(started)
    stdin = started.process.stdin
    assert stdin is not None
    with suppress(OSError):  # it is dead, and will say why when it is used
        stdin.write(b"".join(map(_packed, modules)))
        stdin.flush()
    try:
        yield
    finally:
        if started in _ready:
            _ready.remove(started)
            _killed(started.process, started.group)
            with suppress(OSError):
                started.process.__exit__(None, None, None)
            started.errors.close()


def messages(
    work: Callable[..., None],
    *args: object,
    seconds: float | None = None,
    memory: int | None = None,
    beat: float = 0.9,
    modules: Sequence[str] = (),
) -> Generator[Any, None, None]:
    """Run ``work(send, *args)`` in a child; yield what it sends, and None after ``beat`` quiet seconds.

    Work and arguments must be picklable, messages never None.  Raises ``ChildStopped`` when the time or
    the memory (bytes of address space) is used up, when the work raises and when the child dies.
    ``modules``, which the work will import, are imported once for all children where that can be.
    Closing the generator kills the child.
    """
    end = None if seconds is None else monotonic() + seconds
    inbox: SimpleQueue[object] = SimpleQueue()
    child = Child(inbox.put, _itself, work, memory=memory, modules=modules)
    try:
        child.order(*args)
        while True:
            left = beat if end is None else end - monotonic()
            if left <= 0:
                raise ChildStopped(f"the time limit of {seconds:g} s is reached")
            message = _next(inbox, min(beat, left))
            if isinstance(message, End):
                break
            yield message
    finally:
        child.kill()
    if message.error and has_listener():
        report(Fault("", "", message.error))
    if message.failure is not None:
        raise ChildStopped(message.failure)


def _itself(work: Callable[..., None]) -> Callable[..., None]:
    return work


def _next(inbox: SimpleQueue[object], seconds: float) -> object:
    try:
        return inbox.get(timeout=seconds)
    except Empty:
        return None


def pickled(thing: object) -> bytes:
    """A thing as it travels, however deeply nested."""
    limit = sys.getrecursionlimit()
    sys.setrecursionlimit(max(limit, DEEP))
    try:
        return pickle.dumps(thing)
    finally:
        sys.setrecursionlimit(limit)


def _packed(order: object) -> bytes:
    """An order as a child reads it."""
    whole = pickled(order)
    return LENGTH.pack(len(whole)) + whole


def _is_child() -> bool:
    """Whether this process was started here: its children then die with its session."""
    return _MAIN in sys.orig_argv or SERVER_MAIN in sys.orig_argv


__all__ = ["Child", "ChildStopped", "End", "Send", "messages", "prepared"]
