"""Charts and implementation side by side: what the charts require of each step, and the first difference."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from math import isclose

from rovercheck.checker.adapters.implementation import Implementation, Value, Values, run
from rovercheck.checker.compare.stimulus import Stimulus, StimulusPlayer
from rovercheck.checker.conformance.cones import written_by
from rovercheck.checker.conformance.deviations import Deviation
from rovercheck.spec_model.abstraction import Board
from rovercheck.spec_model.abstraction.stamps import NOW
from rovercheck.spec_model.lang.chart import parts
from rovercheck.spec_model.lang.domain import Num
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.evaluate import evaluate
from rovercheck.spec_model.lang.expr import Const
from rovercheck.spec_model.lang.interpret import FiredTransition, Interpreter

NEAR = 1e-6
"""Numbers that differ by no more, in their unit or as a part of the larger one, are equal: single precision
keeps seven digits."""
BATCH = 200
"""Steps that an implementation is given at once."""


@dataclass(frozen=True)
class ComparedStep:
    """The inputs of a step, the outputs that the charts require, and the transitions that they took."""

    inputs: Mapping[str, Value]
    expected: Mapping[str, Value]
    fired: tuple[FiredTransition, ...]


Run = tuple[str, list[ComparedStep]]
"""A run of the charts, and what it is for."""


@dataclass(frozen=True)
class StepDifference:
    """An output that is not as the charts require; ``actual`` is None where it is missing."""

    name: str
    expected: Value
    actual: Value | None


@dataclass(frozen=True)
class StepMismatch:
    """A run whose last step has outputs that the charts do not allow.

    With a ``deviation`` they are those of one part of the board, which was fed with what the implementation
    itself gives upstream; other parts may have differed before (``earlier``: in how many steps).  Without one
    they are all outputs of the first step in which any differs, that of the component that executes first at
    the beginning.  ``small``: the run was made as small as the budget allowed to find.
    """

    board: Board
    steps: tuple[ComparedStep, ...]
    differences: tuple[StepDifference, ...]
    origin: str = ""
    deviation: Deviation | None = None
    earlier: int = 0
    small: bool = False

    @property
    def tick(self) -> int:
        """The number of the step, from 1."""
        return len(self.steps)

    @property
    def transitions(self) -> tuple[FiredTransition, ...]:
        """The transitions that the charts took in that step from power-up, those of the author first."""
        author = author_of(self.board, self.differences[0].name)
        return tuple(sorted(self.steps[-1].fired, key=lambda fired: fired.chart != author))

    @property
    def key(self) -> tuple[object, ...]:
        """Mismatches with one key are one: the same output first, after the same transition of its chart."""
        if self.deviation is not None:
            return (self.board.name, self.deviation.scope)
        first = self.differences[0].name
        author = author_of(self.board, first)
        transitions = [(f.source, f.target, f.order) for f in self.steps[-1].fired if f.chart == author]
        return (self.board.name, first, transitions[-1] if transitions else None)


def takes_for_granted(board: Board) -> bool:
    """Whether the system of a board assumes anything of its inputs."""
    assumed = board.system.assumed
    return not (isinstance(assumed, Const) and assumed.value)


class SteppedCharts:
    """The charts of a board, run on concrete inputs from power-up."""

    def __init__(self, board: Board) -> None:
        self._board = board
        self._reader = board.reader()
        self._interpreter = Interpreter(board.system, measured=True)
        self._assumed = board.system.assumed if takes_for_granted(board) else None

    def valuation(self) -> dict[str, int]:
        """Everything that the charts hold."""
        return self._interpreter.valuation()

    def admits(self, inputs: Values) -> bool:
        """Whether the system takes for granted that such inputs may come now."""
        if self._assumed is None:
            return True
        raw = self._reader.copy().step(inputs)
        return bool(evaluate(self._assumed, {**self._interpreter.valuation(), **raw}))

    def step(self, inputs: Values) -> ComparedStep:
        """One execution.

        Raises ``ModelError`` for inputs without meaning, and for those that the system takes not to come.
        """
        if not self.admits(inputs):
            raise ModelError(f"{self._board.name} assumes that these inputs do not come in this step.")
        fired = self._interpreter.step(self._reader.step(inputs))
        return ComparedStep(inputs, self._board.expected(self._interpreter.valuation()), fired)


def played(board: Board, fields: Mapping[str, tuple[str, ...]], stimulus: Stimulus) -> list[ComparedStep]:
    """What the charts do under a stimulus.

    In place of inputs that the system takes not to come, those of the step before are held; where these may
    not come either, the run ends.
    """
    charts, found = SteppedCharts(board), list[ComparedStep]()
    for inputs in StimulusPlayer(board, fields, charts).steps(stimulus):
        if not charts.admits(inputs):
            inputs = {**(found[-1].inputs if found else board.at_power_up()), NOW: inputs[NOW]}
            if not charts.admits(inputs):
                break
        found.append(charts.step(inputs))
    return found


def rerun(board: Board, inputs: Iterable[Values]) -> list[ComparedStep]:
    """What the charts do under concrete inputs."""
    charts = SteppedCharts(board)
    return [charts.step(one) for one in inputs]


def answers(inputs: Sequence[Values], implementation: Implementation) -> tuple[Values, ...]:
    """What an implementation gives in all steps, starting at power-up.  Raises ``ImplementationError``."""
    implementation.reset()
    found: list[Values] = []
    for start in range(0, len(inputs), BATCH):
        found += run(implementation, inputs[start : start + BATCH])
    return tuple(found)


def differing(steps: Sequence[ComparedStep], outputs: Sequence[Values]) -> int:
    """In how many steps outputs are not as the charts require that run from power-up by themselves."""
    seen: set[str] = set()
    count = 0
    for step, actual in zip(steps, outputs, strict=True):
        if not actual.keys() <= seen:
            seen.update(actual)
        count += differs(step.expected, actual, seen)
    return count


def compared(
    board: Board, steps: Sequence[ComparedStep], implementation: Implementation
) -> StepMismatch | None:
    """The first step in which an implementation differs, starting at power-up.

    Raises ``ImplementationError``.
    """
    implementation.reset()
    seen: set[str] = set()
    for start in range(0, len(steps), BATCH):
        part = steps[start : start + BATCH]
        found = run(implementation, [step.inputs for step in part])
        seen.update(*found)
        for number, (step, actual) in enumerate(zip(part, found, strict=True), start + 1):
            if differs(step.expected, actual, seen):
                different = differences(board, step.expected, actual, seen)
                return StepMismatch(board, tuple(steps[:number]), different)
    return None


def differs(expected: Values, actual: Values, seen: set[str]) -> bool:
    """Whether an output that the implementation has is not as required."""
    for name, value in expected.items():
        got = actual.get(name)
        if got != value and (got is not None or name in seen) and not _close(value, got):
            return True
    return False


def differences(board: Board, expected: Values, actual: Values, seen: set[str]) -> tuple[StepDifference, ...]:
    """All outputs that are not as required, those of what executes first at the beginning."""
    numbers = {o.name for o in board.outputs if isinstance(o.signal.domain.sort, Num)}
    found = [
        StepDifference(name, value, actual.get(name))
        for name, value in expected.items()
        if name in actual or name in seen
        if not (_close(value, actual.get(name)) if name in numbers else actual.get(name) == value)
    ]
    order = writers(board)
    return tuple(sorted(found, key=lambda d: order[d.name][0]))


def _close(expected: Value, actual: Value | None) -> bool:
    """Whether two numbers are equal; enumerations and truth values lie 1 apart."""
    return actual is not None and isclose(expected, actual, rel_tol=NEAR, abs_tol=NEAR)


def author_of(board: Board, output: str) -> str:
    """The chart or block that writes an output last."""
    return writers(board)[output][1]


def writers(board: Board) -> Mapping[str, tuple[int, str]]:
    """For each output, the place in the order of execution and the name of what writes it."""
    return _writers(board.name, board)


@cache
def _writers(name: str, board: Board) -> Mapping[str, tuple[int, str]]:
    found: dict[str, tuple[int, str]] = {}
    for number, part in enumerate(parts(board.system.components)):
        for output in board.outputs:
            if output.var.name in written_by(part):
                found[output.name] = (number, part.name)
    return found
