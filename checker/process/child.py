"""The inside of a child process: it carries out orders until its parent ends it, or ends itself.

The parent's side, and what travels between the two, is ``checker.process.isolate``.
"""

import ctypes
import os
import pickle
import signal
import struct
import sys
import threading
from collections.abc import Callable
from contextlib import suppress
from importlib import import_module
from queue import SimpleQueue

from rovercheck.checker.process.faults import described, is_fault, starved
from rovercheck.checker.process.garbage import collect_seldom
from rovercheck.checker.process.isolate import DEEP, LENGTH, End, Send, pickled

_PR_SET_PDEATHSIG = 1  # prctl(2)


def child() -> None:
    """The main program of a child: orders on standard input, messages on standard output."""
    collect_seldom()
    end_with_parent()
    out = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # what a library prints must not look like a message
    sys.setrecursionlimit(DEEP)
    orders: SimpleQueue[bytes] = SimpleQueue()
    threading.Thread(target=_listen, args=(orders,), daemon=True).start()

    def send(message: object) -> None:
        whole = pickled(message)  # first whole, then written: half a message could not be read
        out.write(whole)
        out.flush()

    _carry_out(orders, send)
    os._exit(0)


def _carry_out(orders: SimpleQueue[bytes], send: Send) -> None:
    """One order after the other, for ever; returns only when the first message cannot be obeyed."""
    try:
        while isinstance(first := pickle.loads(orders.get()), str):
            import_module(first)
        do = _made(*first)
    except (Exception, SystemExit) as error:
        return send(End(_reason(error), dead=True))
    while True:
        try:
            do(send, *pickle.loads(orders.get()))
        except (Exception, SystemExit) as error:  # a library that calls exit() does not end a search unheard
            send(End(_reason(error), error=described(error) if is_fault(error) else ""))
        else:
            send(End(None))


def _made(
    memory: int | None, make: Callable[..., Callable[..., None]], args: tuple[object, ...]
) -> Callable[..., None]:
    """The function that carries out orders, after the memory is confined."""
    _confine(memory)
    made: Callable[..., None] = make(*args)
    return made


def _reason(error: BaseException) -> str:
    if isinstance(error, MemoryError) and str(error):
        return str(error)
    return "the memory limit is reached" if starved(error) else f"{type(error).__name__}: {error}"


def _listen(orders: SimpleQueue[bytes]) -> None:
    """Take orders until the parent closes the pipe or dies."""
    with suppress(OSError, struct.error):
        while True:
            [length] = LENGTH.unpack(sys.stdin.buffer.read(LENGTH.size))
            orders.put(sys.stdin.buffer.read(length))
    os._exit(1)


def end_with_parent() -> None:
    """Have Linux kill this process with its parent: a solver that holds Python's lock stops ``_listen``."""
    if sys.platform == "linux":
        ctypes.CDLL(None).prctl(_PR_SET_PDEATHSIG, signal.SIGKILL)


def _confine(memory: int | None) -> None:
    if memory is None:
        return
    with suppress(ImportError, ValueError, OSError):  # not every platform has limits, or allows this one
        import resource

        resource.setrlimit(resource.RLIMIT_AS, (memory, memory))


__all__ = ["child", "end_with_parent"]
