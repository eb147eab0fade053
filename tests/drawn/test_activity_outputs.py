"""Outputs that hold which state of a chart is active, in both readings."""

from pathlib import Path

import pytest

from rovercheck.checker.drawn.faults import DrawnFault
from rovercheck.checker.drawn.interpret.diagram import ModelRunner
from rovercheck.checker.simulink.model import read_model
from rovercheck.checker.simulink.writer.packages import WrittenModel
from tests.drawn.test_lowering import both


def telling(folder: Path, mode: str = "", of_state: bool = False, parallel: bool = False) -> ModelRunner:
    """States Run (Fast, Slow) and Halt, and an output that tells of the chart or of Run."""
    model = WrittenModel("one", step="0.1")
    port, end = model.root.inport("u", 1, OutDataTypeStr="int8"), model.root.outport("y", 1)
    block, chart = model.root.chart("C")
    chart.data("u", "input", "int8")
    told = {"useCustomName": 1, "customName": "mode", "enumTypeName": "Modes", "activityMode": mode or None}
    inside = {"activeStateOutput": told}
    chart.inside = {} if of_state else inside
    run = chart.state("Run", parallel=parallel, inside=inside if of_state else None)
    halt = chart.state("Halt")
    slow, fast = (
        chart.state(name, run, order if parallel else 0) for order, name in enumerate(("Slow", "Fast"), 1)
    )
    kind = "boolean" if mode == "SELF_ACTIVITY" else "Enum: Modes"
    chart.data("mode", "output", kind, more={"outputState": run.ssid} if of_state else None)
    chart.transition(None, run)
    chart.transition(run, halt, "[u == 2]")
    chart.transition(halt, run, "[u == 0]")
    if not parallel:
        chart.transition(None, slow, "", 1, run)
        chart.transition(slow, fast, "[u == 1]")
    model.root.line(port, block)
    model.root.line(block, end)
    return ModelRunner(read_model(model.save(folder / "one.slx")))


@pytest.mark.parametrize(
    ("mode", "of_state", "expected"),
    [
        ("", False, [2, 2, 1, 2]), ("LEAF_STATE_ACTIVITY", False, [3, 1, 2, 3]),
        ("", True, [2, 1, 0, 2]), ("SELF_ACTIVITY", True, [1, 1, 0, 1]),
    ],
)  # fmt: skip
def test_an_output_tells_which_state_is_active(
    tmp_path: Path, mode: str, of_state: bool, expected: list[float]
) -> None:
    """An output of the active child was refused; that of a state told whether it is active, and no more."""
    assert both(telling(tmp_path, mode, of_state), [0, 1, 2, 0], "y") == expected


def test_the_enumeration_of_an_output_has_the_names_of_states(tmp_path: Path) -> None:
    [made] = telling(tmp_path, "LEAF_STATE_ACTIVITY").model.enumerations
    assert (made.name, made.default) == ("Modes", "None")
    assert dict(made.members) == {"None": 0, "Fast": 1, "Halt": 2, "Slow": 3}


def test_an_output_that_tells_of_regions_is_refused(tmp_path: Path) -> None:
    with pytest.raises(DrawnFault, match=r"mode.* it tells of regions, of which several are active"):
        telling(tmp_path, of_state=True, parallel=True)


def test_an_output_may_tell_of_the_children_of_a_region(tmp_path: Path) -> None:
    model = WrittenModel("one", step="0.1")
    port, end = model.root.inport("u", 1, OutDataTypeStr="int8"), model.root.outport("y", 1)
    block, chart = model.root.chart("C")
    chart.parallel = True
    chart.data("u", "input", "int8")
    inside = {"activeStateOutput": {"useCustomName": 1, "customName": "mode", "enumTypeName": "Modes"}}
    region = chart.state("R", order=1, inside=inside)
    chart.state("Other", order=2)
    a, b = chart.state("A", region), chart.state("B", region)
    chart.data("mode", "output", "Enum: Modes", more={"outputState": region.ssid})
    chart.transition(None, a, "", 1, region)
    chart.transition(a, b, "[u == 1]")
    model.root.line(port, block)
    model.root.line(block, end)
    runner = ModelRunner(read_model(model.save(tmp_path / "one.slx")))
    assert both(runner, [0, 1, 0], "y") == [1, 2, 2]
