"""Lifting: from one valuation that reaches a target to all those that do so for the same reason."""

from checker.engines.pdr.cones import Cones
from checker.engines.pdr.cubes import Cube, cube
from checker.engines.pdr.lemmas import LemmaStep
from checker.engines.pdr.machine import PdrMachine


class Lifter:
    """Generalises one valuation and its inputs to all valuations in which the same inputs do the same."""

    def __init__(self, machine: PdrMachine) -> None:
        self._machine = machine
        self._cones = Cones(machine, inside=False)

    def into(self, step: LemmaStep, target: Cube) -> Cube:
        """The valuations from which, as the step shows of one, the inputs lead into the target."""
        after = self._machine.after
        return self._lifted(step, [after[x] for x in target.literals])

    def onto(self, step: LemmaStep, goal: str) -> Cube:
        """The valuations from which, as the step shows of one, the inputs make the goal true."""
        return self._lifted(step, [self._machine.goals[goal]])

    def _lifted(self, step: LemmaStep, wanted: list[int]) -> Cube:
        """By a core of why the inputs cannot fail to do what is wanted and be assumed."""
        if self._cones.bloated:
            self._cones = Cones(self._machine, inside=False)
        cones = self._cones
        active = cones.fresh()
        cones.add([-active, *(-x for x in cones.literals([self._machine.assume, *wanted]))])
        latches = cones.literals(step.latches)
        if cones.solve([active, *cones.literals(step.inputs), *latches]):
            raise ArithmeticError("the engine is wrong: a tick does not do what it was found to do")
        core = cones.core()
        cones.retire(active)
        return cube(x for x, y in zip(step.latches, latches, strict=True) if y in core)
