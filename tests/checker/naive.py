"""The search everybody can check by reading: breadth first, one dictionary per valuation."""

from collections.abc import Iterator, Mapping, Sequence
from itertools import product

from checker.verdict import Run
from spec_model.lang.evaluate import admissible, step
from spec_model.lang.expr import Var
from spec_model.lang.system import TransitionSystem

State = dict[str, int]


def every(variables: Sequence[Var]) -> Iterator[State]:
    """Every choice of values from the domains."""
    for values in product(*(v.domain.values for v in variables)):
        yield {v.name: x for v, x in zip(variables, values, strict=True)}


def first_hits(system: TransitionSystem, goals: Sequence[str], most: int = 1000) -> dict[str, int | None]:
    """The number of ticks of the shortest run to each goal, None when there is none of ``most`` ticks."""
    found: dict[str, int | None] = dict.fromkeys(goals)
    layer = [{**system.init, **frozen} for frozen in every(system.frozen)]
    seen: set[tuple[int, ...]] = set()
    depth = 0
    while layer and depth < most:
        depth += 1
        reached = list(_successors(system, layer, seen))
        for goal in goals:
            if found[goal] is None and any(s[goal] for s in reached):
                found[goal] = depth
        layer = reached
    return found


def _successors(
    system: TransitionSystem, layer: Sequence[State], seen: set[tuple[int, ...]]
) -> Iterator[State]:
    inputs = list(every(system.inputs))
    for before in layer:
        for given in inputs:
            if admissible(system, before, given):
                after = step(system, before, given)
                state = {n: x for n, x in after.items() if n not in given}
                key = tuple(state[n] for n in sorted(state))
                if key not in seen:
                    seen.add(key)
                    yield state


def last(system: TransitionSystem, run: Run) -> Mapping[str, int]:
    """The valuation after a run; an ``AssertionError`` when the run is not admissible."""
    at: Mapping[str, int] = {**system.init, **run.frozen}
    assert all(run.frozen[v.name] in v.domain for v in system.frozen)
    for given in run.inputs:
        assert set(given) == {v.name for v in system.inputs}
        assert admissible(system, at, given)
        at = {n: x for n, x in step(system, at, given).items() if n not in given}
    return at
