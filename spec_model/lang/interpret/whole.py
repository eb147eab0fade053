"""A system run tick by tick: its components in order, frozen while not enabled (rules G1, G12)."""

from collections.abc import Mapping, Sequence

from rovercheck.spec_model.lang.action import Action, Assign, If
from rovercheck.spec_model.lang.chart import Block, Chart, Component, Enabled
from rovercheck.spec_model.lang.domain import Bool, Enum
from rovercheck.spec_model.lang.errors import ModelError, did_you_mean
from rovercheck.spec_model.lang.evaluate import evaluate
from rovercheck.spec_model.lang.expr import Var
from rovercheck.spec_model.lang.fired_transition import FiredTransition
from rovercheck.spec_model.lang.interpret.program import ProgramRun
from rovercheck.spec_model.lang.interpret.run import Admits, ChartRun, Testing, contains, store, within
from rovercheck.spec_model.lang.programmed import ProgrammedChart
from rovercheck.spec_model.lang.system import System
from rovercheck.spec_model.lang.wellformed import check_system


class Interpreter:
    """Runs a system from power-up.

    ``frozen`` gives raw values of frozen variables; those left out have their initial value.  With
    ``measured``, numbers may lie between the values of their domains: inputs are any numbers, and what is
    computed from them stays between the ends of its domain.  ``tested`` is told of every transition tested.
    Raises ``ModelError`` for an ill-formed system.
    """

    def __init__(
        self,
        system: System,
        frozen: Mapping[str, int] = {},
        *,
        measured: bool = False,
        tested: Testing | None = None,
    ) -> None:
        check_system(system)
        self.system = system
        self._admits: Admits = within if measured else contains
        self._inputs = system.inputs
        self._at: dict[str, int] = {n: v.init for n, v in system.written.items()}
        self._at |= {v.name: v.init for v in system.frozen} | _checked("frozen", system.frozen, frozen)
        self._fired: list[FiredTransition] = []
        self._places = {v.name for c in system.charts for v in (*c.locations, c.entered)}
        self._runs: dict[int, ChartRun | ProgramRun] = {
            id(c): ProgramRun(c, self._at, self._fired, self._admits)
            if isinstance(c, ProgrammedChart)
            else ChartRun(c, self._at, self._fired, system.step_ms, self._admits, tested, system.elapsed)
            for c in system.charts
        }

    @property
    def data(self) -> dict[str, int]:
        """The raw value of every datum: written, frozen, and inputs once there was a step."""
        return {name: raw for name, raw in self._at.items() if name not in self._places}

    def valuation(self) -> dict[str, int]:
        """The data, the location variables of every chart, and whether each chart was entered."""
        return dict(self._at)

    def step(self, inputs: Mapping[str, int]) -> tuple[FiredTransition, ...]:
        """One tick: all components in order.  Returns the transitions taken, in order.

        Raises ``ModelError`` for a missing or foreign input and for a value outside its domain.
        """
        missing = self._inputs.keys() - inputs.keys()
        if missing:
            raise ModelError(f"{self.system.name}: no value given for {', '.join(sorted(missing))}.")
        if self._admits is contains:
            inputs = _checked("input", tuple(self._inputs.values()), inputs)
        self._at |= inputs
        self._fired.clear()
        self._execute(self.system.components)
        return tuple(self._fired)

    def _execute(self, components: Sequence[Component]) -> None:
        for component in components:
            match component:
                case Chart():
                    self._runs[id(component)].step()
                case Block():
                    self._run_block(component.name, component.do)
                case Enabled():
                    if evaluate(component.by, self._at):
                        self._execute(component.components)

    def _run_block(self, name: str, actions: Sequence[Action]) -> None:
        for action in actions:
            match action:
                case Assign(data, value):
                    store(self._at, name, data, evaluate(value, self._at), self._admits)
                case If(condition, then, otherwise):
                    self._run_block(name, then if evaluate(condition, self._at) else otherwise)
                case _:
                    raise ModelError(f"{name}: a block has no states, so `{action}` has no receiver.")


def _checked(kind: str, known: Sequence[Var], given: Mapping[str, int]) -> dict[str, int]:
    by_name = {v.name: v for v in known}
    for name, raw in given.items():
        if name not in by_name:
            raise ModelError(f"{name!r} is no {kind} variable. {did_you_mean(name, by_name)}")
        if raw not in by_name[name].domain:
            sort = by_name[name].sort
            shown = str(raw) if isinstance(sort, Bool | Enum) else by_name[name].domain.show(raw)
            raise ModelError(f"{name} = {shown} is outside {by_name[name].domain}.")
    return dict(given)
