"""Shortest runs, rebuilt backwards through the rings: from each valuation a tick that leads to it."""

from collections.abc import Mapping

from checker.encode.bits import Literal
from checker.engines.bdd.layers import LayerHit, Layers
from checker.engines.bdd.space import Function
from checker.results.verdict import Run
from spec_model.lang.evaluate import admissible, step
from spec_model.lang.system import TransitionSystem

Bits = dict[Literal, int]
"""Values of latches, inputs and others."""


def run_to(layers: Layers, depth: int, hit: LayerHit) -> Run:
    """A run of ``depth`` ticks to a valuation of that ring, and one more tick, which is a hit."""
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
    """A valuation of the ring and inputs that lead to the valuation after the tick."""
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
    """The valuation after a run, by the reference semantics.  Raises ``ArithmeticError`` if it is none."""
    at = {**system.init, **run.frozen}
    for number, inputs in enumerate(run.inputs, 1):
        if not admissible(system, at, inputs):
            raise ArithmeticError(f"the engine is wrong: its run is not admissible in tick {number}")
        at = step(system, at, inputs)
    return at
