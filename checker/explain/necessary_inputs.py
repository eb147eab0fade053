"""The inputs that force the end of a run: none can be left out, and the other inputs may be anything.

Found by deletion.  A long run is gone through backwards (see ``backwards``).  Another is unrolled, and what
is deleted from is an unsatisfiable core: whole inputs are tried first, then stretches of ticks, then
single ones, so that what is left is few inputs over long stretches.  A set that cannot lose any member is
called minimal (subset-minimal).  Whether there is one with fewer members is looked for then (``fewest``).
"""

from collections.abc import Iterable, Sequence
from contextlib import suppress
from functools import partial

from rovercheck.checker.encode.bits import Circuit, circuit
from rovercheck.checker.engines import Progress, quiet
from rovercheck.checker.explain.backwards import ExplanationTooLarge, backwards
from rovercheck.checker.explain.cells import cells_of
from rovercheck.checker.explain.fewest import fewest, indispensable, simulated
from rovercheck.checker.explain.unrolled_run import Over, Place, Unrolled, never
from rovercheck.checker.explain.value_ranges import widened
from rovercheck.checker.results.trace import NecessaryInputs, Needed
from rovercheck.checker.results.verdict import Run
from rovercheck.checker.system.partition import Partition
from rovercheck.checker.system.slice import sliced
from rovercheck.checker.verify.runs.replay import ReplayError
from rovercheck.spec_model.lang.expr import Var
from rovercheck.spec_model.lang.system import TransitionSystem

FAR = (1, -1, 1 << 30, -(1 << 30))
"""By how many cells inputs are changed in a simulation: to the next value that matters, to the last one."""
LARGE = 200_000
"""Nodes of a circuit, times ticks, from which on a run is not unrolled if there is another way."""
WIDE = 12_000
"""Nodes of a circuit for which there is no use in trying that way."""


def forcing(
    system: TransitionSystem,
    goal: Var,
    run: Run,
    progress: Progress = quiet,
    over: Over = never,
) -> NecessaryInputs:
    """The inputs that force the goal after the last tick of a run, whatever admissible values others have.

    ``over`` tells that the time is over: then what was found so far is returned.  Raises ``OutOfTime`` if
    that is nothing, and ``ReplayError`` if all inputs of the run together do not force its end: the solver
    then contradicts the replay.
    """
    made, cells = circuit(system, [goal.name]), cells_of(sliced(system, [goal]), run)
    wide, minimal, smallest = _searched(made, goal.name, run, cells, progress, over)
    order = {v.name: i for i, v in enumerate(system.inputs)}
    places = sorted(wide, key=lambda place: (place[0], order[place[1]]))
    return NecessaryInputs(tuple(Needed(*place, wide[place]) for place in places), minimal, smallest)


def _searched(
    made: Circuit, goal: str, run: Run, cells: dict[str, Partition], progress: Progress, over: Over
) -> tuple[dict[Place, frozenset[int]], bool, bool]:
    """The needed inputs with the values that do, whether none can be left out, and whether none are fewer."""
    if len(made.aig) < WIDE and len(made.aig) * len(run) > LARGE:
        with suppress(ExplanationTooLarge):
            found, minimal = backwards(made, goal, run, cells, progress, over)
            progress("looking for a smaller set of inputs")
            sure = indispensable(found, run, cells, partial(simulated, made, goal, run), over)
            return found, minimal, sure == found.keys()
    progress(f"unrolling {len(run)} ticks")
    with Unrolled(made, goal, run, over) as unrolled:
        search = _Search(unrolled, cells, progress, over)
        search.minimise()
        search.shrink()
        return widened(unrolled, search.kept, cells, over), search.minimal, search.smallest


class _Search:
    """What is still kept, and the questions asked so far."""

    def __init__(
        self,
        unrolled: Unrolled,
        cells: dict[str, Partition],
        progress: Progress,
        over: Over,
    ) -> None:
        self._unrolled = unrolled
        self._cells = cells
        self._progress = progress
        self._over = over
        self.minimal, self.smallest = True, False
        self.fixed = {p: unrolled.within(p, [(unrolled.own(p),) * 2]) for p in unrolled.places}
        self.kept = dict(self.fixed)
        self._core: frozenset[int] = frozenset()

    def minimise(self) -> None:
        """Leave out what can be left out.  Raises ``ReplayError`` if nothing forces the end."""
        if not self.forces(self.kept.values()):
            raise ReplayError("the solver finds that the inputs of the run do not lead to its end.")
        self._progress(f"{len(self._core)} of {len(self.kept)} inputs may be needed")
        critical = self._critical([p for p, a in self.kept.items() if a in self._core])
        if self._drop([p for p in self.kept if p not in critical]):
            return
        for name in {name: None for _, name in self.kept if name not in {n for _, n in critical}}:
            self._drop([p for p in self.kept if p[1] == name])
        self.kept = {p: a for p, a in self.kept.items() if a in self._core}
        for name in dict.fromkeys(name for _, name in self.kept):
            self._progress(f"{len(self.kept)} inputs may be needed")
            self._thin([p for p in self.kept if p[1] == name and p not in critical])

    def shrink(self) -> None:
        """Take a smaller set of inputs, if there is one that forces the end."""
        if self.minimal:  # a search that was cut short before has no time or effort left for this
            self._progress(f"looking for fewer than {len(self.kept)} inputs")
            kept, self.smallest = fewest(self._unrolled, self.kept, self.fixed, self._cells, self._over)
            self.kept = dict(kept)

    def forces(self, assumptions: Iterable[int]) -> bool:
        """Whether these assumptions force the end; not, if that is not found out."""
        answer = self._unrolled.asked(list(assumptions))
        if answer.forced is None:
            self.minimal = False
        if answer.forced:
            self._core = answer.core
        return bool(answer.forced)

    def _thin(self, places: Sequence[Place]) -> None:
        """Leave out as many of the places as possible, the first ones first."""
        places = [p for p in places if p in self.kept]
        if not places or self._drop(places) or len(places) == 1:
            return
        middle = len(places) // 2
        self._thin(places[:middle])
        self._thin(places[middle:])

    def _drop(self, places: Sequence[Place]) -> bool:
        """Leave out some places if the others still force the end."""
        if self._over():
            self.minimal = False
            return False
        gone = set(places)
        if not self.forces(a for p, a in self.kept.items() if p not in gone):
            return False
        for place in places:
            del self.kept[place]
        return True

    def _critical(self, places: Sequence[Place]) -> set[Place]:
        """Places of which a simulation shows that another value there alone avoids the end."""
        found = set[Place]()
        for far in FAR:
            changes = [(p, self._other(p, far)) for p in places if p not in found]
            avoided = zip(changes, self._unrolled.avoids(changes), strict=True)
            found |= {place for (place, _), avoids in avoided if avoids}
        return found

    def _other(self, place: Place, far: int) -> int:
        """The value of an input, or of its outermost one, so many cells away."""
        cells, own = self._cells[place[1]], self._unrolled.own(place)
        at = cells.cell_of[own] + far
        return cells.cells[max(0, min(at, len(cells.cells) - 1))].value
