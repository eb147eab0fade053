"""A naive search with the reference semantics, to compare engines with: slow, short, obvious."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import product

from rovercheck.checker.results.verdict import Run
from rovercheck.spec_model.lang.evaluate import admissible, step
from rovercheck.spec_model.lang.expr import Var
from rovercheck.spec_model.lang.system import TransitionSystem

State = tuple[tuple[str, int], ...]


@dataclass(frozen=True)
class Searched:
    """The reachable states, and the least number of ticks after which each goal is true."""

    states: set[State]
    reached: dict[str, int]


def search(system: TransitionSystem, goals: Sequence[Var]) -> Searched:
    """Every reachable state, initial ones included."""
    keys = [v.name for v in (*system.frozen, *system.variables)]
    frontier = [{**system.init, **frozen} for frozen in vectors(system.frozen)]
    seen = {_state(at, keys) for at in frontier}
    reached: dict[str, int] = {}
    depth = 0
    while frontier:
        depth += 1
        following = []
        for at in frontier:
            for after in successors(system, at):
                for goal in goals:
                    if after[goal.name]:
                        reached.setdefault(goal.name, depth)
                if _state(after, keys) not in seen:
                    seen.add(_state(after, keys))
                    following.append(after)
        frontier = following
    return Searched(seen, reached)


def projected(states: set[State], names: Sequence[str]) -> set[State]:
    """The states restricted to some variables."""
    return {tuple((n, v) for n, v in state if n in names) for state in states}


def successors(system: TransitionSystem, at: dict[str, int]) -> Iterator[dict[str, int]]:
    for inputs in vectors(system.inputs):
        if admissible(system, at, inputs):
            yield step(system, at, inputs)


def vectors(variables: Sequence[Var]) -> Iterator[dict[str, int]]:
    names = [v.name for v in variables]
    for values in product(*(v.domain.values for v in variables)):
        yield dict(zip(names, values, strict=True))


def replay(system: TransitionSystem, run: Run) -> list[dict[str, int]]:
    """The states after each tick of a run.  Raises ``AssertionError`` for an inadmissible one."""
    assert set(run.frozen) == {v.name for v in system.frozen}
    at, after = {**system.init, **run.frozen}, []
    for inputs in run.inputs:
        assert set(inputs) == {v.name for v in system.inputs}
        assert admissible(system, at, inputs)
        at = step(system, at, inputs)
        after.append(at)
    return after


def _state(at: dict[str, int], keys: Sequence[str]) -> State:
    return tuple((k, at[k]) for k in keys)
