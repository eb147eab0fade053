"""A run as firmware sees it: the values given to a board in each step, and what it must then produce."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from enum import StrEnum
from typing import TypeVar

Value = bool | int | float


class SignalKind(StrEnum):
    """What a signal holds: a truth value, a whole number (also of an enumeration), a number, a time."""

    BOOL = "bool"
    WHOLE = "whole"
    NUMBER = "number"
    CLOCK = "clock"
    """The time of the step, in ms of the board's clock."""
    STAMP = "stamp"
    """An earlier time of that clock."""


@dataclass(frozen=True)
class StepSignal:
    """An input or output of a board; ``initial`` is its value before the first step."""

    name: str
    kind: SignalKind
    initial: Value
    doc: str = ""


@dataclass(frozen=True)
class BoardStep:
    """All inputs of one execution but the clock, and the outputs required after it; others may be anything.

    A stamp is given as the milliseconds that it lies before the step, or None where it is as before.
    """

    inputs: Mapping[str, Value | None]
    outputs: Mapping[str, Value]


@dataclass(frozen=True)
class BoardRun:
    """The steps of one board from power-up, ``tick_ms`` apart, the first at ``tick_ms``.

    ``implementation`` is the one that is run unless another is named, ``KIND:WHAT``.
    """

    board: str
    tick_ms: int
    inputs: tuple[StepSignal, ...]
    outputs: tuple[StepSignal, ...]
    steps: tuple[BoardStep, ...]
    implementation: str


Given = TypeVar("Given", bound=Value | None)
Cells = Mapping[str, Value | None]
Changes = tuple[int, Cells, Cells]
"""Equal steps in a row: how many, and the inputs and the outputs that differ from the step before."""


def in_rows(
    inputs: Mapping[str, Given], outputs: Cells, steps: Iterable[tuple[Mapping[str, Given], Cells]]
) -> list[tuple[int, Mapping[str, Given], Cells]]:
    """Steps of inputs and required outputs as few changes, from what holds before the first."""
    found: list[tuple[int, Mapping[str, Given], Cells]] = []
    for given, required in steps:
        changed = {n: v for n, v in given.items() if v != inputs[n]}
        wanted = {n: v for n, v in required.items() if v != outputs[n]}
        if found and not changed and not wanted:
            found[-1] = (found[-1][0] + 1, *found[-1][1:])
        else:
            found.append((1, changed, wanted))
        inputs, outputs = given, required
    return found


def held(run: BoardRun) -> list[Changes]:
    """The steps as few changes.  Before the first, inputs are as at power-up, stamps as they were, and
    outputs may be anything (None)."""
    inputs: Cells = {
        s.name: None if s.kind is SignalKind.STAMP else s.initial
        for s in run.inputs
        if s.kind is not SignalKind.CLOCK
    }
    outputs: Cells = {s.name: None for s in run.outputs}
    return in_rows(
        inputs, outputs, ((s.inputs, {name: s.outputs.get(name) for name in outputs}) for s in run.steps)
    )
