"""The search for the goals of a circuit: an order of variables is chosen, then ring follows ring."""

from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from time import monotonic

from oxidd.util import DDMemoryError

from rovercheck.checker.encode.bits import Circuit, Literal
from rovercheck.checker.encode.bits.blast import bits_needed
from rovercheck.checker.encode.bits.inputs import input_cut
from rovercheck.checker.encode.bits.model import cut
from rovercheck.checker.encode.bits.order import orders
from rovercheck.checker.encode.cone import as_written, cone, constants, folded
from rovercheck.checker.encode.gather import gathered
from rovercheck.checker.encode.symbolic import transition
from rovercheck.checker.engines.bdd.layers import LayerHit, Layers
from rovercheck.checker.engines.bdd.space import Function, NodeStore, Overdrawn, Space, meets
from rovercheck.checker.results.diagram import ALL, NONE, Diagram, DiagramNode
from rovercheck.checker.results.verdict import Exhausted, Run
from rovercheck.checker.search import DepthSearched, GoalReached, GoalsExcluded, GoalsLeftOpen, SearchEvent
from rovercheck.spec_model.lang.evaluate import admissible, step
from rovercheck.spec_model.lang.expr import Var
from rovercheck.spec_model.lang.system import TransitionSystem

# --- shortest runs, rebuilt backwards through the rings ------------------------------------------------

Bits = dict[Literal, int]
"""Values of latches, inputs and others."""


def run_to(layers: Layers, depth: int, hit: LayerHit) -> Run:
    """A run of ``depth`` ticks to a state of that ring, and one more tick, which is a hit."""
    space = layers.space
    at = _picked(layers.rings[depth] & hit.ticks, space.current)
    ticks = [at]
    for ring in reversed(layers.rings[:depth]):
        at = _before(layers, ring, at)
        ticks.append(at)
    others = _picked(layers.loose, space.current)
    outside = {bit.literal: others[bit.literal] for bit in space.circuit.others}
    return space.circuit.run(at, [outside | _inputs(layers, tick) for tick in reversed(ticks)])


def _inputs(layers: Layers, tick: Bits) -> Bits:
    """The inputs of a tick, hidden ones such that the cut has the values of the tick."""
    space = layers.space
    together = space.manager.true()
    for part in layers.definitions:
        for literal, function in part:
            together = together & (function if tick[literal] else ~function)
    kept = {bit.literal: tick[bit.literal] for bit in space.cut.kept}
    return kept | _picked(together, space.hidden)


def _before(layers: Layers, ring: Function, after: Bits) -> Bits:
    """A state of the ring and inputs that lead to the state after the tick."""
    found = ring & layers.assume
    for literal, function in layers.next.items():
        layers.space.pause()
        found = found & (function if after[literal] else ~function)
    return _picked(found, layers.space.current)


def _picked(function: Function, variables: Mapping[Literal, int]) -> Bits:
    """Values of bits that make the function true; 0 where both do.

    Raises ``ArithmeticError`` if there are none: a ring that is not reached from the one before it.
    """
    cube = function.pick_cube()
    if cube is None:
        raise ArithmeticError("the engine is wrong: no tick leads from one ring to the next")
    return {literal: int(bool(cube[variable])) for literal, variable in variables.items()}


def last(system: TransitionSystem, run: Run) -> dict[str, int]:
    """The state after a run, by the reference semantics.  Raises ``ArithmeticError`` if it is none."""
    at = {**system.init, **run.frozen}
    for number, inputs in enumerate(run.inputs, 1):
        if not admissible(system, at, inputs):
            raise ArithmeticError(f"the engine is wrong: its run is not admissible in tick {number}")
        at = step(system, at, inputs)
    return at


# --- goals that are searched together ------------------------------------------------------------------

EXTRA = 8
"""Bits that a goal may add to those of others and still be searched with them."""


@dataclass(frozen=True)
class BddGroup:
    """A circuit for some goals, and the constants among the variables that the goals depend on.

    Constants keep their value in every run because all of them together do; the circuit has none.
    """

    circuit: Circuit
    constants: tuple[tuple[Var, int], ...]


def groups(system: TransitionSystem, goals: Sequence[str]) -> Iterator[BddGroup]:
    """The groups, those with few latches first."""
    whole = transition(system)
    fixed = constants(whole)
    moving = folded(whole, fixed)
    cones = {
        goal: {v.name: v for v in cone(moving, [goal]).variables if v.name not in goals} for goal in goals
    }
    for together in gathered(cones, EXTRA):
        kept = tuple((v, fixed[v.name]) for v in as_written(system, together) if v.name in fixed)
        yield BddGroup(cut(moving, together), kept)


# --- the set of states reached, as a diagram over bits that other tools can read -------------------

MOST = 100_000
"""Nodes of the largest diagram that is kept: a certificate is read by people's solvers, too."""


def diagram(group: BddGroup, layers: Layers) -> Diagram | None:
    """The states reached, constants among them; None if there are too many nodes."""
    if 2 * layers.reached.node_count() > MOST:
        return None
    bits = {layers.space.current[x.literal]: x.bit for x in group.circuit.latches}
    nodes: list[DiagramNode] = []
    numbers: dict[Function, int] = {}

    def number(function: Function) -> int:
        """A node without complement; the recursion is as deep as there are bits."""
        if function not in numbers:
            parts = function.cofactors()
            if parts is None:
                return ALL if function.valid() else NONE
            high, low = map(number, parts)
            bit = bits[_variable(function)]
            nodes.append(DiagramNode(bit.var.name, bit.number, low, high))
            numbers[function] = len(nodes) + 1
        return numbers[function]

    root = number(layers.reached)
    for var, value in group.constants:
        for i in range(bits_needed(var)):
            low, high = (NONE, root) if value >> i & 1 else (root, NONE)
            nodes.append(DiagramNode(var.name, i, low, high))
            root = len(nodes) + 1
    return Diagram(tuple(nodes), root)


def _variable(function: Function) -> int:
    variable = function.node_var()
    assert variable is not None
    return variable


TRIAL = 300_000
"""Nodes that may be made to try an order of the variables."""
MORE = 8
"""So many times as many when they do not suffice for a tick in any order."""


def search(
    system: TransitionSystem, goals: Sequence[str], most: int | None, nodes: int
) -> Iterator[SearchEvent]:
    """Events until every goal is decided, or known not to be reached within ``most`` ticks, or given up.

    There may be at most ``nodes`` nodes at a time.  Raises ``ModelError`` on a temporal word, and
    ``ArithmeticError`` when a run that was found is none.
    """
    store = NodeStore(nodes)
    for group in groups(system, goals):
        yield from _Search(system, group, most).events(store)


class _Search:
    """The goals of a group that are still open."""

    def __init__(self, system: TransitionSystem, group: BddGroup, most: int | None) -> None:
        self._system = system
        self._group = group
        self._most = most
        self._open = list(group.circuit.goals)
        self._start = monotonic()

    def events(self, store: NodeStore) -> Iterator[SearchEvent]:
        try:
            yield from self._rings(_chosen(store, self._group.circuit))
        except DDMemoryError:
            yield GoalsLeftOpen(tuple(self._open), "the memory limit is reached")

    def _rings(self, layers: Layers) -> Iterator[SearchEvent]:
        """What the rings show, one after the other."""
        depth = 0
        while depth < len(layers.rings) or layers.step():
            if depth == self._most:
                return
            yield from self._found(layers, depth)
            if not self._open:
                return
            if meets(layers.rings[depth], layers.leaving.states):
                yield self._undefined(layers, depth)
                return
            depth += 1
            yield DepthSearched(tuple(self._open), depth, self._counts(layers))
        yield GoalsExcluded(tuple(self._open), self._exhausted(layers))

    def _counts(self, layers: Layers) -> str:
        """``1.2e+09 states (3e+08/s), 20,310 nodes``."""
        states = layers.states()
        rate = states / max(1e-3, monotonic() - self._start)
        return f"{states:.3g} states ({rate:.2g}/s), {layers.space.used:,} nodes"

    def _found(self, layers: Layers, depth: int) -> Iterator[SearchEvent]:
        for goal in list(self._open):
            if meets(layers.rings[depth], layers.goals[goal].states):
                run = run_to(layers, depth, layers.goals[goal])
                if not last(self._system, run)[goal]:
                    raise ArithmeticError(f"the engine is wrong: {goal} is not reached by its run")
                self._open.remove(goal)
                yield GoalReached(goal, run)

    def _undefined(self, layers: Layers, depth: int) -> SearchEvent:
        after = last(self._system, run_to(layers, depth, layers.leaving))
        names = [v.name for v in self._system.variables if after[v.name] not in v.domain]
        return GoalsLeftOpen(
            tuple(self._open), f"{', '.join(names)} may leave its domain in tick {depth + 1}"
        )

    def _exhausted(self, layers: Layers) -> Exhausted:
        names = dict.fromkeys(latch.bit.var.name for latch in self._group.circuit.latches)
        kept = diagram(self._group, layers)
        return Exhausted(layers.states(), 0, len(layers.rings) - 1, tuple(names), diagram=kept)


def _chosen(store: NodeStore, circuit: Circuit) -> Layers:
    """The traversal in the order that gets furthest with few nodes; it goes on from there."""
    granted = TRIAL
    while not (tried := _tried(store, circuit, granted)):
        granted *= MORE
    best = max(tried, key=_far)
    best.space.granted = None
    return best


def _tried(store: NodeStore, circuit: Circuit, granted: int) -> list[Layers]:
    """Traversals in several orders, each until it has made so many nodes, or one until it is closed."""
    cut = input_cut(circuit)
    found: list[Layers] = []
    for order in orders(replace(circuit, inputs=cut.bits)):
        with suppress(Overdrawn):
            found.append(Layers(Space(store, circuit, cut, order, granted)))
            while found[-1].step():
                pass
            return found
    return found


def _far(layers: Layers) -> tuple[bool, int, int]:
    """Whether all is reached, or else after how many ticks, with how few nodes."""
    return layers.closed, len(layers.rings), -layers.reached.node_count()
