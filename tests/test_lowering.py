"""Lowering against the reference interpreter: the same state after every tick."""

from collections.abc import Mapping, Sequence

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from rovercheck.spec_model.lang.action import assign, send
from rovercheck.spec_model.lang.chart import Chart, State, to
from rovercheck.spec_model.lang.domain import integer
from rovercheck.spec_model.lang.evaluate import step
from rovercheck.spec_model.lang.expr import flag, var
from rovercheck.spec_model.lang.interpret import Interpreter
from rovercheck.spec_model.lang.lower import lower
from rovercheck.spec_model.lang.system import System, in_order
from rovercheck.spec_model.lang.words import minimum
from tests.profiles import examples
from tests.strategies import frozen_values, input_blocks, systems


def compare(system: System, ticks: Sequence[Mapping[str, int]], frozen: Mapping[str, int] = {}) -> None:
    """Run both and compare all variables that both have."""
    interpreter, lowered = Interpreter(system, frozen), lower(system)
    shared = interpreter.valuation().keys() & {v.name for v in lowered.variables}
    assert shared >= system.written.keys()
    at = {**lowered.init, **frozen}
    for number, inputs in enumerate(ticks, start=1):
        fired = interpreter.step(inputs)
        at = step(lowered, at, inputs)
        expected = interpreter.valuation()
        assert {n: at[n] for n in shared} == {n: expected[n] for n in shared}, (number, fired)
        assert not any(at[check.name] for check, _ in lowered.checks)


@pytest.mark.long
@settings(examples(900), suppress_health_check=list(HealthCheck))
@given(st.data())
def test_lowered_systems_step_as_the_interpreter_does(data: st.DataObject) -> None:
    system = data.draw(systems())
    frozen = data.draw(frozen_values(system))
    compare(system, data.draw(input_blocks(system)), frozen)


go, seen = flag("go"), var("seen", integer(0, 9))
count = assign(seen, minimum(seen + 1, 9))
counting = State("R2", during=[count], default="P", states=[
    State("P", transitions=[to("Q", on="e")]), State("Q", transitions=[to("P", on="e")]),
])  # fmt: skip


def leaving(target: str) -> Chart:
    """A region whose transition leaves, and perhaps enters again, the parallel composite it is in."""
    one = State("R1", states=[State("X", transitions=[to(target, when=go)])], default="X")
    two = State("R2", during=[count])
    both = State("Both", states=[one, two], parallel=True, transitions=[to("Away", when=seen > 8)])
    return Chart("C", [both, State("Away")], default="Both")


def sending(**at: object) -> Chart:
    """A region that sends when it is entered or left, and one that may not be active then."""
    one = State("R1", **at)  # type: ignore[arg-type]
    both = State("Both", states=[one, counting], parallel=True, transitions=[to("Away", when=go)])
    return Chart("C", [both, State("Away", transitions=[to("Both", when=go)])], default="Both")


@pytest.mark.parametrize(
    "chart",
    [
        leaving("Away"),
        leaving("Both"),
        sending(entry=[send("e", "R2")]),
        sending(exit=[send("e", "R2")]),
        Chart("C", [State("R1", entry=[send("e", "R2")]), counting], parallel=True),
    ],
)
def test_regions_that_are_not_active_are_not_executed(chart: Chart) -> None:
    system = in_order("S", chart)
    moves = (0, 0, 1, 0, 1, 1, 0, 1, 0, 0)
    compare(system, [{name: raw for name in system.inputs} for raw in moves])
