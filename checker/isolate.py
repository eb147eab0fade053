"""Work in a child process that can be killed at any moment: a solver cannot be trusted to stop.

The work is a function of a module.  It gets a ``send`` function, whose messages arrive in the
parent one by one.  The child dies when the time is over, when the parent stops listening (Ctrl-C
too) and when the parent dies.
"""

import os
import pickle
import signal
import subprocess
import sys
import tempfile
import threading
from collections.abc import Callable, Generator, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from queue import Empty, Queue
from time import monotonic
from typing import IO, Any

Send = Callable[[object], None]
_DEEP = 100_000  # nested formulas; Python's own limit is about 250 levels of a pickled one
_MAIN = "from checker.isolate import child; child()"


class Stopped(Exception):
    """The work did not come to its end; the message says why, for a person."""


@dataclass(frozen=True)
class _End:
    """The child's last word: what went wrong, or None."""

    failure: str | None


def messages(
    work: Callable[..., None],
    *args: object,
    seconds: float | None = None,
    memory: int | None = None,
    beat: float = 0.9,
) -> Generator[Any, None, None]:
    """Run ``work(send, *args)`` in a child; yield what it sends, and None after ``beat`` quiet seconds.

    Work and arguments must be picklable, messages never None.  Raises ``Stopped`` when the time or
    the memory (bytes of address space) is used up, when the work raises and when the child dies.
    Closing the generator kills the child.
    """
    end = None if seconds is None else monotonic() + seconds
    job = _pickled((memory, work, args))
    with tempfile.TemporaryFile() as errors, _child(job, errors) as (process, inbox):
        while True:
            left = beat if end is None else end - monotonic()
            if left <= 0:
                raise Stopped(f"the time limit of {seconds:g} s is reached")
            message = _next(inbox, min(beat, left))
            if isinstance(message, _End):
                break
            yield message
        if message.failure is not None:
            raise Stopped(message.failure or _cause(process, errors))


@contextmanager
def _child(job: bytes, errors: IO[bytes]) -> Iterator[tuple[subprocess.Popen[bytes], Queue[object]]]:
    """A child at work on a job, in a session of its own so that Ctrl-C reaches the parent alone."""
    path = os.pathsep.join(filter(None, sys.path))
    with subprocess.Popen(
        [sys.executable, "-c", _MAIN],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=errors,
        # One hash seed, so that the same question is put to a solver in the same words every time.
        env={**os.environ, "PYTHONPATH": path, "PYTHONHASHSEED": "0"},
        start_new_session=True,
    ) as process:
        assert process.stdin is not None and process.stdout is not None
        inbox: Queue[object] = Queue()
        feeder = threading.Thread(target=_feed, args=(process.stdin, job), daemon=True)
        reader = threading.Thread(target=_read, args=(process.stdout, inbox), daemon=True)
        try:
            feeder.start()
            reader.start()
            yield process, inbox
        finally:
            process.kill()
            feeder.join()
            reader.join()
            with suppress(OSError):  # what was not written yet
                process.stdin.close()


def _feed(stdin: IO[bytes], job: bytes) -> None:
    with suppress(OSError):
        stdin.write(job)
        stdin.flush()  # and left open: the child ends when it is closed


def _read(stdout: IO[bytes], inbox: Queue[object]) -> None:
    """Move messages to the inbox until the child ends."""
    with suppress(EOFError, OSError, ValueError, pickle.UnpicklingError):
        while True:
            inbox.put(pickle.load(stdout))
    inbox.put(_End(""))


def _next(inbox: Queue[object], seconds: float) -> object:
    try:
        return inbox.get(timeout=seconds)
    except Empty:
        return None


def _cause(process: subprocess.Popen[bytes], errors: IO[bytes]) -> str:
    """Why a child ended without a word."""
    status = process.wait()
    if status < 0:
        return f"the solver process was ended by {signal.Signals(-status).name}"
    errors.seek(0)
    said = errors.read().decode(errors="replace").strip().splitlines()
    return f"the solver process ended with status {status}" + (f": {said[-1]}" if said else "")


def _pickled(job: object) -> bytes:
    limit = sys.getrecursionlimit()
    sys.setrecursionlimit(max(limit, _DEEP))
    try:
        return pickle.dumps(job)
    finally:
        sys.setrecursionlimit(limit)


# --- in the child -----------------------------------------------------------------------------------


def child() -> None:
    """The main program of the child: a job on standard input, messages on standard output."""
    out = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # what a library prints must not look like a message
    sys.setrecursionlimit(_DEEP)

    def send(message: object) -> None:
        pickle.dump(message, out)
        out.flush()

    send(_End(_failure(send)))
    os._exit(0)


def _failure(send: Send) -> str | None:
    """Do the job; what went wrong, or None."""
    try:
        memory, work, args = pickle.load(sys.stdin.buffer)
        threading.Thread(target=_die_with_parent, daemon=True).start()
        _confine(memory)
        work(send, *args)
    except MemoryError:
        return "the memory limit is reached"
    except Exception as error:
        full = "out of memory" in str(error)
        return "the memory limit is reached" if full else f"{type(error).__name__}: {error}"
    return None


def _die_with_parent() -> None:
    while os.read(0, 1):
        pass
    os._exit(1)


def _confine(memory: int | None) -> None:
    if memory is None:
        return
    with suppress(ImportError, ValueError, OSError):  # not every platform has limits, or allows this one
        import resource

        resource.setrlimit(resource.RLIMIT_AS, (memory, memory))
