"""Does a smaller set of inputs force the end of a run?

Every set that forces it has a member in every *correction set*: inputs that avoid the end with other values,
while the rest is as in the run.  So a solver is asked for a smaller set that meets all correction sets known
so far.  If there is none, no smaller set forces the end; one that does not force it gives another correction
set.  This is the duality of minimal unsatisfiable subsets and hitting sets (Ignatiev, Previti, Liffiton and
Marques-Silva, Smallest MUS extraction with minimal hitting set dualization, CP 2015).
"""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import islice

from pysat.card import ITotalizer
from pysat.solvers import Minisat22

from rovercheck.checker.encode.bits import Circuit
from rovercheck.checker.encode.bits.simulate import BitSimulation, Values
from rovercheck.checker.explain.unrolled_run import CONFLICTS, LANES, Over, Place, Unrolled
from rovercheck.checker.results.verdict import Run
from rovercheck.checker.system.partition import Partition

ROUNDS = 256
"""Correction sets after which a smaller set is no longer looked for."""
TRIED = 64
"""Cells of an input that are tried; others are left to the solver."""

Change = tuple[Place, int]
"""Another value for one input of a run."""
Avoids = Callable[[Sequence[Change]], Iterable[bool]]
"""For each change whether it alone is admissible and avoids the end."""


def indispensable(
    places: Iterable[Place], run: Run, cells: Mapping[str, Partition], avoids: Avoids, over: Over
) -> set[Place]:
    """Inputs that are in every set that forces the end, as another value of each alone avoids it.

    There may be more of them: where the time is ``over``, or where an input has more than ``TRIED`` cells.
    """
    found = set[Place]()
    changes = (c for p in places for c in _others(p, run, cells[p[1]]) if p not in found)
    while not over() and (some := list(islice(changes, LANES))):
        found |= {place for (place, _), avoiding in zip(some, avoids(some), strict=True) if avoiding}
    return found


def _others(place: Place, run: Run, cells: Partition) -> Iterator[Change]:
    """Values of other cells than that of the run, of some evenly chosen ones if there are many."""
    own = cells.cell_of[run.inputs[place[0] - 1][place[1]]]
    every = -(-len(cells.cells) // TRIED)
    return ((place, cell.value) for n, cell in enumerate(cells.cells) if n != own and n % every == 0)


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
    with _Meeting([p for p in fixed if p not in needed], len(kept) - len(needed) - 1) as meeting:
        for _ in range(ROUNDS):
            few = None if over() else meeting.few(len(kept) - len(needed) - 1)
            if few is None:
                break
            if not few.found:
                return kept, True
            chosen = {place: fixed[place] for place in (*needed, *few.places)}
            answer = unrolled.asked(chosen.values())
            if answer.forced:
                kept = {place: number for place, number in chosen.items() if number in answer.core}
                continue
            correction = _correction(unrolled, fixed, over) if answer.forced is False else None
            if correction is None:
                break
            meeting.meet(correction)
    return kept, False


@dataclass(frozen=True)
class _Few:
    """Whether there is a set so small, and one of them."""

    found: bool
    places: tuple[Place, ...] = ()


class _Meeting:
    """Sets of at most so many places that have a member in each of some sets."""

    def __init__(self, places: Sequence[Place], most: int) -> None:
        self._number = {place: number for number, place in enumerate(places, start=1)}
        self._count = ITotalizer(list(self._number.values()), ubound=most, top_id=len(places))
        self._solver = Minisat22(bootstrap_with=self._count.cnf.clauses)

    def __enter__(self) -> "_Meeting":
        return self

    def __exit__(self, *_: object) -> None:
        self._solver.delete()
        self._count.delete()

    def meet(self, places: Iterable[Place]) -> None:
        """Another set, of which a member is wanted."""
        self._solver.add_clause([self._number[place] for place in places])

    def few(self, most: int) -> _Few | None:
        """A set with at most so many members.  None if the solver gives up."""
        if most < 0:
            return _Few(False)
        self._solver.conf_budget(CONFLICTS)
        found = self._solver.solve_limited(assumptions=[-self._count.rhs[most]], expect_interrupt=True)
        if not found:
            return None if found is None else _Few(False)
        model = self._solver.get_model()
        return _Few(True, tuple(place for place, number in self._number.items() if model[number - 1] > 0))


def _correction(unrolled: Unrolled, fixed: Mapping[Place, int], over: Over) -> set[Place] | None:
    """From the run just found that avoids the end: of the inputs that it changes, some that do it already
    and of which all must change.  None if the time is over or the solver gives up."""
    changed = unrolled.changed()
    todo = sorted(changed)
    while todo:
        place = todo.pop(0)
        answer = unrolled.asked([fixed[p] for p in fixed if p == place or p not in changed])
        if over() or answer.forced is None:
            return None
        if not answer.forced:
            changed = unrolled.changed()
            todo = [p for p in todo if p in changed]
    return changed


def simulated(made: Circuit, goal: str, run: Run, changes: Sequence[Change]) -> Iterator[bool]:
    """For each change of one input of the run: whether it alone is admissible and avoids the end.

    A run that takes a variable out of its domain counts as one that does, whatever comes after that.
    """
    simulation = BitSimulation(made, len(changes), run.frozen)
    admissible, left, hit = simulation.full, 0, 0
    for values in _changed(run, changes, {bit.var.name for bit in (*made.inputs, *made.others)}):
        simulation.given(values)
        allowed = simulation.value(made.assume) & simulation.value(made.loose)
        admissible &= allowed | left
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
