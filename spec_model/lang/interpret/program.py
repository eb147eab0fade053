"""A chart that is a program being run: its statements in order, and which paths they take."""

from collections.abc import Sequence

from rovercheck.spec_model.lang.action import Action, Assign, If
from rovercheck.spec_model.lang.evaluate import evaluate
from rovercheck.spec_model.lang.fired_transition import FiredTransition
from rovercheck.spec_model.lang.interpret.run import Admits, Values, store
from rovercheck.spec_model.lang.programmed import ProgrammedChart


class ProgramRun:
    """The run of such a chart over values shared with the other components."""

    def __init__(
        self, chart: ProgrammedChart, at: Values, fired: list[FiredTransition], admits: Admits
    ) -> None:
        self.chart, self._at, self._fired, self._admits = chart, at, fired, admits
        for place in (chart.entered, *chart.locations):
            at[place.name] = place.init

    def step(self) -> None:
        """One executed step.  Raises ``ModelError`` for a value outside its domain."""
        self._run(self.chart.program.statements)
        for one in self.chart.program.temporaries:
            self._at.pop(one.name, None)

    def _run(self, statements: Sequence[Action]) -> None:
        for one in statements:
            match one:
                case Assign(var) if (path := self.chart.program.fired.get(var.name)) is not None:
                    self._fired.append(path)
                case Assign(var) if var.name in self.chart.program.markers:
                    pass
                case Assign(var, value):
                    store(self._at, self.chart.name, var, evaluate(value, self._at), self._admits)
                case If(condition, then, otherwise):
                    self._run(then if evaluate(condition, self._at) else otherwise)


__all__ = ["ProgramRun"]
