"""Breadth-first traversal: the states reached, and those new after each tick (the onion rings)."""

from collections.abc import Iterator
from dataclasses import dataclass

from rovercheck.checker.encode.bits import Circuit, Literal
from rovercheck.checker.engines.bdd.relation import relation
from rovercheck.checker.engines.bdd.space import Function, Space


@dataclass(frozen=True)
class LayerHit:
    """Something that a tick may do: states and inputs with which it does, and the states alone."""

    ticks: Function
    states: Function


class Layers:
    """The traversal of one circuit in one order of its variables.

    ``rings[t]`` are the states first reached after ``t`` ticks; ``closed``: there are no further rings.
    ``goals`` are the ticks that reach a goal, ``leaving`` those that take a variable out of its domain;
    rings beyond one with such a tick mean nothing.  Everything may raise
    ``Overdrawn``, and ``DDMemoryError`` when there is no node left.
    """

    def __init__(self, space: Space) -> None:
        circuit = space.circuit
        space.build(_roots(circuit))
        self.space = space
        self.closed = False
        self.loose = space(circuit.loose)
        self.definitions = space.definitions()
        self.assume = self._possible() & space(circuit.assume)
        self.next = {latch.literal: space(latch.next) for latch in circuit.latches}
        defined = self.assume & ~space(circuit.leaves)
        self.leaving = self._hit(self.assume & space(circuit.leaves))
        self.goals = {name: self._hit(defined & space(goal)) for name, goal in circuit.goals.items()}
        self._relation = relation(space, self.assume)
        self.reached = space(circuit.start) & _initial(space)
        self.rings = [self.reached]
        space.forget()

    def _hit(self, ticks: Function) -> LayerHit:
        return LayerHit(ticks, ticks.exists(self.space.all(self.space.inputs)))

    def _possible(self) -> Function:
        """What values the cut can have for some inputs: none if the assumption allows no others."""
        space = self.space
        hidden = space.all(space.hidden.values())
        result = space.manager.true() if self.loose.satisfiable() else space.manager.false()
        for part in self.definitions:
            together = space.manager.true()
            for literal, function in part:
                bit = space.manager.var(space.current[literal])
                together = together & bit.equiv(function)
                space.pause()
            result = result & together.exists(hidden)
        return result

    def step(self) -> bool:
        """One more ring; False, and none, if no tick leads to a new state."""
        if self.closed:
            return False
        frontier = min(self.rings[-1], self.reached, key=Function.node_count)
        image = self._relation.image(frontier)
        new = self.reached.imp_strict(image)
        self.closed = not new.satisfiable()
        if not self.closed:
            self.reached = self.reached | image
            self.rings.append(new)
        return not self.closed

    def states(self) -> int:
        """How many states of the latches are reached."""
        return self.reached.sat_count(len(self.space.circuit.latches))


def _initial(space: Space) -> Function:
    latches = space.circuit.latches
    return space.cube({space.current[x.literal]: bool(x.init) for x in latches if x.init is not None})


def _roots(circuit: Circuit) -> Iterator[Literal]:
    yield from (circuit.assume, circuit.start, circuit.leaves, circuit.loose)
    yield from circuit.goals.values()
    yield from (latch.next for latch in circuit.latches)
