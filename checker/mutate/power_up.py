"""Other initial values of data that the default transition sets as well: both are one value of the code."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial

from rovercheck.checker.mutate.charts import TransitionList, transition_lists
from rovercheck.checker.mutate.wiring import renewed
from rovercheck.spec_model.lang.action import Action, Assign
from rovercheck.spec_model.lang.chart import Chart, Transition
from rovercheck.spec_model.lang.edit import in_system
from rovercheck.spec_model.lang.expr import Const, Var
from rovercheck.spec_model.lang.system import System

MOST_VALUES = 8
"""Values that a datum may have for all of them to be tried."""


@dataclass(frozen=True)
class OtherBeginning:
    """A datum that has another value at power-up, and after the default transition at ``site``."""

    site: str
    var: Var
    value: int
    make: Callable[[], System]


def other_beginnings(system: System, chart: Chart) -> Iterator[OtherBeginning]:
    """Of each datum that a default transition sets to its initial value, every other one."""
    for one in transition_lists(chart):
        for var in _set_again(one):
            values = var.domain.values if len(var.domain.values) <= MOST_VALUES else ()
            for value in values:
                if value != var.init:
                    made = partial(_begun, system, one, var, value)
                    yield OtherBeginning(f"{one.site} {var.name}", var, value, made)


def _set_again(one: TransitionList) -> list[Var]:
    """The data that default transitions set to their initial values."""
    actions = [a for s in one.segments for a in (*s.do, *s.then)] if one.default else []
    return list({var.name: var for a in actions if (var := _set_to_first(a)) is not None}.values())


def _set_to_first(action: Action) -> Var | None:
    """The datum that an action sets to its initial value."""
    match action:
        case Assign(var, Const(value)) if value == var.init:
            return var
    return None


def _begun(system: System, one: TransitionList, var: Var, value: int) -> System:
    def act(actions: Sequence[Action]) -> tuple[Action, ...]:
        return tuple(otherwise(a) for a in actions)

    def otherwise(action: Action) -> Action:
        found = _set_to_first(action)
        same = found is not None and found.name == var.name
        return Assign(var, Const(value, var.sort)) if same else action

    def segment(drawn: Transition) -> Transition:
        return replace(drawn, do=act(drawn.do), then=act(drawn.then))

    chart = one.changed([segment(s) for s in one.segments])
    return renewed(in_system(system, chart.name, lambda _: chart), replace(var, init=value))


__all__ = ["OtherBeginning", "other_beginnings"]
