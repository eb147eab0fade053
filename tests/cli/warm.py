"""Commands in processes that are forked from a warm one, which has loaded the rover: that is most of a start.

Where a test is not about how a program starts but about what it shows, that is the same, and much quicker.
"""

import os
import sys
from collections.abc import Mapping, Sequence
from multiprocessing import get_context
from multiprocessing.connection import Connection
from multiprocessing.context import ForkServerProcess
from pathlib import Path
from typing import TextIO, cast

from rovercheck.checker.model.rover import rover

Streams = tuple[str, str, str]
"""The files that are standard input, output and error: terminals, named pipes, or ``os.devnull``."""

_CONTEXT = get_context("forkserver")
_CONTEXT.set_forkserver_preload([__name__])
PATIENCE = 60.0
"""Seconds for the first start."""
LATE = "rovercheck.checker.commands.shared.output"
"""Looks at the terminal when it is loaded."""


class WarmProcess:
    """A command of rovercheck in a session of its own, as far as tests use ``subprocess.Popen``."""

    def __init__(self, arguments: Sequence[str], streams: Streams, environment: Mapping[str, str]) -> None:
        opened, told = _CONTEXT.Pipe(duplex=False)
        asked = told, tuple(arguments), streams, dict(environment), str(Path.cwd())
        self._process: ForkServerProcess = _CONTEXT.Process(target=_carried_out, args=asked)
        self._process.start()
        told.close()
        if not opened.poll(PATIENCE) or not opened.recv():
            raise TimeoutError("the command does not begin")

    def poll(self) -> int | None:
        return self._process.exitcode

    def kill(self) -> None:
        self._process.kill()

    def send_signal(self, number: int) -> None:
        assert self._process.pid is not None
        os.kill(self._process.pid, number)

    def wait(self, timeout: float | None = None) -> int:
        """The exit code.  Raises ``TimeoutError`` after so many seconds."""
        self._process.join(timeout)
        if self._process.exitcode is None:
            raise TimeoutError(f"the command has not ended after {timeout} s")
        return self._process.exitcode


def _carried_out(
    told: Connection, arguments: Sequence[str], streams: Streams, environment: Mapping[str, str], at: str
) -> None:
    assert LATE not in sys.modules
    os.setsid()  # the terminal that is opened first becomes the controlling one
    for number, (name, way) in enumerate(zip(streams, (os.O_RDWR, os.O_WRONLY, os.O_WRONLY), strict=True)):
        opened = os.open(name, way)
        os.dup2(opened, number)
        os.close(opened)
    told.send(True)  # a terminal that nobody has opened yet looks like one that is closed
    told.close()
    sys.stdin, sys.stdout, sys.stderr = map(_text, range(3), "rww")
    os.environ.clear()
    os.environ.update(environment)
    os.chdir(at)
    sys.argv = ["rovercheck", *arguments]
    from rovercheck.checker.cli import main

    main()


def _text(number: int, way: str) -> TextIO:
    return cast(TextIO, os.fdopen(number, way, closefd=False, encoding="utf-8"))


rover()
