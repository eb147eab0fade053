"""Running a search in a child process: its events become an answer for each goal."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass, field
from importlib import import_module

from rovercheck.checker.process.isolate import ChildStopped, Send, messages
from rovercheck.checker.results.verdict import Answer, Open, Reached, Unreachable
from rovercheck.checker.search import (
    DepthSearched,
    GoalReached,
    GoalsExcluded,
    GoalsLeftOpen,
    SearchEvent,
    SearchPhase,
)


@dataclass(frozen=True)
class SearchJob:
    """A search that a child process makes, which alone loads the module with its solver.

    ``function`` of ``module`` yields events of the search when it is called with ``arguments``.  ``ended`` is
    said of a goal that is left open by a search that came to its end, or to the ``depth`` that was wanted.
    """

    engine: str
    module: str
    function: str
    arguments: tuple[object, ...]
    ended: str
    depth: int | None = None

    def answers(
        self,
        goals: Sequence[str],
        seconds: float | None,
        memory: int,
        progress: Callable[[str], None],
    ) -> Mapping[str, Answer]:
        """An answer for each goal; what was found before a limit was met, or the child died, counts."""
        known = SearchState(self.engine, dict.fromkeys(goals, 0))
        job = self.module, self.function, self.arguments
        stopped = ""
        try:
            modules = [self.module]
            with closing(messages(work, *job, seconds=seconds, memory=memory, modules=modules)) as events:
                for event in events:
                    known.note(event)
                    progress(known.line())
        except ChildStopped as error:
            stopped = str(error)
        return {goal: known.answer(goal, self._reason(known.deep[goal], stopped)) for goal in goals}

    def _reason(self, deep: int, stopped: str) -> str:
        whole = self.depth is not None and deep >= self.depth
        return self.ended if whole or not stopped else stopped


@dataclass
class SearchState:
    """What the events add up to: answers, and the ticks in which a goal is known not to be reached."""

    engine: str
    deep: dict[str, int]
    found: dict[str, Answer] = field(default_factory=dict)
    open: dict[str, str] = field(default_factory=dict)
    _phase: str = ""
    _details: str = ""

    def note(self, event: SearchEvent | None) -> None:
        """Take down what an event says; None only shows that time has passed."""
        match event:
            case GoalReached(goal, run, shortest):
                self.found[goal] = Reached(run, shortest)
            case GoalsExcluded(goals, because):
                self.found |= dict.fromkeys(goals, Unreachable(because))
            case DepthSearched(goals, depth, details):
                self.deep |= dict.fromkeys(goals, depth)
                self._details = details
            case GoalsLeftOpen(goals, reason):
                self.open |= dict.fromkeys(goals, reason)
            case SearchPhase(text):
                self._phase = text

    def answer(self, goal: str, reason: str = "") -> Answer:
        """What is known of a goal; ``reason`` is why nothing is, unless the search has told."""
        return self.found.get(goal) or Open(self.open.get(goal, reason), self.deep[goal])

    def line(self) -> str:
        """``pdr: depth 12, 340 lemmas, 2 goals open, 1 decided``."""
        left = [depth for name, depth in self.deep.items() if name not in self.found]
        depth = min(left) if left else max(self.deep.values(), default=0)
        doing = self._phase or f"depth {depth}"
        parts = [doing, self._details, f"{len(left)} goal{'s' * (len(left) != 1)} open"]
        parts += [f"{len(self.found)} decided"] if self.found else []
        return f"{self.engine}: {', '.join(filter(None, parts))}"


def work(send: Send, module: str, function: str, arguments: tuple[object, ...]) -> None:
    """In the child: load the search, and send its events."""
    events: Iterator[SearchEvent] = getattr(import_module(module), function)(*arguments)
    for event in events:
        send(event)
