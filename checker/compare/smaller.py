"""Making a mismatch small: fewer steps, calm inputs, fewer changes, plainer values, the same difference.

A run is taken apart into columns, one for each input: what it is in each step; of a stamp, how many ms before
the step it was renewed, or None.  So a step can be left out without the clock noticing.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

from rovercheck.checker.adapters.implementation import Implementation, ImplementationError, Value, Values
from rovercheck.checker.compare.beside import (
    StepDifference,
    StepMismatch,
    answers,
    compared,
    differing,
    rerun,
    takes_for_granted,
)
from rovercheck.checker.compare.environment import Environment
from rovercheck.checker.compare.result import ALLOWED
from rovercheck.checker.compare.run_follower import RecordedRun, RunFollower
from rovercheck.checker.conformance.deviations import Deviation, scope_of
from rovercheck.checker.testgen.scripts import script, steps
from rovercheck.spec_model.abstraction import Board
from rovercheck.spec_model.abstraction.signals import units
from rovercheck.spec_model.abstraction.stamps import NOW
from rovercheck.spec_model.lang.errors import ModelError

Column = tuple[Value | None, ...]


@dataclass(frozen=True)
class InputColumns:
    """A run of concrete inputs, column by column."""

    start_ms: int
    columns: Mapping[str, Column]

    def __len__(self) -> int:
        return len(next(iter(self.columns.values())))

    def inputs(self, board: Board) -> list[dict[str, Value]]:
        """The inputs of each step."""
        moments = [
            dict(zip(self.columns, row, strict=True)) for row in zip(*self.columns.values(), strict=True)
        ]
        return list(steps(board, moments, self.start_ms))

    def with_column(self, name: str, column: Column) -> "InputColumns":
        return InputColumns(self.start_ms, {**self.columns, name: column})

    def without(self, first: int, count: int) -> "InputColumns":
        """Some steps left out."""
        kept = {name: c[:first] + c[first + count :] for name, c in self.columns.items()}
        return InputColumns(self.start_ms, kept)


def columns(board: Board, inputs: Sequence[Values]) -> InputColumns:
    """Concrete inputs taken apart.  Raises ``ModelError`` for steps that are not 20 ms apart."""
    moments = script(board, inputs)
    return InputColumns(int(inputs[0][NOW]), {name: tuple(m[name] for m in moments) for name in moments[0]})


class Budget:
    """Steps that may still be run."""

    def __init__(self, steps: int) -> None:
        self.left = steps

    def take(self, steps: int) -> bool:
        """Whether there is enough for so many; they are then spent."""
        self.left -= steps
        return self.left >= 0


def mismatch_of(run: RecordedRun, deviation: Deviation) -> StepMismatch:
    """A deviation where it was first met: in the last step of a run."""
    step, actual = run.steps[-1], run.outputs[-1]
    told: dict[str, StepDifference] = {}
    for one in deviation.first.differences:
        expected = units(one.output.var.domain, one.expected[0]) if one.expected else None
        if expected is None:
            expected = step.expected.get(one.output.name, one.output.signal.initial)
        told[one.output.name] = StepDifference(one.output.name, expected, actual.get(one.output.name))
    earlier = differing(run.steps[:-1], run.outputs[:-1])
    return StepMismatch(run.board, run.steps, tuple(told.values()), run.origin, deviation, earlier)


def smaller(
    env: Environment,
    mismatch: StepMismatch,
    implementation: Implementation,
    budget: Budget | None = None,
    follower: RunFollower | None = None,
) -> StepMismatch:
    """A mismatch with the same key in a run that is as small as the budget allows to find."""
    budget = budget or Budget(ALLOWED.budget)
    if budget.left <= 0:
        return mismatch
    work = _Work(env, mismatch, implementation, budget, follower)
    before = None
    _fewer_steps(work, len(work.run) // 8)
    _calm_together(work)
    while before != work.run:
        before = work.run
        _fewer_steps(work)
        for name in before.columns:
            _calmer(work, name)
            _fewer_changes(work, name)
    for name in before.columns:
        _plainer(work, name)
    return work.made()


class _Work:
    """The smallest run so far."""

    def __init__(
        self,
        env: Environment,
        mismatch: StepMismatch,
        implementation: Implementation,
        budget: Budget,
        follower: RunFollower | None,
    ) -> None:
        self.env, self.budget = env, budget
        self._implementation = implementation
        self._mismatch, self._deviation = mismatch, mismatch.deviation
        self._follower = follower or RunFollower(env.board)
        self._outputs: tuple[Values, ...] = ()
        self.run = columns(env.board, [step.inputs for step in mismatch.steps])

    def accepts(self, run: InputColumns) -> bool:
        """Take the run over if it has the same mismatch."""
        if run == self.run:
            return True
        if not len(run) or not self.budget.take(len(run)):
            return False
        try:
            found = self._same(run) if self._deviation is None else self._followed(run, self._deviation)
        except (ImplementationError, ModelError):  # not the difference that is looked for
            return False
        if found is not None:
            self.run = found
        return found is not None

    def _same(self, run: InputColumns) -> InputColumns | None:
        """The run up to the first difference from the charts as a whole."""
        board = self.env.board
        found = compared(board, rerun(board, run.inputs(board)), self._implementation)
        if found is None or found.key != self._mismatch.key:
            return None
        self._mismatch = replace(found, origin=self._mismatch.origin)
        return columns(board, [step.inputs for step in found.steps])

    def _followed(self, run: InputColumns, deviation: Deviation) -> InputColumns | None:
        """The run up to the same mismatch of the same part."""
        inputs = run.inputs(self.env.board)
        if takes_for_granted(self.env.board):
            rerun(self.env.board, inputs)
        outputs = answers(inputs, self._implementation)
        found = self._follower.first(inputs, outputs, scope_of(deviation.first))
        if found is None:
            return None
        self._deviation = replace(deviation, first=found)
        self._outputs = outputs[: found.tick]
        return columns(self.env.board, inputs[: found.tick])

    def made(self) -> StepMismatch:
        """The mismatch in the smallest run."""
        if self._deviation is None or not self._outputs:
            return replace(self._mismatch, small=True)
        board, origin = self.env.board, self._mismatch.origin
        steps = tuple(rerun(board, self.run.inputs(board)))
        return replace(
            mismatch_of(RecordedRun(board, origin, steps, self._outputs), self._deviation), small=True
        )


def _calm_together(work: _Work) -> None:
    """Calm many inputs at once, then ever fewer."""
    names = list(work.run.columns)
    size = len(names)
    while size:
        for first in range(0, len(names), size):
            run = work.run
            for name in names[first : first + size]:
                run = run.with_column(name, (work.env.calm[name],) * len(run))
            work.accepts(run)
        size //= 2


def _fewer_steps(work: _Work, least: int = 1) -> None:
    """Leave out steps: large pieces first, then ever smaller ones."""
    size = len(work.run)
    while size >= max(1, least):
        first = max(0, len(work.run) - size)
        while first >= 0 and len(work.run) > 1:
            if not work.accepts(work.run.without(first, min(size, len(work.run) - first))) and first == 0:
                break
            first = min(max(0, first - size), max(0, len(work.run) - size)) if first else -1
        size //= 2


def _calmer(work: _Work, name: str) -> None:
    """Hold one value throughout: the calm one, else one of its own."""
    column = work.run.columns[name]
    for value in dict.fromkeys((work.env.calm[name], column[0], column[-1])):
        if work.accepts(work.run.with_column(name, (value,) * len(column))):
            return


def _fewer_changes(work: _Work, name: str) -> None:
    """Leave out changes, ever fewer together."""
    size = len(_changes(work.run.columns[name]))
    while size:
        start = 0
        while start < len(found := _changes(work.run.columns[name])):
            kept = set(found[:start] + found[start + size :])
            if not work.accepts(work.run.with_column(name, _held(work.run.columns[name], kept))):
                start += size
        size //= 2


def _changes(column: Column) -> list[int]:
    return [k for k in range(1, len(column)) if column[k] != column[k - 1]]


def _held(column: Column, kept: set[int]) -> Column:
    held = [column[0]]
    for k in range(1, len(column)):
        held.append(column[k] if k in kept else held[-1])
    return tuple(held)


SIMPLER: tuple[Callable[[float], float], ...] = (round, lambda v: round(v, 1), lambda v: round(v * 8) / 8)


def _plainer(work: _Work, name: str) -> None:
    """Rounder numbers in place of odd ones."""
    for value in dict.fromkeys(work.run.columns[name]):
        if not isinstance(value, float):
            continue
        for simpler in SIMPLER:
            column = tuple(simpler(value) if v == value else v for v in work.run.columns[name])
            if work.accepts(work.run.with_column(name, column)):
                break
