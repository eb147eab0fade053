"""From goals to few short tests: searches in turn, what they leave open, and a greedy choice among runs."""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from random import Random

from checker.conform.cover.explore import Machine, explored, first_reached, shortened
from checker.conform.cover.goals import Goal, Kind
from checker.conform.cover.keep import Kept
from checker.conform.cover.replay import first_reached as replayed
from checker.conform.cover.scripts import Script, steps
from checker.conform.cover.search import Answer, Found, Open, Saying, Uncoverable, refuted, searched
from checker.conform.cover.watch import watched
from checker.engine import Limits
from checker.runs.replay import ReplayError
from spec_model.abstraction import Board
from spec_model.lang.system import System

NOT_TRIED = "not searched: the time was over"
REFUTED = 10.0
"""Seconds that a proof about one part alone may take, at most."""
SHORTENING = 3000
"""Ticks that are run to shorten one random run."""


@dataclass(frozen=True)
class Effort:
    """What a generation may spend: seconds for each search by engines, ticks of random runs, processes."""

    seconds: float = 20.0
    ticks: int = 40_000
    jobs: int | None = None
    seed: int = 0


@dataclass
class Coverage:
    """What is known of each goal so far, and the scripts found."""

    board: Board
    goals: tuple[Goal, ...]
    scripts: list[tuple[Script, dict[str, int]]] = field(default_factory=list)
    answers: dict[str, Answer] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self.machine = Machine(self.board, watched(self.board.system, {g.kind for g in self.goals}))

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
        exact = [a for a in self.answers.values() if isinstance(a, Found) and a.shortest]
        return {a.goal for a in exact if lengths.get(a.goal) == len(a.script)}

    @property
    def unknown(self) -> dict[str, str]:
        """The goals that are left, and why."""
        left = self.wanted - self.covered.keys() - self.uncoverable.keys()
        reasons = {id: a.reason for id, a in self.answers.items() if isinstance(a, Open)}
        return {g.id: reasons.get(g.id, NOT_TRIED) for g in self.goals if g.id in left}

    def of(self, ids: Iterable[str]) -> list[Goal]:
        """The goals with these ids, as drawn."""
        wanted = set(ids)
        return [g for g in self.goals if g.id in wanted]

    def add(self, script: Script) -> None:
        """A script, run on the compiled charts."""
        if all(script != known for known, _ in self.scripts):
            self.scripts.append((script, first_reached(self.machine, script)))

    def kept(self) -> Kept:
        """Few tests that reach what is covered, and what is known of the other goals.

        Raises ``ReplayError`` if the interpreter does not confirm that a test reaches its goals.
        """
        tests = tuple(chosen(self))
        _confirmed(self, tests)
        proved = {id: f"{a.system}: {a.engine}, {a.because}" for id, a in self.uncoverable.items()}
        shortest = tuple(g.id for g in self.goals if g.id in self.shortest)
        return Kept(tests, shortest, proved, self.unknown)


Tell = Callable[[str], None]


def cover(coverage: Coverage, model: System, effort: Effort, tell: Tell) -> None:
    """Search for all goals: short runs by engines to arrows, random runs, engines again for what is left.

    ``model`` is the board with its environment.  ``coverage`` holds what was found, also when this is
    interrupted.
    """
    arrows = [g for g in coverage.goals if g.kind is Kind.ARROWS]
    _by_engines(coverage, model, arrows, effort, tell)
    _by_weather(coverage, effort, tell)
    left = coverage.of(coverage.unknown)
    for answer in refuted(coverage.board, left, Limits(seconds=min(effort.seconds, REFUTED)), effort.jobs):
        _note(coverage, answer, tell)
    _by_engines(coverage, model, [g for g in coverage.of(coverage.unknown) if g not in arrows], effort, tell)


def _by_engines(coverage: Coverage, model: System, goals: Sequence[Goal], effort: Effort, tell: Tell) -> None:
    for part in dict.fromkeys(g.part for g in goals):
        left = coverage.unknown
        mine = [g for g in goals if g.part == part and (g.id in left or g.kind is Kind.ARROWS)]
        limits = Limits(seconds=effort.seconds)
        for answer in searched(coverage.board, model, mine, limits, effort.jobs):
            _note(coverage, answer, tell)


def _note(coverage: Coverage, answer: Answer | Saying, tell: Tell) -> None:
    match answer:
        case Saying(line):
            tell(line)
        case Found():
            coverage.add(answer.script)
            coverage.answers[answer.goal] = answer if answer.goal in coverage.covered else _astray(answer)
        case Uncoverable():
            coverage.answers[answer.goal] = answer
        case Open(goal, reason):
            before = coverage.answers.get(goal)
            said = f"{before.reason}; {reason}" if isinstance(before, Open) else reason
            coverage.answers[goal] = Open(goal, said)


def _astray(found: Found) -> Open:
    """What is said of a run of the model that does not reach its goal on the board."""
    steps_ = len(found.script)
    return Open(found.goal, f"a run of {steps_} ticks by {found.engine} misses it with the board's inputs")


def _by_weather(coverage: Coverage, effort: Effort, tell: Tell) -> None:
    known = [script for script, _ in coverage.scripts]
    wanted = coverage.unknown
    for find in explored(coverage.machine, wanted, Random(effort.seed), effort.ticks, known):
        coverage.add(shortened(coverage.machine, find.script, find.goals, SHORTENING))
        tell(f"random runs: {len(coverage.covered)} of {len(coverage.goals)} goals reached")


# --- few tests -----------------------------------------------------------------------------------------


def chosen(coverage: Coverage) -> Iterator[tuple[str, tuple[str, ...], Script]]:
    """Few scripts that together reach every goal covered: in turn that with most new goals for its length.

    Each has a name and the goals that it is the first to reach, and ends in the step that reaches the last.
    """
    for number, (script, goals) in enumerate(_greedy(coverage), start=1):
        yield f"{coverage.board.name}_{number:03}", goals, script


def _confirmed(coverage: Coverage, tests: Iterable[tuple[str, tuple[str, ...], Script]]) -> None:
    for name, goals, script in tests:
        looked = watched(coverage.board.system, only=set(goals))
        reached = replayed(coverage.board, looked, steps(coverage.board, script))
        missed = [id for id in goals if id not in reached]
        if missed:
            raise ReplayError(f"{name} does not reach {', '.join(missed)} on the interpreter.")


def _greedy(coverage: Coverage) -> Iterator[tuple[Script, tuple[str, ...]]]:
    left = set(coverage.covered)
    while left:
        script, reached = max(coverage.scripts, key=lambda found: _worth(found[1], left))
        new = left & reached.keys()
        left -= new
        ordered = tuple(sorted(new, key=lambda id: (reached[id], id)))
        yield script[: reached[ordered[-1]]], ordered


def _worth(reached: Mapping[str, int], left: set[str]) -> tuple[float, int]:
    """New goals per step, the start of a test counting as some steps, too."""
    new = [step for id, step in reached.items() if id in left]
    return (len(new) / (max(new) + STARTING), -max(new)) if new else (0.0, 0)


STARTING = 20
"""Steps that another test is worth: fewer, longer tests rather than many short ones."""
