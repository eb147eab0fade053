"""Events of a chart to other blocks, in both readings."""

from pathlib import Path

from rovercheck.checker.drawn.interpret.diagram import ModelRunner
from rovercheck.checker.simulink.model import read_model
from rovercheck.checker.simulink.writer.packages import WrittenModel
from tests.drawn.test_lowering import both
from tests.drawn.two_readings import compared


def sending(folder: Path, label: str, **more: object) -> ModelRunner:
    """A chart with an event OUT, whose signal triggers a chart in a subsystem and a chart by itself."""
    model = WrittenModel("one", step="0.1")
    port = model.root.inport("u", 1, OutDataTypeStr="int8")
    block, chart = model.root.chart("C")
    chart.more = more
    chart.data("u", "input", "int8")
    chart.event("OUT", "OUTPUT_EVENT", "EITHER_EDGE_EVENT")
    chart.data("n", "output", "uint8")
    chart.data("i", "local", "double")
    chart.transition(None, chart.state(label))
    sub, inside = model.root.subsystem("Sub", 0, 1, "trigger")
    inside.block("TriggerPort", "Trigger", {}, {}, TriggerType="either")
    counter, count = inside.chart("Count")
    count.data("times", "output", "uint8")
    count.transition(None, count.state("A\nen: times = uint8(1);\ndu: times = times + 1;"))
    inside.line(counter, inside.outport("times", 1))
    other, seen = model.root.chart("Seen")
    seen.data("rises", "output", "uint8")
    seen.event("UP", "INPUT_EVENT", "RISING_EDGE_EVENT")
    seen.transition(None, seen.state("B\nen: rises = uint8(1);\non UP: rises = rises + 1;"))
    model.root.line(port, block)
    for target in (f"{sub}#trigger", f"{other}#trigger"):
        model.root.line(f"{block}/2", target)
    ends = ((block, "n"), (f"{block}/2", "signal"), (sub, "times"), (other, "rises"))
    for number, (source, name) in enumerate(ends, 1):
        model.root.line(source, model.root.outport(f"{name}_out", number))
    return ModelRunner(read_model(model.save(folder / "one.slx")))


def test_an_event_to_other_blocks_changes_its_signal_and_triggers_them_after_the_chart(
    tmp_path: Path,
) -> None:
    """A chart with an output event was refused."""
    runner = sending(tmp_path, "A\ndu: if u == 1, OUT; end\nn = uint8(u);")
    steps: list[float] = [0, 1, 0, 1, 1, 0]
    assert both(runner, steps, "signal_out") == [0, 1, 1, 0, 1, 1]
    assert both(runner, steps, "times_out") == [0, 1, 1, 2, 3, 3]
    assert both(runner, steps, "rises_out") == [0, 1, 1, 1, 2, 2]
    assert both(runner, steps, "n_out") == [0, 1, 0, 1, 1, 0]


def test_an_event_that_is_sent_several_times_in_a_step_waits_for_further_steps(tmp_path: Path) -> None:
    runner = sending(tmp_path, "A\ndu: if u == 1, send(OUT); OUT; OUT; end")
    assert both(runner, [0, 1, 0, 0, 0], "signal_out") == [0, 1, 0, 1, 1]


def test_an_event_sent_at_initialization_occurs_in_the_first_step(tmp_path: Path) -> None:
    runner = sending(tmp_path, "A\nen: OUT;", executeAtInitialization=1)
    assert both(runner, [0, 0], "signal_out") == [1, 1]


def test_an_event_of_which_too_many_wait_is_a_step_without_a_meaning(tmp_path: Path) -> None:
    runner = sending(tmp_path, "A\ndu: if u == 1, for i = 1:100, OUT; end, end")
    found = compared(runner.model, [{"u": 1.0}] * 4)
    assert (found.rows, found.refused, found.fault) == (
        3,
        "",
        "C: OUT is sent while 255 of it wait: each step gives one",
    )
