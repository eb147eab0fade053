"""Regions of charts and subsystems that are not always active, in the system and in the interpreter."""

from functools import partial
from pathlib import Path

from rovercheck.checker.drawn.interpret.diagram import ModelRunner
from rovercheck.checker.drawn.lower.diagram import lowered_model
from rovercheck.checker.simulink.model import read_model
from rovercheck.checker.simulink.writer.charts import WrittenChart
from rovercheck.checker.simulink.writer.packages import WrittenModel
from rovercheck.spec_model.lang.domain import fixed
from rovercheck.spec_model.lang.programmed import ProgrammedChart
from tests.drawn.charts import running
from tests.drawn.test_lowering import both
from tests.drawn.two_readings import compared


def test_a_subsystem_that_was_not_executed_yet_gives_0_in_the_type_of_its_output(tmp_path: Path) -> None:
    """The interpreter gave a double, which a delay behind it took for its type."""
    model = WrittenModel("one", step="0.1")
    u = model.root.inport("u", 1, OutDataTypeStr="int8")
    block, inside = model.root.subsystem("Sub", 1, 1, "enable")
    inside.block("EnablePort", "Enable", {}, {})
    inside.line(inside.inport("i", 1), inside.outport("o", 1))
    total = model.root.block("Sum", "sum", {"in": 2, "out": 1}, Inputs="++")
    delay = model.root.block("UnitDelay", "d", {"in": 1, "out": 1}, InitialCondition="int8(1)")
    for source, target in (
        (u, f"{block}/1"), (u, f"{block}#enable"), (block, f"{total}/1"), (delay, f"{total}/2"),
        (total, delay), (total, model.root.outport("y", 1)),
    ):  # fmt: skip
        model.root.line(source, target)
    drawn, rows = read_model(model.save(tmp_path / "one.slx")), [{"u": 0}, {"u": 127}]
    runner = ModelRunner(drawn)
    assert [runner.step(row)["y"] for row in rows] == [1, -128]
    assert compared(drawn, rows).rows == 2


def test_a_subsystem_gives_the_first_value_of_an_output_that_its_chart_never_writes(tmp_path: Path) -> None:
    """It was held in a variable of the same name that began as 0, and the model was refused."""
    model = WrittenModel("one", step="0.1")
    u = model.root.inport("u", 1, OutDataTypeStr="double")
    block, inside = model.root.subsystem("Sub", 0, 1, "enable")
    inside.block("EnablePort", "Enable", {}, {})
    inner, chart = inside.chart("C")
    chart.data("y", "output", "double", 3)
    chart.transition(None, chart.state("A"))
    inside.line(inner, inside.outport("y", 1))
    model.root.line(u, f"{block}#enable")
    model.root.line(block, model.root.outport("y", 1))
    assert both(ModelRunner(read_model(model.save(tmp_path / "one.slx"))), [0, 1, 0], "y") == [3, 3, 3]


def test_a_region_that_is_entered_asks_for_one_that_is_not_yet(tmp_path: Path) -> None:
    """In a chart without events, all regions were active as soon as the first was entered."""

    def draw(chart: WrittenChart) -> None:
        chart.parallel = True
        chart.state("A\nen: if in(B), log = 1; else, log = 2; end\ndu: if in(B), log = 3; end", None, 1)
        chart.state("B", None, 2)

    assert both(running(tmp_path, draw), [1, 1], "log") == [2, 3]


def test_regions_have_a_variable_only_where_some_may_be_active_alone(tmp_path: Path) -> None:
    def draw(chart: WrittenChart, section: str) -> None:
        chart.event("E")
        whole = chart.state("P", parallel=True)
        chart.transition(None, whole)
        chart.state(f"A\n{section}: if u > 1, send(E, P.B); end", whole, 1)
        other = chart.state("B", whole, 2)
        first, second = chart.state("B1", other), chart.state("B2\nen: log = log + 1;", other)
        chart.transition(None, first)
        chart.transition(first, second, "E")
        chart.transition(second, first, "E", 2)

    for section, count in (("du", 0), ("en", 2)):
        model = running(tmp_path, partial(draw, section=section)).model
        domains = {"u": fixed(0, 9, 1), "log": fixed(0, 9, 1)}
        written = lowered_model(model, "one.slx", domains).system.written
        assert sum(name.endswith(".active") for name in written) == count
        assert compared(model, [{"u": n} for n in (2, 0, 3, 2)], domains=domains).rows == 4


def test_what_is_done_in_the_first_step_as_in_others_does_not_ask_which_one_it_is(tmp_path: Path) -> None:
    def draw(chart: WrittenChart) -> None:
        chart.parallel = True
        chart.state("A\nen, du: g = u;", None, 1)
        chart.state("B\nen: log = 5;\ndu: log = g;", None, 2)
        chart.state("C\nen, du: mode = g + 1;", None, 3)
        for name in ("g", "mode"):
            chart.data(name, "output", "double", 0)

    model = running(tmp_path, draw).model
    numbers = {name: fixed(0, 30, 1) for name in ("u", "log", "g", "mode")}
    [chart] = lowered_model(model, "one.slx", numbers).system.charts
    assert isinstance(chart, ProgrammedChart)
    first, choice, last = chart.program.unmarked
    assert [one.written for one in (first, last)] == [{"g"}, {"mode"}]
    assert choice.written == {"log", chart.entered.name}
    assert compared(model, [{"u": n} for n in (2, 0, 3)], domains=numbers).rows == 3
