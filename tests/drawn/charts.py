"""Small charts, written as packages, read again and run by the interpreter of drawn models."""

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Literal

from rovercheck.checker.drawn.interpret.diagram import ModelRunner
from rovercheck.checker.drawn.lower.diagram import lowered_model
from rovercheck.checker.drawn.lower.run import LoweredRun
from rovercheck.checker.simulink.model import read_model
from rovercheck.checker.simulink.writer.charts import WrittenChart
from rovercheck.checker.simulink.writer.packages import WrittenModel
from rovercheck.spec_model.lang.domain import chosen, fixed

Draw = Callable[[WrittenChart], object]
LOG = {"log": "double"}


def running(
    folder: Path,
    draw: Draw,
    ins: Mapping[str, str] | None = None,
    outs: Mapping[str, str] = LOG,
    step: str = "0.1",
    language: Literal["MATLAB", "C", "C with bit operations"] = "MATLAB",
    parallel: bool = False,
    saturates: bool = True,
    **more: object,
) -> ModelRunner:
    """One chart with these inputs and outputs, by their types."""
    model = WrittenModel("one", step=step)
    inputs = ins or {"u": "double"}
    ports = [
        model.root.inport(name, n, OutDataTypeStr=kind) for n, (name, kind) in enumerate(inputs.items(), 1)
    ]
    ends = [model.root.outport(name, n) for n, name in enumerate(outs, 1)]
    block, chart = model.root.chart("C")
    chart.language, chart.parallel, chart.saturates = language, parallel, saturates
    chart.more = more
    for name in inputs:
        chart.data(name, "input")
    for name, kind in outs.items():
        chart.data(name, "output", kind)
    draw(chart)
    for number, port in enumerate(ports, 1):
        model.root.line(port, f"{block}/{number}")
    for number, port in enumerate(ends, 1):
        model.root.line(f"{block}/{number}", port)
    return ModelRunner(read_model(model.save(folder / "one.slx")))


def logged(
    runner: ModelRunner, inputs: Sequence[float], name: str = "u", *, lowers: bool = True
) -> list[float]:
    """What ``log`` is after each step: each action puts its digit behind those before it.

    The lowered model gives the same, unless a test says that it ``lowers`` to nothing.
    """
    found = [runner.step({name: value})["log"] for value in inputs]
    if lowers:
        domains = {name: chosen(map(str, {*inputs})), "log": fixed(-10, 10**9, "0.5")}
        lowered = LoweredRun(lowered_model(runner.model, "one.slx", domains))
        assert [lowered.step({name: value})["log"] for value in inputs] == found
    return found


def note(digit: int) -> str:
    """An action that puts a digit behind those in ``log``."""
    return f"log = log * 10 + {digit};"
