"""Cross-checking from Python: one board, one implementation, one result."""

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import replace
from functools import cache
from itertools import chain, count, islice
from pathlib import Path

from checker.adapters import start
from checker.adapters.implementation import Implementation
from checker.compare.beside import StepMismatch, compared, played, rerun
from checker.compare.environment import Environment
from checker.compare.fixed import fixed
from checker.compare.recorded import counterexamples, tests
from checker.compare.result import ALLOWED, Allowance, CompareResult
from checker.compare.search import CompareSearch, Progress, Run, effort
from checker.compare.smaller import BUDGET
from checker.compare.stimulus import Stimulus
from checker.compare.strategy import ENVIRONMENTS
from checker.compare.suite import Suite, suite
from checker.compare.varied import named
from checker.testgen import kept
from spec_model.abstraction import Board

AS_READ: Mapping[str, str] = {}


def cross_check(
    board: str,
    implementation: Implementation,
    profile: str = "ci",
    *,
    examples: int | None = None,
    seed: int | None = None,
    stop_early: bool = False,
    folder: Path | None = None,
    budget: int = BUDGET,
    allowance: Allowance = ALLOWED,
    progress: Progress = lambda search: None,
    charts: Board | None = None,
) -> CompareResult:
    """Compare an implementation of ``board1`` or ``board2`` with the charts.

    ``profile`` is ``ci`` or ``nightly``; ``examples`` and ``seed`` replace what it says.  With ``stop_early``
    the first mismatch ends the search, and is not made small.  ``folder`` holds further tests.
    ``budget`` is how many steps may be spent on making one mismatch small, ``allowance`` says of how many.
    ``charts`` is the board with changed charts; kept runs are inputs only, of which it is computed anew what
    they require.
    """
    env = ENVIRONMENTS[board] if charts is None else replace(ENVIRONMENTS[board], board=charts)
    search = CompareSearch(
        env,
        implementation,
        effort(profile, examples, seed),
        stop_early,
        allowance,
        budget=budget,
        progress=progress,
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


def replay(
    board: str, address: str, stimulus: Stimulus, readings: Mapping[str, str] = AS_READ, repair: str = ""
) -> StepMismatch | None:
    """Run the implementation at an address ``KIND:WHAT`` and the charts under one stimulus.

    The charts are those under ``readings``, with a repair if one is named.
    The first step in which they differ, or None.  Raises ``ImplementationError``.
    """
    which = named(readings, repair)[board]
    implementation = start(address, which)
    try:
        return compared(which, played(which, {}, stimulus), implementation)
    finally:
        implementation.close()


def _known(env: Environment, folder: Path | None) -> Iterable[Run]:
    """The runs that are always tried: those of the project, then those of a folder."""
    name = env.board.name
    as_drawn = env is ENVIRONMENTS[name]
    ours = _of_the_project(name) if as_drawn else known_runs(env)
    return chain(ours, tests(folder, env.board) if folder else ())


class Remembered:
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
def _of_the_project(board: str) -> Remembered:
    return Remembered(lambda: known_runs(ENVIRONMENTS[board]))


def known_runs(env: Environment) -> Iterator[Run]:
    """What is tried before anything random: counterexamples, covering tests, then the fixed runs."""
    yield from counterexamples(env.board)
    yield from _covering(env.board)
    for label, stimulus in fixed(env):
        yield label, played(env.board, env.fields, stimulus)


def _covering(board: Board) -> Iterator[Run]:
    """The tests that cover every arrow and boundary, kept with the project."""
    for test in kept(board.name):
        yield f"covering test {test.name}", rerun(board, test.steps)
