"""Every reachable state with every tick that leaves it, by plain breadth-first search.

For small systems only: the step is interpreted, not compiled (``checker.explore.graphs`` explores by compiled
code).  An input is chosen at the moment the step reads it, one value per cell (see
``checker.system.partition``), so inputs that a tick does not look at cost nothing.
"""

from collections.abc import Iterator, Mapping, Sequence
from itertools import product

from rovercheck.checker.engines import Progress
from rovercheck.checker.results.graph import Values
from rovercheck.checker.system.partition import partitions
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.evaluate import evaluate, run
from rovercheck.spec_model.lang.expr import Var
from rovercheck.spec_model.lang.system import TransitionSystem

Step = tuple[Values, Mapping[str, int]]
"""The state after a tick, and the inputs it looked at in the order in which it did, raw."""

_REPORT = 1000


class TooLarge(ModelError):
    """More states or ticks than the limits allow."""


class ReachableSearch:
    """Yields each reachable state once, with its ticks, in breadth-first order."""

    def __init__(
        self, system: TransitionSystem, variables: Sequence[Var], most: int, steps: int, progress: Progress
    ) -> None:
        self.system, self.variables, self.most, self.steps, self.progress = (
            system, variables, most, steps, progress,
        )  # fmt: skip
        self.names = tuple(v.name for v in variables)
        self.cells = {n: [c.value for c in p.cells] for n, p in partitions(system).items()}

    def initial(self) -> Iterator[Values]:
        """One state before the first tick for each choice of the frozen variables."""
        frozen = {v.name for v in self.system.frozen}
        domains = [v.domain.values if v.name in frozen else (v.init,) for v in self.variables]
        return product(*domains)

    def __iter__(self) -> Iterator[tuple[Values, Sequence[Step]]]:
        queue = list(self.initial())
        seen = set(queue)
        tried = 0
        for number, valuation in enumerate(queue):
            leaving = list(self._ticks(valuation))
            tried += len(leaving)
            for after, _ in leaving:
                if after not in seen:
                    seen.add(after)
                    queue.append(after)
            self._within(len(queue), tried)
            if number % _REPORT == _REPORT - 1:
                self.progress(f"graph: {number + 1} of {len(queue)} states, {tried} ticks tried")
            yield valuation, leaving

    def _within(self, valuations: int, tried: int) -> None:
        if valuations <= self.most and tried <= self.steps:
            return
        widest = sorted(self.variables, key=lambda v: (-len(v.domain), v.name))[:3]
        advice = ", ".join(f"{v.name} ({len(v.domain)} values)" for v in widest)
        raise TooLarge(
            f"{self.system.name}: more than {self.most if valuations > self.most else self.steps} "
            f"{'states' if valuations > self.most else 'ticks'} stand behind this graph. "
            f"Its largest variables are {advice}. Project on variables that do not depend on them, "
            "take a smaller system, or raise the limit."
        )

    def _ticks(self, valuation: Values) -> Iterator[Step]:
        """Every tick from a state: one for each way in which the step can read its inputs."""
        before = dict(zip(self.names, valuation, strict=True))
        for after, drawn in ticks(self.system, before, self.cells):
            yield tuple(after[name] for name in self.names), drawn


def ticks(
    system: TransitionSystem, before: Mapping[str, int], cells: Mapping[str, Sequence[int]]
) -> Iterator[tuple[Mapping[str, int], Mapping[str, int]]]:
    """The state after each tick, with the inputs it looked at, which are among ``cells``."""
    script: list[int] = []
    while True:
        at = _Drawn(before, cells, script)
        if evaluate(system.assume, at):
            run(system.step, at)
            yield at, at.drawn
        script = at.following()
        if not script:
            return


class _Drawn(dict[str, int]):
    """A state whose inputs are drawn when read: the i-th one read takes its ``script[i]``-th cell."""

    def __init__(
        self, before: Mapping[str, int], cells: Mapping[str, Sequence[int]], script: Sequence[int]
    ) -> None:
        super().__init__(before)
        self.cells, self.script = cells, script
        self.drawn: dict[str, int] = {}

    def __missing__(self, name: str) -> int:
        place = len(self.drawn)
        choice = self.script[place] if place < len(self.script) else 0
        value = self.cells[name][choice]
        self.drawn[name] = self[name] = value
        return value

    def following(self) -> list[int]:
        """The next script: the last choice that can be raised is, those after it start anew."""
        script = [self.cells[name].index(value) for name, value in self.drawn.items()]
        for i, name in reversed(list(enumerate(self.drawn))):
            if script[i] + 1 < len(self.cells[name]):
                return [*script[:i], script[i] + 1]
        return []
