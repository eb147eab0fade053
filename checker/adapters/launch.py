"""Confine a process that runs an implementation; as a program, ``launch.py BYTES CMD ARGS...`` becomes it.

Nothing else of the project is imported, so that the program starts quickly and without its paths.
"""

import ctypes
import os
import signal
import sys
from contextlib import suppress

_PR_SET_PDEATHSIG = 1  # prctl(2)
CANNOT_RUN = 127
"""The status of a shell that cannot run a command."""


def end_with_parent() -> None:
    """Have Linux kill this process with the thread that started it."""
    if sys.platform == "linux":
        ctypes.CDLL(None).prctl(_PR_SET_PDEATHSIG, signal.SIGKILL)


def confine(memory: int) -> None:
    """Limit the bytes of data of this process, and have no core written when it crashes."""
    with suppress(ImportError, ValueError, OSError):  # not every platform has limits, or allows these
        import resource

        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        # Not the address space: runtimes of other languages reserve far more than they use.
        resource.setrlimit(resource.RLIMIT_DATA, (memory, memory))


def become(memory: int, command: list[str]) -> None:
    """Become the command; returns never."""
    end_with_parent()
    confine(memory)
    try:
        os.execvp(command[0], command)
    except OSError as error:
        print(f"{command[0]}: {error.strerror}", file=sys.stderr, flush=True)
        os._exit(CANNOT_RUN)


if __name__ == "__main__":
    become(int(sys.argv[1]), sys.argv[2:])
