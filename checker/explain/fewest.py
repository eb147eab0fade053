"""Does a smaller set of inputs force the end of a run?

Every set that forces it has a member in every *correction set*: inputs that avoid the end with other values,
while the rest is as in the run.  So no such set is smaller than a smallest one that meets all correction
sets known so far; where that one forces the end itself, it is the answer.  This is the duality of minimal
unsatisfiable subsets and hitting sets (Ignatiev, Previti, Liffiton and Marques-Silva, Smallest MUS extraction
with minimal hitting set dualization, CP 2015).
"""

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence

from pysat.examples.hitman import Hitman

from checker.encode.bits import Circuit
from checker.encode.bits.simulate import Simulation, Values
from checker.explain.unrolled import LANES, Over, Place, Unrolled
from checker.partition import Partition
from checker.verdict import Run

ROUNDS = 256
"""Correction sets after which a smaller set is no longer looked for."""

Change = tuple[Place, int]
"""Another value for one input of a run."""
Avoids = Callable[[Sequence[Change]], Iterable[bool]]
"""For each change whether it alone is admissible and avoids the end."""


def indispensable(
    places: Collection[Place], run: Run, cells: Mapping[str, Partition], avoids: Avoids, over: Over
) -> set[Place]:
    """Inputs that are in every set that forces the end, as another value of each alone avoids it.

    There may be more of them where the time is ``over`` before all are tried.
    """
    found = set[Place]()
    changes = [change for place in places for change in _others(place, run, cells[place[1]])]
    for start in range(0, len(changes), LANES):
        if over():
            break
        some = [change for change in changes[start : start + LANES] if change[0] not in found]
        found |= {place for (place, _), avoiding in zip(some, avoids(some), strict=True) if avoiding}
    return found


def _others(place: Place, run: Run, cells: Partition) -> Iterator[Change]:
    """A value of every cell but the one that the run has there."""
    own = cells.cell_of[run.inputs[place[0] - 1][place[1]]]
    return ((place, cell.value) for number, cell in enumerate(cells.cells) if number != own)


def fewest(
    unrolled: Unrolled,
    kept: Mapping[Place, int],
    fixed: Mapping[Place, int],
    cells: Mapping[str, Partition],
    over: Over,
) -> tuple[Mapping[Place, int], bool]:
    """A set of inputs that forces the end, no larger than ``kept``, and whether there is no smaller one.

    ``fixed`` has for each input of the run the assumption that it has its own value.
    """
    needed = indispensable(kept, unrolled.run, cells, unrolled.avoids, over)
    if needed == kept.keys():
        return kept, True
    hitting = Hitman(bootstrap_with=[[place] for place in sorted(needed)], htype="sorted")
    try:
        for _ in range(ROUNDS):
            least: Sequence[Place] = hitting.get() or ()
            if len(least) == len(kept):
                return kept, True
            answer = unrolled.asked([fixed[place] for place in least])
            if answer.forced:
                return {place: fixed[place] for place in least}, True
            correction = _correction(unrolled, fixed, over) if answer.forced is False else None
            if correction is None:
                break
            hitting.hit(correction)
    finally:
        hitting.delete()
    return kept, False


def _correction(unrolled: Unrolled, fixed: Mapping[Place, int], over: Over) -> list[Place] | None:
    """From the run just found that avoids the end: of the inputs that it changes, some that do it already
    and of which all must change.  None if the time is over or the solver gives up."""
    changed = unrolled.changed()
    for place in sorted(changed):
        if place not in changed:
            continue
        answer = unrolled.asked([fixed[p] for p in fixed if p == place or p not in changed])
        if over() or answer.forced is None:
            return None
        if not answer.forced:
            changed = unrolled.changed()
    return sorted(changed)


def simulated(made: Circuit, goal: str, run: Run, changes: Sequence[Change]) -> Iterator[bool]:
    """For each change of one input of the run: whether it alone is admissible and avoids the end.

    A run that takes a variable out of its domain counts as one that does.
    """
    simulation = Simulation(made, len(changes), run.frozen)
    admissible, left, hit = simulation.full, 0, 0
    for values in _changed(run, changes, {bit.var.name for bit in (*made.inputs, *made.others)}):
        admissible &= simulation.allowed(values)
        simulation.given(values)
        left, hit = left | simulation.value(made.leaves), simulation.value(made.goals[goal])
        simulation.advance()
    avoiding = admissible & (left | ~hit)
    return (bool(avoiding >> lane & 1) for lane in range(len(changes)))


def _changed(run: Run, changes: Sequence[Change], names: Iterable[str]) -> Iterator[Values]:
    """The inputs of each tick, with each change; the list of the tick before where nothing is new."""
    lanes: dict[Place, list[tuple[int, int]]] = {}
    for lane, (place, value) in enumerate(changes):
        lanes.setdefault(place, []).append((lane, value))
    now: Values = {}
    for number, inputs in enumerate(run.inputs, start=1):
        for name in names:
            values = [inputs[name]] * len(changes)
            for lane, value in lanes.get((number, name), ()):
                values[lane] = value
            if now.get(name) != values:
                now[name] = values
        yield dict(now)
