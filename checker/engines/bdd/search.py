"""The search for the goals of a circuit: an order of variables is chosen, then ring follows ring."""

from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import replace

from oxidd.util import DDMemoryError

from checker.encode.bits import Circuit
from checker.encode.bits.inputs import input_cut
from checker.encode.bits.order import orders
from checker.engines.bdd.events import BddBound, BddClosed, BddFound, BddStuck, Event
from checker.engines.bdd.groups import BddGroup, groups
from checker.engines.bdd.kept import diagram
from checker.engines.bdd.layers import Layers
from checker.engines.bdd.runs import last, run_to
from checker.engines.bdd.space import NodeStore, Overdrawn, Space, meets
from checker.results.verdict import Exhausted
from spec_model.lang.system import TransitionSystem

TRIAL = 300_000
"""Nodes that may be made to try an order of the variables."""
MORE = 8
"""So many times as many when they do not suffice for a tick in any order."""


def search(system: TransitionSystem, goals: Sequence[str], most: int | None, nodes: int) -> Iterator[Event]:
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

    def events(self, store: NodeStore) -> Iterator[Event]:
        try:
            yield from self._rings(_chosen(store, self._group.circuit))
        except DDMemoryError:
            yield BddStuck(tuple(self._open), "the memory limit is reached")

    def _rings(self, layers: Layers) -> Iterator[Event]:
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
            yield BddBound(tuple(self._open), depth, layers.states(), layers.space.used)
        yield BddClosed(tuple(self._open), self._exhausted(layers))

    def _found(self, layers: Layers, depth: int) -> Iterator[Event]:
        for goal in list(self._open):
            if meets(layers.rings[depth], layers.goals[goal].states):
                run = run_to(layers, depth, layers.goals[goal])
                if not last(self._system, run)[goal]:
                    raise ArithmeticError(f"the engine is wrong: {goal} is not reached by its run")
                self._open.remove(goal)
                yield BddFound(goal, run)

    def _undefined(self, layers: Layers, depth: int) -> Event:
        after = last(self._system, run_to(layers, depth, layers.leaving))
        names = [v.name for v in self._system.variables if after[v.name] not in v.domain]
        return BddStuck(tuple(self._open), f"{', '.join(names)} may leave its domain in tick {depth + 1}")

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
