"""In which outputs a planted difference shows alone: the firmware with it beside the one without it.

The charts are not asked, nor anything that looks for differences: the firmware without it conforms.
"""

from collections.abc import Iterator, Mapping, Sequence
from contextlib import closing, contextmanager
from dataclasses import dataclass, field
from functools import cache
from math import isclose
from pathlib import Path
from tempfile import TemporaryDirectory

from benchmarks.twins.firmware import Firmware, Planted
from rovercheck.checker.adapters import start
from rovercheck.checker.adapters.implementation import Implementation, Value, Values, run
from rovercheck.checker.compare.beside import NEAR
from rovercheck.checker.compare.check import recorded_suite

Inputs = Sequence[Mapping[str, Value]]
"""The inputs of a run, from power-up."""


@dataclass
class Exposure:
    """Where a difference shows alone: outputs at its first step in some run, and in any step of any run."""

    first: set[str] = field(default_factory=set)
    ever: set[str] = field(default_factory=set)
    runs: list[int] = field(default_factory=list)
    """The runs in which it shows."""
    first_step: bool = False
    """Whether it shows in the first step of some run."""


@contextmanager
def running(firmware: Firmware, planted: Sequence[Planted] = ()) -> Iterator[Implementation]:
    """The firmware with these differences, at power-up."""
    with TemporaryDirectory() as folder:
        address = firmware.written(Path(folder), planted)
        with closing(start(address, firmware.board)) as implementation:
            yield implementation


def outputs(implementation: Implementation, inputs: Inputs) -> Sequence[Values]:
    """What it gives in a run from power-up."""
    implementation.reset()
    return run(implementation, inputs)


@cache
def inputs_of(board: str, examples: int) -> tuple[Inputs, ...]:
    """The runs that ``rovercheck compare`` tries first, with so many random ones."""
    suite = recorded_suite(board, "ci", examples)
    return tuple([dict(inputs) for inputs, _ in one.steps(suite.board)] for one in suite.runs)


@cache
def of_base(firmware: Firmware, examples: int) -> tuple[Sequence[Values], ...]:
    """What the firmware gives in these runs before anything is planted."""
    with running(firmware) as base:
        return tuple(outputs(base, inputs) for inputs in inputs_of(firmware.board_name, examples))


def exposure(firmware: Firmware, planted: Planted, examples: int = 0, enough: int = 0) -> Exposure:
    """Where one difference shows alone in the runs, or in the first so many that show it."""
    found = Exposure()
    with running(firmware, [planted]) as faulty:
        for number, inputs in enumerate(inputs_of(firmware.board_name, examples)):
            _note(found, number, of_base(firmware, examples)[number], outputs(faulty, inputs))
            if enough and len(found.runs) >= enough:
                break
    return found


def _note(found: Exposure, number: int, required: Sequence[Values], given: Sequence[Values]) -> None:
    shown = False
    for step, (one, other) in enumerate(zip(required, given, strict=True)):
        if one == other:
            continue
        different = differing(one, other)
        if different and not shown:
            shown = True
            found.first |= different
            found.runs.append(number)
            found.first_step |= step == 0
        found.ever |= different


def differing(one: Values, other: Values) -> set[str]:
    """The outputs of both that are not the same, numbers within what the cross-check allows."""
    return {
        name
        for name in one.keys() & other.keys()
        if one[name] != other[name] and not isclose(one[name], other[name], rel_tol=NEAR, abs_tol=NEAR)
    }


def shows_among(firmware: Firmware, planted: Planted, others: Sequence[Planted], examples: int) -> bool:
    """Whether a difference shows in any run of the firmware that has the others, too: they may mask it."""
    without = [one for one in others if one is not planted]
    with running(firmware, [*without, planted]) as whole, running(firmware, without) as rest:
        return any(
            bool(one != other and differing(one, other))
            for inputs in inputs_of(firmware.board_name, examples)
            for one, other in zip(outputs(rest, inputs), outputs(whole, inputs), strict=True)
        )
