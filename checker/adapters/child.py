"""The inside of a process that runs an implementation: it forks at every power-up, from untouched memory.

The first process loads the implementation and then only forks.  Its child carries out steps; whatever they
leave behind in static variables or modules ends with it.  A child that dies takes its parent along in the
same way, so that the other end sees one process.
"""

import json
import mmap
import os
import signal
import sys
import traceback
from collections.abc import Callable, Mapping
from contextlib import suppress
from importlib import import_module
from pathlib import Path
from typing import Protocol

from rovercheck.checker.adapters import lines
from rovercheck.checker.adapters.implementation import Value, Values
from rovercheck.checker.adapters.launch import confine, end_with_parent

CHUNK = 1 << 16


class RunningImplementation(Protocol):
    """An implementation that was powered up."""

    def step(self, inputs: Values) -> Mapping[str, Value]: ...

    def end(self) -> None: ...


PowerUp = Callable[[], RunningImplementation]


class LineReader:
    """Lines from a file descriptor."""

    def __init__(self, number: int) -> None:
        self._number, self._rest = number, b""

    def next(self) -> bytes | None:
        """The next line, or None at the end."""
        while b"\n" not in self._rest:
            heard = os.read(self._number, CHUNK)
            if not heard:
                return None
            self._rest += heard
        line, _, self._rest = self._rest.partition(b"\n")
        return line


class RefusedStep(Exception):
    """An implementation that cannot be run, or a step that has no meaning; the message is for a person."""


def main() -> None:
    """The main program: resets and steps on standard input, answers on what was standard output."""
    order = json.loads(sys.argv[1])
    end_with_parent()
    confine(order["memory"])
    orders, answers = LineReader(os.dup(0)), os.dup(1)
    os.dup2(os.open(os.devnull, os.O_RDONLY), 0)  # the implementation must not read orders
    os.dup2(2, 1)  # nor may what it prints look like an answer
    sys.stdout = os.fdopen(1, "w", buffering=1, errors="replace", closefd=False)
    sys.path.append(str(Path.cwd()))
    if orders.next() is None:
        return
    try:
        power_up: PowerUp = import_module(order["module"]).made(**order["options"])
    except (Exception, SystemExit) as error:
        return _answer(answers, {"error": reason(error)})
    _serve(power_up, orders, answers)


def _serve(power_up: PowerUp, orders: LineReader, answers: int) -> None:
    """Fork at every power-up until the other end has enough, or a child fails."""
    again = mmap.mmap(-1, 1)
    while True:
        again[0] = 0
        child = os.fork()
        if child == 0:
            end_with_parent()
            again[0] = _live(power_up, orders, answers)
            os._exit(0)
        _, status = os.waitpid(child, 0)
        if not again[0]:
            _end_like(status)


def _live(power_up: PowerUp, orders: LineReader, answers: int) -> bool:
    """Carry out steps from power-up on; true when the next power-up is asked for."""
    try:
        running = power_up()
        _answer(answers, {})
        while (line := orders.next()) is not None:
            order = json.loads(line)
            if "step" not in order:
                running.end()
                return True
            _answer(answers, running.step(lines.values(order["step"])))
        running.end()
    except (Exception, SystemExit) as error:
        _answer(answers, {"error": reason(error)})
    return False


def _answer(number: int, message: Mapping[str, object]) -> None:
    line = lines.encoded(message)
    while line:
        line = line[os.write(number, line) :]


def reason(error: BaseException) -> str:
    """What went wrong, and where in the code of the implementation."""
    if isinstance(error, MemoryError):
        return "the memory limit is reached"
    frames = traceback.extract_tb(error.__traceback__)
    if not frames or Path(frames[-1].filename).parent == Path(__file__).parent:  # said by us, in whole
        return f"the input {error} was not given" if isinstance(error, KeyError) else str(error)
    return f"{type(error).__name__}: {error} ({Path(frames[-1].filename).name}, line {frames[-1].lineno})"


def _end_like(status: int) -> None:
    """End as the child did."""
    if os.WIFSIGNALED(status):
        number = os.WTERMSIG(status)
        with suppress(OSError, ValueError):  # SIGKILL has no handler
            signal.signal(number, signal.SIG_DFL)
        os.kill(os.getpid(), number)
    os._exit(os.WEXITSTATUS(status))
