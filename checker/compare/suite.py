"""The runs of a profile with what the charts require, kept to compare many implementations quickly.

What is drawn does not depend on the implementation as long as it conforms, so the charts run only once.
A step is kept as what changes in it.
"""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace

from checker.adapters.implementation import Implementation, Value, Values
from checker.compare.beside import ComparedStep, StepMismatch, differences, differs, rerun
from checker.compare.environment import Environment
from checker.compare.search import CompareEffort, CompareSearch, Run
from spec_model.abstraction import Board

Changes = Mapping[str, Value | None]
NOTHING: Changes = {}


@dataclass(frozen=True)
class RecordedSuite:
    """A run: where it comes from, and the changes of inputs and required outputs in each step.

    An output that changes to None is not required any more.
    """

    origin: str
    steps: tuple[tuple[Changes, Changes], ...]

    def __iter__(self) -> Iterator[tuple[dict[str, Value], dict[str, Value]]]:
        """Inputs and required outputs of each step; both are changed in place afterwards."""
        inputs: dict[str, Value] = {}
        expected: dict[str, Value] = {}
        for given, required in self.steps:
            _apply(inputs, given)
            _apply(expected, required)
            yield inputs, expected


@dataclass(frozen=True)
class Suite:
    """The runs of an effort on a board, those that take new arrows first."""

    board: Board
    runs: tuple[RecordedSuite, ...]

    @property
    def steps(self) -> int:
        """Steps of all runs."""
        return sum(len(run.steps) for run in self.runs)

    def first_mismatch(self, implementation: Implementation) -> StepMismatch | None:
        """The first difference in any of the runs.  Raises ``ImplementationError``."""
        for run in self.runs:
            mismatch = _first(self.board, run, implementation)
            if mismatch is not None:
                return replace(mismatch, origin=run.origin)
        return None


def suite(env: Environment, effort: CompareEffort, runs: Iterable[Run]) -> Suite:
    """Record what a search would try with an implementation that conforms."""
    made: list[tuple[int, RecordedSuite]] = []
    known: set[object] = set()

    def keep(origin: str, steps: list[ComparedStep]) -> None:
        arrows = {(f.chart, f.source, f.target, f.label) for step in steps for f in step.fired}
        made.append((-len(arrows - known), RecordedSuite(origin, tuple(_changes(steps)))))
        known.update(arrows)

    CompareSearch(env, _Nothing(), effort, record=keep).run(runs)
    made.sort(key=lambda pair: pair[0])
    return Suite(env.board, tuple(run for _, run in made))


class _Nothing:
    """An implementation without outputs: nothing is compared."""

    def reset(self) -> None: ...

    def step(self, inputs: Values) -> Values:
        return {}

    def close(self) -> None: ...


def _first(board: Board, recorded: RecordedSuite, implementation: Implementation) -> StepMismatch | None:
    implementation.reset()
    seen: set[str] = set()
    given: list[dict[str, Value]] = []
    for inputs, expected in recorded:
        given.append(dict(inputs))
        actual = implementation.step(given[-1])
        seen.update(actual)
        if differs(expected, actual, seen):
            steps = tuple(rerun(board, given))
            return StepMismatch(board, steps, differences(board, expected, actual, seen))
    return None


def _changes(steps: list[ComparedStep]) -> Iterator[tuple[Changes, Changes]]:
    inputs: dict[str, Value] = {}
    expected: dict[str, Value] = {}
    for step in steps:
        yield _changed(inputs, step.inputs), _changed(expected, step.expected)


def _changed(before: dict[str, Value], now: Values) -> Changes:
    """What is to be applied to have the values of now; ``before`` is brought up to them."""
    found: dict[str, Value | None] = {n: v for n, v in now.items() if n not in before or before[n] != v}
    found |= {name: None for name in before if name not in now}
    _apply(before, found)
    return found or NOTHING


def _apply(at: dict[str, Value], changes: Changes) -> None:
    for name, value in changes.items():
        if value is None:
            at.pop(name, None)
        else:
            at[name] = value
