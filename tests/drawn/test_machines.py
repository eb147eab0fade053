"""Moore and Mealy charts with what such a chart has not, or with what it does is not certain, are refused."""

from collections.abc import Callable
from itertools import pairwise
from pathlib import Path

import pytest

from rovercheck.checker.drawn.faults import DrawnFault
from rovercheck.checker.drawn.parsed import parsed_chart
from rovercheck.checker.simulink.model import read_model
from rovercheck.checker.simulink.writer.charts import WrittenChart
from rovercheck.checker.simulink.writer.packages import WrittenModel
from tests.drawn.charts import running

Draw = Callable[[WrittenChart], object]
MOORE = {"stateMachineType": "MOORE_MACHINE", "executeAtInitialization": 1}
MEALY = {"stateMachineType": "MEALY_MACHINE"}


def notes(folder: Path, draw: Draw, **more: object) -> list[str]:
    """What is said of a chart with an input u and the outputs y and z."""
    model = WrittenModel("one")
    _, chart = model.root.chart("C")
    chart.more = more
    for name, scope in {"u": "input", "y": "output", "z": "output"}.items():
        chart.data(name, scope, "int8")
    draw(chart)
    [read] = read_model(model.save(folder / "one.slx")).charts
    return [str(one) for one in parsed_chart(read).notes]


def states(*labels: str, transition: str = "") -> Draw:
    """States of these labels, one after the other."""

    def draw(chart: WrittenChart) -> None:
        made = [chart.state(label) for label in labels]
        chart.transition(None, made[0])
        for one, other in pairwise(made):
            chart.transition(one, other, transition)

    return draw


BOTH = "A\ny = int8(1); z = int8(2);"


@pytest.mark.parametrize(
    ("draw", "said"),
    [
        (states("A\nen: y = int8(1); z = int8(1);"), "have no keyword, as entry. Write them without."),
        (states("A\ny = u; z = int8(1);"), "it reads the input u. Its transitions may."),
        (states(BOTH, BOTH, transition="{y = int8(1);}"), "a transition of a Moore chart has no actions."),
        (states(BOTH, BOTH, transition="/y = int8(1);"), "a transition of a Moore chart has no actions."),
        (states(BOTH, "B\ny = int8(3);"), "not every state writes the output z"),
        (states("A\nif true, y = int8(1); end\nz = int8(1);"), "not every state writes the output y"),
        (states("A\ny = int8(temporalCount(tick)); z = int8(1);"), "it asks for temporalCount, in an action"),
        (lambda chart: (states(BOTH)(chart), chart.event("E")), "a Moore chart has no events here."),
        (
            lambda chart: (states(BOTH)(chart), chart.function("f", script="function f\nend\n")),
            "a Moore chart has no functions.",
        ),
    ],
)  # fmt: skip
def test_what_a_moore_chart_has_not_is_refused(draw: Draw, said: str, tmp_path: Path) -> None:
    assert notes(tmp_path, states(BOTH, BOTH), **MOORE) == []
    found = notes(tmp_path, draw, **MOORE)
    assert any(said in one for one in found), found


def test_states_that_are_active_together_have_data_of_their_own(tmp_path: Path) -> None:
    """Which of them Stateflow executes first would show."""

    def nested(chart: WrittenChart) -> None:
        outer = chart.state(BOTH)
        chart.transition(None, outer)
        chart.transition(None, chart.state("B\ny = int8(3);", outer))

    def beside(chart: WrittenChart) -> None:
        chart.parallel = True
        chart.state(BOTH, order=1)
        chart.state("B\nz = int8(3);", order=2)

    assert ["it and C/A/B use y, which one of them writes" in one for one in notes(tmp_path, nested, **MOORE)]
    [one] = notes(tmp_path, beside, **MOORE)
    assert "it and C/B use z, which one of them writes, and both may be active." in one


def test_outputs_that_begin_anew_need_not_be_written_in_each_state(tmp_path: Path) -> None:
    assert notes(tmp_path, states(BOTH, "B\ny = int8(3);"), **MOORE, initializeOutput=1) == []


def test_a_moore_chart_that_is_entered_in_its_first_step_is_refused(tmp_path: Path) -> None:
    [one] = notes(tmp_path, states(BOTH), stateMachineType="MOORE_MACHINE")
    assert one.endswith("Let it be entered at initialization.")
    with pytest.raises(DrawnFault, match="whether it gives the outputs of its first state then is not known"):
        running(tmp_path, states("A\nlog = 1;"), stateMachineType="MOORE_MACHINE")


@pytest.mark.parametrize(
    ("draw", "said"),
    [
        (states("A\nen: y = int8(1);"), "a state of a Mealy chart has no actions. Act on its transitions."),
        (states("A", "B", transition="[u > 1]/y = int8(1);"), "alone. Write it as one."),
    ],
)
def test_what_a_mealy_chart_has_not_is_refused(draw: Draw, said: str, tmp_path: Path) -> None:
    assert notes(tmp_path, states("A", "B", transition="[u > 1]{y = int8(1);}"), **MEALY) == []
    [one] = notes(tmp_path, draw, **MEALY)
    assert one.endswith(said)
