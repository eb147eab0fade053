"""The inputs that force the end of a long run, found tick by tick from the last one.

Before each tick the run is taken as it was, and after it the inputs found so far are all that is known.
The states that may follow are kept as a decision diagram; they are few, as most inputs that are left
open change nothing for long.  So the ticks are never unrolled, and a run of some hundred is no harder than
so many runs of a few.
"""

from collections.abc import Mapping, Sequence
from functools import cache

from rovercheck.checker.encode.bits import Bit, Circuit
from rovercheck.checker.encode.bits.inputs import InputCut
from rovercheck.checker.encode.bits.order import orders
from rovercheck.checker.engines import Progress
from rovercheck.checker.engines.bdd.relation import relation
from rovercheck.checker.engines.bdd.space import DDMemoryError, Function, NodeStore, Overdrawn, Space, meets
from rovercheck.checker.explain.unrolled_run import Over, Place, never
from rovercheck.checker.explain.value_ranges import widest
from rovercheck.checker.results.verdict import Run
from rovercheck.checker.system.partition import Partition
from rovercheck.checker.verify.runs.replay import ReplayError

NODES = 1 << 22
"""Nodes of decision diagrams at a time."""
GRANTED = 1 << 21
"""Nodes that may be made before the first tick is looked at: a circuit that takes more is too large."""

Values = dict[str, frozenset[int]]
"""The values that the needed inputs of a tick may have, by name."""


class ExplanationTooLarge(Exception):
    """The sets of states do not fit into the nodes that they may take."""


def backwards(
    made: Circuit, goal: str, run: Run, cells: Mapping[str, Partition], progress: Progress, over: Over
) -> tuple[dict[Place, frozenset[int]], bool]:
    """The needed inputs of a run with the values that they may have, and whether none can be left out.

    When the time is ``over``, all inputs of the ticks not yet looked at are kept as they are.  Raises
    ``ExplanationTooLarge``, and ``ReplayError`` if the inputs of the run do not force its end.
    """
    try:
        search = _Search(_Ticks(made, goal, run), cells, over)
        needed = search.needed(progress)
    except (DDMemoryError, Overdrawn) as error:
        raise ExplanationTooLarge(str(error)) from error
    return {(tick, name): values for tick, at in needed for name, values in at.items()}, search.minimal


@cache
def _store() -> NodeStore:
    """The nodes of this process: there can be one store only."""
    return NodeStore(NODES)


class _Ticks:
    """The ticks of a run as operations on sets of states and inputs."""

    def __init__(self, made: Circuit, goal: str, run: Run) -> None:
        self.run = run
        self._bits: dict[str, list[Bit]] = {}
        for bit in made.inputs:
            self._bits.setdefault(bit.var.name, []).append(bit)
        order = next(iter(orders(made)))
        self._space = space = Space(_store(), made, InputCut(made.inputs, (), ()), order, GRANTED)
        space.build([made.assume, made.leaves, made.goals[goal], *(x.next for x in made.latches)])
        assume, leaves, hit = space(made.assume), space(made.leaves), space(made.goals[goal])
        self._avoiding = {False: assume & leaves, True: assume & (leaves | ~hit)}
        self._relation = relation(space, assume, choosing=True)
        self.before = [self._start(made)]
        """The only state before each tick of the run."""
        for tick in range(1, len(run)):
            self.before.append(self.image(self.before[-1] & self.within(self.own(tick, self.names))))
        space.forget()
        space.granted = None

    @property
    def names(self) -> list[str]:
        """The inputs of the circuit."""
        return list(self._bits)

    def own(self, tick: int, names: Sequence[str]) -> Values:
        """The values that inputs have in the run."""
        return {name: frozenset({self.run.inputs[tick - 1][name]}) for name in names}

    def avoids(self, tick: int, given: Function) -> bool:
        """Whether a tick from some of these states, with these inputs, avoids the end of the run.

        One that takes a variable out of its domain is taken for one that does: nothing is claimed of it.
        """
        return meets(given, self._avoiding[tick == len(self.run)])

    def image(self, given: Function) -> Function:
        """The states after a tick."""
        self._space.pause()
        return self._relation.image(given)

    def within(self, values: Values) -> Function:
        """That the inputs have some of these values."""
        result = self._space.manager.true()
        for name, those in values.items():
            result = result & self._one_of(name, those)
        return result

    def _one_of(self, name: str, values: frozenset[int]) -> Function:
        result = self._space.manager.false()
        for value in values:
            result = result | self._equal(self._bits[name], value)
        return result

    def _equal(self, bits: Sequence[Bit], value: int) -> Function:
        return self._space.cube({self._space.current[b.literal]: bool(value >> b.number & 1) for b in bits})

    def _start(self, made: Circuit) -> Function:
        bits = dict[int, bool]()
        for latch in made.latches:
            bit = latch.bit
            first = latch.init if latch.init is not None else self.run.frozen[bit.var.name] >> bit.number & 1
            bits[self._space.current[latch.literal]] = bool(first)
        return self._space.cube(bits)


class _Search:
    """What is needed in the ticks looked at, and what is known of the states between them.

    Of a state that is ``_known``, all that can follow ends as the run; of those that are ``_failed``,
    some may not.  Both stay true while earlier ticks are looked at.
    """

    def __init__(self, ticks: _Ticks, cells: Mapping[str, Partition], over: Over) -> None:
        self._ticks, self._cells, self._over = ticks, cells, over
        self.minimal = True
        self._allowed: dict[int, Function] = {}
        self._known: dict[int, Function] = {}
        self._failed: dict[int, Function] = {}

    def needed(self, progress: Progress) -> list[tuple[int, Values]]:
        """The ticks with the inputs that they need; some need none."""
        found: list[tuple[int, Values]] = []
        later: Values = {}
        last = len(self._ticks.run)
        for tick in range(last, 0, -1):
            progress(f"tick {tick} of {last}: {sum(len(at) for _, at in found)} inputs needed after it")
            everything = self._ticks.own(tick, self._ticks.names)
            if not self._forced(tick, everything):
                raise ReplayError("the sets of states show that the run does not lead to its end.")
            later = self._widened(tick, self._least(tick, everything, later), later)
            self._allowed[tick] = self._ticks.within(later)
            found.append((tick, later))
        return found

    def _least(self, tick: int, everything: Values, later: Values) -> Values:
        """Leave out inputs, first those that are not needed in the tick after."""
        kept = everything
        same = {n: v for n, v in kept.items() if n in later}
        if self._holds(tick, same):
            kept = same
        for name in sorted(kept, key=lambda n: n in later):
            without = {n: v for n, v in kept.items() if n != name}
            if self._holds(tick, without):
                kept = without
        return kept

    def _widened(self, tick: int, kept: Values, later: Values) -> Values:
        """Allow more values: those of the tick after, or as many as possible."""
        wide = dict(kept)
        for name, [own] in kept.items():
            if own in later.get(name, ()) and self._holds(tick, {**wide, name: later[name]}):
                wide[name] = later[name]
            else:
                wide[name] = self._widest(tick, wide, name, own)
        return wide

    def _widest(self, tick: int, wide: Values, name: str, own: int) -> frozenset[int]:
        cells = self._cells[name]
        others = set(range(len(cells.cells))) - {cells.cell_of[own]}

        def takes(values: Sequence[int]) -> bool:
            return self._holds(tick, {**wide, name: frozenset(values)})

        return frozenset(widest(cells, own, others, takes, self._over))

    def _holds(self, tick: int, values: Values) -> bool:
        """Whether the end is forced with these inputs in a tick; not, if the time is over before."""
        forced = self._forced(tick, values, self._over)
        if forced is None:
            self.minimal = False
        return bool(forced)

    def _forced(self, tick: int, values: Values, over: Over = never) -> bool | None:
        """Whether all runs end alike that are as the run before a tick and have these inputs in it."""
        at, allowed = self._ticks.before[tick - 1], self._ticks.within(values)
        passed: dict[int, Function] = {}
        for number in range(tick, len(self._ticks.run) + 1):
            if over():
                return None
            given = at & allowed
            if self._ticks.avoids(number, given) or self._fails(number - 1, at):
                self._failed |= passed
                return False
            if number == len(self._ticks.run):
                break
            at = self._unknown(number, self._ticks.image(given))
            if not at.satisfiable():
                break
            passed[number], allowed = at, self._allowed[number + 1]
        self._known |= {n: states | self._known.get(n, states) for n, states in passed.items()}
        return True

    def _fails(self, number: int, states: Function) -> bool:
        """Whether some run from these states after a tick is known to end otherwise."""
        return number in self._failed and not meets(self._failed[number], ~states)

    def _unknown(self, number: int, states: Function) -> Function:
        """Those of the states after a tick from which it is not known that all runs end alike."""
        return states & ~self._known[number] if number in self._known else states
