"""Cross-checking from Python: one board, one implementation, one result."""

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cache
from itertools import chain, count, islice
from pathlib import Path

from rovercheck.checker.adapters.implementation import Implementation, Value, Values
from rovercheck.checker.board_tests.rows import Row, rows, start_ms
from rovercheck.checker.compare.beside import (
    ComparedStep,
    Run,
    StepMismatch,
    differences,
    differs,
    played,
    rerun,
)
from rovercheck.checker.compare.environment import Environment
from rovercheck.checker.compare.fixed_runs import fixed
from rovercheck.checker.compare.known_changes import KnownChanges
from rovercheck.checker.compare.own_runs import covering
from rovercheck.checker.compare.recorded_runs import counterexamples, tests
from rovercheck.checker.compare.result import ALLOWED, Allowance, CompareResult
from rovercheck.checker.compare.run_follower import RecordedRun
from rovercheck.checker.compare.search import (
    CI,
    CompareEffort,
    CompareSearch,
    Elsewhere,
    Leading,
    Progress,
    effort,
)
from rovercheck.checker.compare.strategy import ENVIRONMENTS, environment
from rovercheck.checker.results.board_test import BoardStep, BoardTest
from rovercheck.checker.testgen import kept
from rovercheck.checker.testgen.expected_outputs import under_test
from rovercheck.checker.testgen.scripts import advance, stamps_of
from rovercheck.spec_model.abstraction import Board
from rovercheck.spec_model.abstraction.stamps import CLOCK

# --- the runs of a profile with what the charts require, kept to compare many implementations quickly


@dataclass(frozen=True)
class RecordedSuite:
    """A run: where it comes from, the time of its first step, and its rows with the outputs required."""

    origin: str
    start_ms: int
    rows: tuple[Row, ...]

    def __len__(self) -> int:
        return sum(times for times, _, _ in self.rows)

    def steps(self, board: Board) -> Iterator[tuple[dict[str, Value], dict[str, Value]]]:
        """Inputs and required outputs of each step; the inputs are changed in place afterwards."""
        inputs, stamps, now = board.at_power_up(), stamps_of(board), self.start_ms
        moment: dict[str, Value | None] = {}
        outputs: dict[str, Value | None] = {}
        for times, given, wanted in self.rows:
            moment |= given
            outputs |= wanted
            required = {name: value for name, value in outputs.items() if value is not None}
            for _ in range(times):
                advance(inputs, stamps, now, moment)
                yield inputs, required
                now = (now + board.tick_ms) % CLOCK


def recorded(board: Board, origin: str, steps: Sequence[ComparedStep]) -> RecordedSuite:
    """What the charts require in a run."""
    test = BoardTest(under_test(board), origin, tuple(BoardStep(s.inputs, s.expected) for s in steps))
    return RecordedSuite(origin, start_ms(test), tuple(rows(test)))


@dataclass(frozen=True)
class Suite:
    """The runs of an effort on a board, those that take new transitions first."""

    board: Board
    runs: tuple[RecordedSuite, ...]

    @property
    def steps(self) -> int:
        """Steps of all runs."""
        return sum(map(len, self.runs))

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
        transitions = {(f.chart, f.source, f.target, f.label) for step in steps for f in step.fired}
        made.append((-len(transitions - known), recorded(env.board, origin, steps)))
        known.update(transitions)

    CompareSearch(env, _Nothing(), effort, record=keep).run(runs)
    made.sort(key=lambda pair: pair[0])
    return Suite(env.board, tuple(run for _, run in made))


class _Nothing:
    """An implementation without outputs: nothing is compared."""

    def reset(self) -> None: ...

    def step(self, inputs: Values) -> Values:
        return {}

    def close(self) -> None: ...


def _first(board: Board, run: RecordedSuite, implementation: Implementation) -> StepMismatch | None:
    implementation.reset()
    seen: set[str] = set()
    given: list[dict[str, Value]] = []
    for inputs, expected in run.steps(board):
        given.append(dict(inputs))
        actual = implementation.step(given[-1])
        seen.update(actual)
        if differs(expected, actual, seen):
            steps = tuple(rerun(board, given))
            return StepMismatch(board, steps, differences(board, expected, actual, seen))
    return None


def cross_check(
    board: str | Board,
    implementation: Implementation,
    effort: CompareEffort = CI,
    *,
    folder: Path | None = None,
    allowance: Allowance = ALLOWED,
    progress: Progress = lambda search: None,
    watched: bool = False,
    deviating: Callable[[RecordedRun], None] = lambda run: None,
    leading: Leading = lambda found, runs: found,
    known: KnownChanges | None = None,
    elsewhere: Elsewhere | None = None,
) -> CompareResult:
    """Compare an implementation with the charts of ``board1`` or ``board2``, changed ones or a model's.

    ``effort`` is how many runs are drawn, from which seed; ``folder`` holds further tests; ``allowance``
    says what is spent on mismatches; ``watched``: whether the result says what was put to the test;
    ``deviating`` is given each run in which the implementation differs, to its end; ``leading`` says which
    deviations are told in full; ``known``: the changes that explain what is known; ``elsewhere`` tries the
    random runs.  Of changed charts kept runs are inputs only: what they require is computed anew.
    """
    env = ENVIRONMENTS[board] if isinstance(board, str) else environment(board)
    search = CompareSearch(
        env,
        implementation,
        effort,
        allowance=allowance,
        progress=progress,
        watched=watched,
        deviating=deviating,
        leading=leading,
        known=known,
        elsewhere=elsewhere,
    )
    return search.run(_known(env, folder))


def quick_check(
    board: str, implementation: Implementation, profile: str = "ci", *, examples: int | None = None
) -> StepMismatch | None:
    """The first difference in the runs of a profile, or None if there is none.

    The charts go through the runs at the first call only.  Raises ``ImplementationError``.
    """
    return recorded_suite(board, profile, examples).first_mismatch(implementation)


@cache
def recorded_suite(board: str, profile: str = "ci", examples: int | None = None) -> Suite:
    """The runs of a profile on a board, with what the charts require."""
    return suite(ENVIRONMENTS[board], effort(profile, examples), _known(ENVIRONMENTS[board], None))


def _known(env: Environment, folder: Path | None) -> Iterable[Run]:
    """The runs that are always tried: those of the project, then those of a folder."""
    name = env.board.name
    as_drawn = env is ENVIRONMENTS.get(name)
    ours = _of_the_project(name) if as_drawn else known_runs(env)
    return chain(ours, tests(folder, env.board) if folder else ())


class RunCache:
    """Runs that the charts go through once in a process, however often they are wanted."""

    def __init__(self, runs: Callable[[], Iterator[Run]]) -> None:
        self._again, self._runs, self._made = runs, runs(), list[Run]()

    def __iter__(self) -> Iterator[Run]:
        for number in count():
            if number == len(self._made):
                following = self._next()
                if following is None:
                    return
                self._made.append(following)
            yield self._made[number]

    def _next(self) -> Run | None:
        try:
            return next(self._runs, None)
        except BaseException:  # an interrupted generator has ended: the rest would be missing in silence
            self._runs = islice(self._again(), len(self._made), None)
            raise


@cache
def _of_the_project(board: str) -> RunCache:
    return RunCache(lambda: known_runs(ENVIRONMENTS[board]))


def known_runs(env: Environment) -> Iterator[Run]:
    """What is tried before anything random: counterexamples, covering tests, then the fixed runs."""
    if env.board.model:
        yield from covering(env)
    else:
        yield from counterexamples(env.board)
        yield from _covering(env.board)
    for label, stimulus in fixed(env):
        yield label, played(env.board, env.fields, stimulus)


def _covering(board: Board) -> Iterator[Run]:
    """The tests that cover every transition and boundary, kept with the project."""
    for test in kept(board.name):
        yield f"covering test {test.name}", rerun(board, test.steps)
