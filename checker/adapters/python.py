"""Runs a Python class: ``python:MODULE:CLASS``, or ``python:FILE.py:CLASS``."""

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from rovercheck.checker.adapters import LIMITS, AdapterLimits, python_calls
from rovercheck.checker.adapters.child import PowerUp, RunningImplementation, reason
from rovercheck.checker.adapters.implementation import Implementation, Value, Values
from rovercheck.checker.adapters.process import Process, check_names, failure, ours

if TYPE_CHECKING:
    from rovercheck.spec_model.abstraction import Board

KIND = "python"
FORM = "python:MODULE:CLASS"
SUMMARY = "a Python class with step(inputs) -> outputs"


def start(
    what: str, board: "Board", limits: AdapterLimits = LIMITS, *, isolated: bool = True
) -> Implementation:
    """The class at an address, in a process of its own unless ``isolated`` is false.

    In this process nothing is limited, and what the class keeps in its module survives a reset.  Raises
    ``ImplementationError`` if it cannot be started.
    """
    address, names = f"{KIND}:{what}", [o.name for o in board.outputs]
    if not isolated:
        return InProcess(address, what, board)
    inputs, outputs = board.interface.places()
    connect = partial(
        ours, python_calls.__name__, {"target": what, "inputs": inputs, "outputs": outputs}, limits
    )
    return Process(address, connect, names, limits)


def carried(what: str) -> tuple[Path, ...]:
    """The file of the class; none for a module, which is installed wherever it runs."""
    module, _, _ = what.rpartition(":")
    return (Path(module),) if module.endswith(".py") else ()


def moved(what: str, there: Callable[[Path], Path]) -> str:
    """The address of a class in a file that is elsewhere."""
    module, _, name = what.rpartition(":")
    return f"{there(Path(module))}:{name}" if module.endswith(".py") else what


class InProcess:
    """A class that is called directly: quick, for code that is trusted."""

    def __init__(self, address: str, target: str, board: "Board") -> None:
        self._address, self._names, self._steps = address, frozenset(o.name for o in board.outputs), 0
        with self._failing():
            self._power_up: PowerUp = python_calls.made(target, *board.interface.places())
        self.reset()

    def reset(self) -> None:
        """Return to power-up."""
        self._steps = 0
        with self._failing():
            self._running: RunningImplementation = self._power_up()

    def step(self, inputs: Values) -> Mapping[str, Value]:
        """Execute one step."""
        self._steps += 1
        with self._failing():
            found = self._running.step(inputs)
            check_names(found, self._names)
            return found

    def close(self) -> None:
        """Nothing runs outside."""

    @contextmanager
    def _failing(self) -> Iterator[None]:
        try:
            yield
        except Exception as error:
            raise failure(self._address, self._steps, reason(error)) from error
