"""From goals to few short tests: searches in turn, what they leave open, and a greedy choice among runs."""

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from random import Random

from rovercheck.checker.engines import Limits
from rovercheck.checker.process.pool import Jobs
from rovercheck.checker.system.instrument.goals import CoverGoal, GoalKind
from rovercheck.checker.system.instrument.watch import watched
from rovercheck.checker.testgen.explore import RandomMachine, explored, first_reached, shortened
from rovercheck.checker.testgen.keep import KeptTests
from rovercheck.checker.testgen.replay import first_reached as replayed
from rovercheck.checker.testgen.scripts import Script, steps
from rovercheck.checker.testgen.search import (
    CoverAnswer,
    CoverFound,
    OpenGoal,
    SearchProgress,
    Uncoverable,
    refuted,
    searched,
)
from rovercheck.checker.verify.runs.replay import ReplayError
from rovercheck.spec_model.abstraction import Board
from rovercheck.spec_model.lang.expr import Const
from rovercheck.spec_model.lang.system import System

NOT_TRIED = "not searched: the time was over"
SHORTENING = 3000
"""Ticks that are run to shorten one random run."""


@dataclass(frozen=True)
class GenerationEffort:
    """What a generation may spend: seconds for each search by engines, ticks of random runs, processes."""

    seconds: float = 20.0
    ticks: int = 40_000
    jobs: Jobs | None = None
    seed: int = 0


@dataclass
class GoalCoverage:
    """What is known of each goal so far, and the scripts found."""

    board: Board
    goals: tuple[CoverGoal, ...]
    scripts: list[tuple[Script, dict[str, int]]] = field(default_factory=list)
    answers: dict[str, CoverAnswer] = field(default_factory=dict)
    before: Mapping[str, str] = field(default_factory=dict)
    """Why goals were unknown in an earlier generation."""

    def __post_init__(self) -> None:
        self.machine = RandomMachine(self.board, watched(self.board.system, {g.kind for g in self.goals}))

    @property
    def wanted(self) -> set[str]:
        return {g.id for g in self.goals}

    @property
    def covered(self) -> dict[str, int]:
        """The goals reached, and the length of the shortest run found to each."""
        found: dict[str, int] = {}
        for _, reached in self.scripts:
            for id, step in reached.items():
                found[id] = min(step, found.get(id, step))
        return {id: found[id] for id in found if id in self.wanted}

    @property
    def uncoverable(self) -> dict[str, Uncoverable]:
        return {id: a for id, a in self.answers.items() if isinstance(a, Uncoverable)}

    @property
    def shortest(self) -> set[str]:
        """The goals whose shortest run is known to be as short as any."""
        lengths = self.covered
        exact = [a for a in self.answers.values() if isinstance(a, CoverFound) and a.shortest]
        return {a.goal for a in exact if lengths.get(a.goal) == len(a.script)}

    @property
    def settled(self) -> set[str]:
        """The goals of which nothing is left to find out: transitions also want a run as short as any."""
        loose = {g.id for g in self.goals if g.kind is GoalKind.TRANSITIONS} - self.shortest
        return (self.covered.keys() - loose) | self.uncoverable.keys()

    @property
    def unknown(self) -> dict[str, str]:
        """The goals that are left, and why."""
        left = self.wanted - self.covered.keys() - self.uncoverable.keys()
        reasons = {id: a.reason for id, a in self.answers.items() if isinstance(a, OpenGoal)}
        known = {**self.before, **reasons}
        return {g.id: known.get(g.id, NOT_TRIED) for g in self.goals if g.id in left}

    def of(self, ids: Iterable[str]) -> list[CoverGoal]:
        """The goals with these ids, as drawn."""
        wanted = set(ids)
        return [g for g in self.goals if g.id in wanted]

    def add(self, script: Script) -> None:
        """A script, run on the compiled charts."""
        if all(script != known for known, _ in self.scripts):
            self.scripts.append((script, first_reached(self.machine, script)))

    def go_on(self, kept: KeptTests, charts: str) -> None:
        """Begin with the tests of an earlier generation; with what it proved, if the charts are the same."""
        for _, _, script in kept.tests:
            self.add(script)
        self.before = kept.unknown
        if kept.charts == charts:
            proved, shortest = kept.uncoverable.items(), self.covered.keys() & kept.shortest
            self.answers |= {id: Uncoverable.of(id, how) for id, how in proved if id in self.wanted}
            self.answers |= {id: self._as_before(id) for id in sorted(shortest)}

    def _as_before(self, goal: str) -> CoverFound:
        length = self.covered[goal]
        script = next(script for script, reached in self.scripts if reached.get(goal) == length)
        return CoverFound(goal, script[:length], "kept", True)

    def kept(self, charts: str = "") -> KeptTests:
        """Few tests that reach what is covered, and what is known of the other goals.

        Raises ``ReplayError`` if the interpreter does not confirm that a test reaches its goals.
        """
        tests = tuple(chosen(self))
        _confirmed(self, tests)
        proved = {id: a.text for id, a in self.uncoverable.items()}
        shortest = self.shortest
        return KeptTests(
            tests, tuple(g.id for g in self.goals if g.id in shortest), proved, self.unknown, charts
        )


Tell = Callable[[str], None]


def cover(
    coverage: GoalCoverage,
    model: System,
    effort: GenerationEffort,
    tell: Tell,
    only: Collection[str] | None = None,
) -> None:
    """Search for the goals not settled: engines for short runs to transitions, random runs, engines for the
    rest.

    ``model`` is the board with its environment; ``only``: search for goals of these ids alone.  ``coverage``
    holds what was found, also when this is interrupted.
    """
    asked = [g for g in coverage.goals if only is None or g.id in only]
    transitions = [g for g in asked if g.kind is GoalKind.TRANSITIONS and g.id in coverage.unknown]
    _by_engines(coverage, model, transitions, effort, tell)
    if isinstance(coverage.board.system.assumed, Const):  # random inputs may be any
        _by_weather(coverage, {g.id for g in asked}, effort, tell)
    left = [g for g in asked if g.id in coverage.unknown]
    for answer in refuted(coverage.board, left, Limits(seconds=effort.seconds), effort.jobs):
        _note(coverage, answer, tell)
    loose = coverage.wanted - coverage.settled
    rest = [g for g in asked if g.id in loose and g not in transitions]
    _by_engines(coverage, model, sorted(rest, key=lambda g: g not in left), effort, tell)


def _by_engines(
    coverage: GoalCoverage, model: System, goals: Sequence[CoverGoal], effort: GenerationEffort, tell: Tell
) -> None:
    for answer in searched(coverage.board, model, goals, Limits(seconds=effort.seconds), effort.jobs):
        _note(coverage, answer, tell)


def _note(coverage: GoalCoverage, answer: CoverAnswer | SearchProgress, tell: Tell) -> None:
    match answer:
        case SearchProgress(line):
            tell(line)
        case CoverFound():
            coverage.add(answer.script)
            coverage.answers[answer.goal] = answer if answer.goal in coverage.covered else _astray(answer)
        case Uncoverable():
            coverage.answers[answer.goal] = answer
        case OpenGoal(goal, reason):
            before = coverage.answers.get(goal)
            said = f"{before.reason}; {reason}" if isinstance(before, OpenGoal) else reason
            coverage.answers[goal] = OpenGoal(goal, said)


def _astray(found: CoverFound) -> OpenGoal:
    """What is said of a run of the model that does not reach its goal on the board."""
    steps_ = len(found.script)
    return OpenGoal(
        found.goal, f"a run of {steps_} ticks by {found.engine} misses it with the board's inputs"
    )


def _by_weather(coverage: GoalCoverage, asked: Collection[str], effort: GenerationEffort, tell: Tell) -> None:
    known = [script for script, _ in coverage.scripts]
    wanted = coverage.unknown.keys() & asked
    for find in explored(coverage.machine, wanted, Random(effort.seed), effort.ticks, known):
        coverage.add(shortened(coverage.machine, find.script, find.goals, SHORTENING))
        tell(f"random runs: {len(coverage.covered)} of {len(coverage.goals)} goals reached")


# --- few tests -----------------------------------------------------------------------------------------


def chosen(coverage: GoalCoverage) -> Iterator[tuple[str, tuple[str, ...], Script]]:
    """Few scripts that together reach every goal covered: in turn that with most new goals for its length.

    Each has a name and the goals that it is the first to reach, and ends in the step that reaches the last.
    """
    for number, (script, goals) in enumerate(_greedy(coverage), start=1):
        yield f"{coverage.board.name}_{number:03}", goals, script


def _confirmed(coverage: GoalCoverage, tests: Iterable[tuple[str, tuple[str, ...], Script]]) -> None:
    for name, goals, script in tests:
        looked = watched(coverage.board.system, {g.kind for g in coverage.goals}, set(goals))
        reached = replayed(coverage.board, looked, steps(coverage.board, script))
        missed = [id for id in goals if id not in reached]
        if missed:
            raise ReplayError(f"{name} does not reach {', '.join(missed)} on the interpreter.")


def _greedy(coverage: GoalCoverage) -> Iterator[tuple[Script, tuple[str, ...]]]:
    left, scripts = set(coverage.covered), list(_as_short_as_known(coverage))
    while left:
        script, reached = max(scripts, key=lambda found: _worth(found[1], left))
        new = left & reached.keys()
        left -= new
        ordered = tuple(sorted(new, key=lambda id: (reached[id], id)))
        yield script[: reached[ordered[-1]]], ordered


def _as_short_as_known(coverage: GoalCoverage) -> Iterator[tuple[Script, dict[str, int]]]:
    """The scripts; a goal whose shortest run is known counts only for those that reach it as soon."""
    lengths = coverage.covered
    soonest = {id: lengths[id] for id in coverage.shortest}
    for script, reached in coverage.scripts:
        yield script, {id: step for id, step in reached.items() if step <= soonest.get(id, step)}


def _worth(reached: Mapping[str, int], left: set[str]) -> tuple[float, int]:
    """New goals per step, the start of a test counting as some steps, too."""
    new = [step for id, step in reached.items() if id in left]
    return (len(new) / (max(new) + STARTING), -max(new)) if new else (0.0, 0)


STARTING = 20
"""Steps that another test is worth: fewer, longer tests rather than many short ones."""
