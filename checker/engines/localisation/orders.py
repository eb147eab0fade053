"""Questions to the bounded search, which goes on in a child process from one to the next."""

from queue import Empty, SimpleQueue
from time import monotonic
from types import TracebackType
from typing import Self

from rovercheck.checker.engines.localisation.bounded_search import BoundedEngine, BoundedHit, Core
from rovercheck.checker.process.isolate import Child, ChildStopped, End
from rovercheck.spec_model.lang.system import TransitionSystem


class Orders:
    """A child that knows the system.  Raises ``ChildStopped`` when it dies or the time is over."""

    def __init__(self, system: TransitionSystem, deadline: float | None, memory: int) -> None:
        self._inbox: SimpleQueue[object] = SimpleQueue()
        self._deadline = deadline
        self._child = Child(self._inbox.put, BoundedEngine, system, memory=memory)

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, where: TracebackType | None
    ) -> None:
        self._child.kill()

    def why(self, goal: str, depth: int, kept: frozenset[str]) -> BoundedHit | Core:
        """A run to the goal of at most so many ticks, or what stands in its way beside what is kept."""
        self._child.order(goal, depth, kept)
        said: BoundedHit | Core | None = None
        while True:
            match self._next():
                case BoundedHit() | Core() as found:
                    said = found
                case str(reason):
                    raise ChildStopped(reason)
                case End(failure) if failure is not None or said is None:
                    raise ChildStopped(failure or "the bounded search ended without a word")
                case End():
                    assert said is not None
                    return said

    def _next(self) -> object:
        left = None if self._deadline is None else max(0.0, self._deadline - monotonic())
        try:
            return self._inbox.get(timeout=left)
        except Empty:
            raise ChildStopped("the time limit is reached") from None
