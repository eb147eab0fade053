"""The runs of a cross-check, recorded once and replayed against thousands of mutants.

What a cross-check tries until it finds something does not depend on the implementation: so a mutant differs
in a recorded run if and only if the cross-check finds it there, and the charts need not run again.
"""

import json
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from importlib import import_module
from typing import Any, get_type_hints

from rovercheck.checker.adapters.firmware import FirmwarePlaces, places
from rovercheck.checker.adapters.implementation import Values
from rovercheck.checker.adapters.records import builder, reader
from rovercheck.checker.compare.beside import differs
from rovercheck.spec_model.abstraction import boards

CLASSES = {
    "board1": ("rovercheck.supervisor.board1.board", "Board1"),
    "board2": ("rovercheck.supervisor.board2.board", "Board2"),
}
PowerUp = type[Any]


@dataclass(frozen=True)
class Step:
    """The inputs of a step, what the charts require, and what the real supervisor takes and gives."""

    inputs: Values
    expected: Values
    taken: Any
    given: Any


@dataclass(frozen=True)
class Run:
    """One run from power-up, and the part of the cross-check that it belongs to."""

    phase: str
    steps: Sequence[Step]


@dataclass(frozen=True)
class Found:
    """How a fault showed: in which phase, in which step of all that were run, and in which output."""

    phase: str
    steps: int
    what: str


class Disagreement(Exception):
    """The supervisor that is to be mutated is itself not as the charts require."""


def supervisor(board: str) -> PowerUp:
    """The class of a board as it is imported now."""
    module, name = CLASSES[board]
    found: PowerUp = getattr(import_module(module), name)
    return found


def taken_by(power_up: PowerUp) -> PowerUp:
    """The record of inputs that its ``step`` asks for."""
    hints = get_type_hints(power_up.step)
    found: PowerUp = hints["inputs"]
    return found


def prepared(board: str, runs: Iterable[tuple[str, Sequence[tuple[Values, Values]]]]) -> Iterator[Run]:
    """Runs of inputs and required outputs, ready for replay.

    Raises ``Disagreement`` if the supervisor as it is imported now does not conform in them.
    """
    power_up, held = supervisor(board), places(boards()[board])
    record = taken_by(power_up)
    build = builder(record, held.inputs_of(record))
    for phase, steps in runs:
        instance = power_up()
        ready: list[Step] = []
        for inputs, expected in steps:
            taken = build(json.loads(json.dumps(inputs)))  # other objects in each step, as from an adapter
            given = instance.step(taken)
            if wrong := _difference(held, given, expected):
                raise Disagreement(f"{board}, {phase}, step {len(ready) + 1}: {wrong}")
            ready.append(Step(inputs, expected, taken, given))
        yield Run(phase, ready)


def search(board: str, runs: Iterable[Run]) -> Found | int:
    """The first difference of the supervisor as it is imported now; else how many steps agreed.

    Whatever it raises is a difference too: an implementation that raises has no output.
    """
    done, phase = 0, "start"
    try:
        power_up, held = supervisor(board), places(boards()[board])
        record = taken_by(power_up)
        build = builder(record, held.inputs_of(record))
        for run in runs:
            instance, phase = power_up(), run.phase
            for step in run.steps:
                done += 1
                same = type(step.taken) is record
                given = instance.step(step.taken if same else build(step.inputs))
                if given != step.given and (wrong := _difference(held, given, step.expected)):
                    return Found(phase, done, wrong)
    except Exception as error:
        return Found(phase, done, type(error).__name__)
    return done


def _difference(held: FirmwarePlaces, given: Any, expected: Values) -> str:
    """The first output that is missing or not what the charts require; "" if all are."""
    actual = reader(held.outputs_of(type(given)))(given)
    if not differs(expected, actual, set(expected)):
        return ""
    return next(name for name in expected if differs({name: expected[name]}, actual, set(expected)))
