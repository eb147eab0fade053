"""Charts in few words, and the faults that the checks find in them."""

from collections.abc import Callable

from rovercheck.spec_model.lang.action import Action
from rovercheck.spec_model.lang.chart import Chart, State
from rovercheck.spec_model.lang.domain import integer
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.expr import flag, var
from rovercheck.spec_model.lang.system import in_order
from rovercheck.spec_model.lang.wellformed import check_chart, check_system

a, b = flag("a"), flag("b")
n = var("n", integer(0, 9))
kept = var("kept", integer(0, 9))


def faults(check: Callable[[], None]) -> list[str]:
    """The lines of the error; none when there is no fault."""
    try:
        check()
    except ModelError as error:
        return str(error).splitlines()
    return []


def of(*states: State, **how) -> list[str]:
    """The faults of a chart C whose first state is the default."""
    how.setdefault("default", states[0].name if states and not how.get("parallel") else None)
    return faults(lambda: check_chart(Chart("C", states, **how)))


def of_system(*components, **how) -> list[str]:
    return faults(lambda: check_system(in_order("S", *components, **how)))


def leaf(name: str, *transitions, **how) -> State:
    return State(name, transitions=transitions, **how)


def simple(name: str = "C", *actions: Action) -> Chart:
    return Chart(name, [State("A", during=actions)], default="A")
