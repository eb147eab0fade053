"""A test of a board: the values given to its firmware in each step, and what it must then produce."""

from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum

from rovercheck.spec_model.lang.system import TICK_MS

Value = bool | int | float


class SignalKind(StrEnum):
    """What a signal holds: a truth value, a whole number (also of an enumeration), a number, a time."""

    BOOL = "bool"
    WHOLE = "whole"
    NUMBER = "number"
    CLOCK = "clock"
    """The time of the step, in ms of the board's 32-bit clock."""
    STAMP = "stamp"
    """An earlier time of that clock, 0 at power-up."""


@dataclass(frozen=True)
class StepSignal:
    """An input or output of a board; ``initial`` is its value before the first step."""

    name: str
    kind: SignalKind
    initial: Value
    doc: str = ""


@dataclass(frozen=True)
class BoardUnderTest:
    """The signals of a board, one of the inputs its clock.

    ``implementation`` is the one that is run unless another is named, ``KIND:WHAT``.  Steps are ``tick_ms``
    apart.  ``model`` is the file or folder of the user's own model that it is of.
    """

    name: str
    inputs: tuple[StepSignal, ...]
    outputs: tuple[StepSignal, ...]
    implementation: str = ""
    tick_ms: int = TICK_MS
    model: str = ""


@dataclass(frozen=True)
class BoardStep:
    """All inputs of one execution, and the outputs required after it; others may be anything."""

    inputs: Mapping[str, Value]
    outputs: Mapping[str, Value]


@dataclass(frozen=True)
class BoardTest:
    """The steps of a board from power-up; ``goals`` are what they reach, in words.

    Tests of one board have names that differ.
    """

    board: BoardUnderTest
    name: str
    steps: tuple[BoardStep, ...]
    goals: tuple[str, ...] = ()
