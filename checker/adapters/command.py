"""Runs any program that speaks JSON lines: ``command:CMD ARGS`` (docs/adapters.md)."""

import shlex
import shutil
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from rovercheck.checker.adapters import LIMITS, AdapterLimits
from rovercheck.checker.adapters.implementation import Implementation, ImplementationError
from rovercheck.checker.adapters.process import Process, theirs

if TYPE_CHECKING:
    from rovercheck.spec_model.abstraction import Board

KIND = "command"
FORM = "command:CMD ARGS"
SUMMARY = "a program that answers JSON lines with JSON lines"


def start(what: str, board: "Board", limits: AdapterLimits = LIMITS) -> Implementation:
    """The program, run without a shell.  Raises ``ImplementationError`` if it cannot be started."""
    address = f"{KIND}:{what}"
    try:
        command = shlex.split(what)
    except ValueError as error:
        raise ImplementationError(f"{address}: {error}; close every quote.") from None
    if not command:
        raise ImplementationError(f"{address}: there is no command; write the program and its arguments.")
    if shutil.which(command[0]) is None:
        raise ImplementationError(
            f"{address}: there is no program {command[0]!r} to run; write its path or a name on PATH."
        )
    return Process(address, partial(theirs, command, limits), [o.name for o in board.outputs], limits)


def carried(what: str) -> tuple[Path, ...]:
    """Raises ``ImplementationError``: nobody knows what the program is made of."""
    raise ImplementationError(
        f"{KIND}:{what} is a program of this machine; leave it out, or use --jobs for several of it here."
    )


def moved(what: str, there: Callable[[Path], Path]) -> str:
    """As it is: the program is not sent."""
    return what
