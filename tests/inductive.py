"""Re-checks an inductive invariant by enumerating every state of a tiny system: slow, short, obvious."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace

from rovercheck.checker.results.verdict import Inductive
from rovercheck.checker.system.slice import sliced
from rovercheck.spec_model.lang.evaluate import admissible, evaluate, step
from rovercheck.spec_model.lang.expr import Var
from rovercheck.spec_model.lang.system import TransitionSystem
from rovercheck.spec_model.lang.walk import variables
from tests.naive import vectors

Key = tuple[int, ...]


def problems(system: TransitionSystem, goal: Var, claim: Inductive) -> list[str]:
    """What is wrong with a claim that the goal is never true; nothing for a correct one."""
    return list(_Claim.about(system, goal, claim).problems())


@dataclass(frozen=True)
class _Claim:
    """A claim, and the part of the system it is about: what the goal needs and the conjuncts mention."""

    system: TransitionSystem
    goal: Var
    claim: Inductive
    memory: tuple[Var, ...]
    following: dict[Key, list[dict[str, int]]] = field(default_factory=dict)

    @staticmethod
    def about(system: TransitionSystem, goal: Var, claim: Inductive) -> "_Claim":
        spoken = [v for c in claim.conjuncts for n, v in variables(c).items() if n in system.init]
        part = sliced(system, [goal, *spoken])
        names = {v.name for v in part.variables} | {v.name for v in spoken}
        memory = tuple(v for v in system.variables if v.name in names)
        kept = {goal.name, *names}
        temps = tuple(v for v in part.temps if v.name not in kept)
        whole = replace(part, variables=tuple(v for v in system.variables if v.name in kept), temps=temps)
        return _Claim(whole, goal, claim, memory)

    def problems(self) -> Iterator[str]:
        starts = [{**self.system.init, **frozen} for frozen in vectors(self.system.frozen)]
        if not all(self.holds(at) for at in starts):
            yield "initiation"
        if self.reached_at_first(starts):
            yield "base"
        inside = [at for at in vectors((*self.memory, *self.system.frozen)) if self.holds(at)]
        following = [after for at in inside for after in self.after(at)]
        if not all(self.holds(after) for after in following):
            yield "consecution"
        if any(after[v.name] not in v.domain for after in following for v in self.memory):
            yield "domains"
        elif any(self.reached_from(at, [self.key(at)]) for at in inside):
            yield "safety"

    def holds(self, at: Mapping[str, int]) -> bool:
        return all(evaluate(c, at) for c in self.claim.conjuncts)

    def reached_at_first(self, frontier: list[dict[str, int]]) -> bool:
        for _ in range(self.claim.ticks):
            frontier = [after for at in frontier for after in self.after(at)]
            if any(after[self.goal.name] for after in frontier):
                return True
        return False

    def reached_from(self, at: Mapping[str, int], path: list[Key]) -> bool:
        """Whether the path can go on to the goal, true after its last tick and after none before."""
        for after in self.after(at):
            if len(path) == self.claim.ticks:
                if after[self.goal.name]:
                    return True
            elif after[self.goal.name] or (self.claim.simple and self.key(after) in path):
                continue
            elif self.reached_from(after, [*path, self.key(after)]):
                return True
        return False

    def after(self, at: Mapping[str, int]) -> list[dict[str, int]]:
        """The distinct states after one more tick."""
        key = self.key(at)
        if key not in self.following:
            found = [step(self.system, at, i) for i in self.inputs(at)]
            self.following[key] = list({(*self.key(f), f[self.goal.name]): f for f in found}.values())
        return self.following[key]

    def inputs(self, at: Mapping[str, int]) -> Iterator[dict[str, int]]:
        return (i for i in vectors(self.system.inputs) if admissible(self.system, at, i))

    def key(self, at: Mapping[str, int]) -> Key:
        return tuple(at[v.name] for v in (*self.memory, *self.system.frozen))
