"""The naive loop of ``tests.naive`` as an engine: it finds shortest runs, and says how often it was asked."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from rovercheck.checker.engines import Limits, Progress
from rovercheck.checker.results.verdict import Answer, Exhausted, Open, Reached, Run, Unreachable
from rovercheck.spec_model.lang.expr import Var
from rovercheck.spec_model.lang.system import TransitionSystem
from tests.naive import successors, vectors

_Reached = tuple[dict[str, int], dict[str, int], tuple[dict[str, int], ...]]
"""A state, the frozen values, and the inputs of the ticks up to it."""
MOST = 150
"""States after which the search is given up, so that a test does not take long."""


@dataclass
class NaiveEngine:
    """``asked`` names the systems that it was asked about."""

    asked: list[str] = field(default_factory=list)
    NAME: str = "naive"
    SUMMARY: str = "for tests"

    def check(
        self, system: TransitionSystem, goals: Sequence[Var], limits: Limits, progress: Progress
    ) -> Mapping[str, Answer]:
        """An answer for each goal: by every state that there is."""
        self.asked.append(system.name)
        keys = [v.name for v in (*system.frozen, *system.variables)]
        names = [v.name for v in system.inputs]
        found: dict[str, Answer] = {}
        frontier: list[_Reached] = [
            ({**system.init, **frozen}, frozen, ()) for frozen in vectors(system.frozen)
        ]
        seen = {tuple(at[k] for k in keys) for at, _, _ in frontier}
        depth = 0
        while frontier:
            depth, following = depth + 1, list[_Reached]()
            for at, frozen, run in frontier:
                for after in successors(system, at):
                    longer = (*run, {n: after[n] for n in names})
                    for goal in goals:
                        if after[goal.name] and goal.name not in found:
                            found[goal.name] = Reached(Run(frozen, longer))
                    state = tuple(after[k] for k in keys)
                    if state not in seen:
                        seen.add(state)
                        following.append(({k: after[k] for k in keys}, frozen, longer))
            frontier = following
            if len(seen) > MOST:
                return {g.name: found.get(g.name, Open("too many states", depth)) for g in goals}
        proof = Unreachable(Exhausted(len(seen), 0, depth, tuple(keys)))
        return {g.name: found.get(g.name, proof) for g in goals}
