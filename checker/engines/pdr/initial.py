"""The initial valuations: one value for most latches, a choice for those of frozen variables."""

from checker.engines.pdr.cones import Cones
from checker.engines.pdr.cubes import Cube
from checker.engines.pdr.machine import PdrMachine


class Initial:
    """The initial valuations of a machine."""

    def __init__(self, machine: PdrMachine) -> None:
        self._machine = machine
        self._cones = Cones(machine, inside=False)
        self._free = frozenset(range(1, machine.latches + 1)).difference(map(abs, machine.init))
        self._cones.add([self._cones.literal(machine.start)])

    def meets(self, wanted: Cube) -> bool:
        """Whether an initial valuation lies in a cube that contradicts no initial value."""
        if self._free.isdisjoint(map(abs, wanted.literals)):
            return True
        cones = self._cones
        return cones.solve([cones.literal(x) for x in wanted.literals if abs(x) in self._free])

    def inside(self, wanted: Cube) -> tuple[int, ...]:
        """The values of the frozen latches in an initial valuation that lies in a cube."""
        if not self._cones.solve([self._cones.literal(x) for x in wanted.literals if abs(x) in self._free]):
            raise ArithmeticError("the engine is wrong: a run starts where none does")
        return self._cones.model()[0]
