"""Simulink functions of charts: blocks that a call executes, in both readings."""

from collections.abc import Callable, Mapping
from pathlib import Path

import pytest

from rovercheck.checker.drawn.faults import DrawnFault
from rovercheck.checker.drawn.interpret.diagram import ModelRunner
from rovercheck.checker.drawn.lower.diagram import lowered_model
from rovercheck.checker.drawn.lower.symbols import NotLowered
from rovercheck.checker.drawn.refused import notes_of
from rovercheck.checker.simulink.model import read_model
from rovercheck.checker.simulink.writer.charts import WrittenChart
from rovercheck.checker.simulink.writer.packages import WrittenModel
from rovercheck.checker.simulink.writer.systems import WrittenSystem
from tests.drawn.test_lowering import both
from tests.simulink.packages_by_hand import block, model, ports, run, signal

Draw = Callable[[WrittenSystem], object]


def with_functions(
    folder: Path, label: str, functions: Mapping[str, Draw], kind: str = "int8", **more: object
) -> ModelRunner:
    """A chart with the input ``u``, the output ``r`` and Simulink functions by their labels."""
    return ModelRunner(read_model(written(label, functions, kind, **more).save(folder / "one.slx")))


def written(label: str, functions: Mapping[str, Draw], kind: str = "int8", **more: object) -> WrittenModel:
    found = WrittenModel("one", step="0.1")
    block_, chart = found.root.chart("C")
    chart.more = more
    chart.data("u", "input", "int8")
    chart.data("r", "output", kind)
    chart.transition(None, chart.state(label))
    for name, draw in functions.items():
        draw(found.root.simulink_function(chart, name))
    found.root.line(found.root.inport("u", 1, OutDataTypeStr="int8"), block_)
    found.root.line(block_, found.root.outport("r", 1))
    return found


def difference(inside: WrittenSystem) -> None:
    """Two arguments in another order than in the label; one result is their difference."""
    subtract = inside.block("Sum", "subtract", {"in": 2, "out": 1}, {}, Inputs="+-")
    inside.line(inside.inport("b", 1), f"{subtract}/2")
    inside.line(inside.inport("a", 2), f"{subtract}/1")
    inside.line(subtract, inside.outport("d", 2))
    inside.line(inside.block("Constant", "one", {"out": 1}, {}, Value="int8(1)"), inside.outport("c", 1))


def counting(inside: WrittenSystem) -> None:
    """A delay keeps the sum of all arguments so far; it is given as it was before the call."""
    delay = inside.block("UnitDelay", "sum", {"in": 1, "out": 1}, {}, InitialCondition="int8(0)")
    add = inside.block("Sum", "add", {"in": 2, "out": 1}, {}, Inputs="++")
    inside.line(inside.inport("a", 1, OutDataTypeStr="int8"), f"{add}/1")
    inside.line(delay, f"{add}/2")
    inside.line(add, delay)
    inside.line(delay, inside.outport("y", 1))


def test_arguments_and_results_are_matched_by_their_names(tmp_path: Path) -> None:
    """A chart with such a function was refused."""
    label = "A\nen: r = int8(0);\ndu: [r, e] = f(u, int8(2)); r = 10 * r + e;"
    model_ = written(label, {"[d, c] = f(a, b)": difference})
    model_.charts[0].data("e", "local", "int8")
    runner = ModelRunner(read_model(model_.save(tmp_path / "one.slx")))
    assert both(runner, [5, 5, 1], "r") == [0, 31, -9]


def test_blocks_of_a_function_keep_what_they_remember_between_calls(tmp_path: Path) -> None:
    label = "A\nen: r = f(int8(1));\ndu: r = f(u) + f(int8(10));"
    runner = with_functions(tmp_path, label, {"y = f(a)": counting})
    # the sums before each call: 0; 1 and 1 + u; and so on
    assert both(runner, [0, 2, 3], "r") == [0, 1 + 3, 13 + 16]


def test_a_function_is_called_in_guards_and_in_matlab_functions(tmp_path: Path) -> None:
    def draw(chart: WrittenChart) -> None:
        chart.function("y = g(x)", script="function y = g(x)\ny = f(x) + f(x);\nend\n")

    found = WrittenModel("one", step="0.1")
    block_, chart = found.root.chart("C")
    chart.data("u", "input", "int8")
    chart.data("r", "output", "int8")
    draw(chart)
    one, other = chart.state("A\ndu: r = g(u);"), chart.state("B\nen: r = int8(-1);")
    chart.transition(None, one)
    chart.transition(one, other, "[f(int8(0)) > 3]")
    counting(found.root.simulink_function(chart, "y = f(a)"))
    found.root.line(found.root.inport("u", 1, OutDataTypeStr="int8"), block_)
    found.root.line(block_, found.root.outport("r", 1))
    runner = ModelRunner(read_model(found.save(tmp_path / "one.slx")))
    # sums before the calls: in the guard 0, then 0 and 1; 2, then 2 and 3; 4 is above 3
    assert both(runner, [1, 1, 1, 1], "r") == [0, 1, 5, -1]


def test_a_function_without_results_of_a_chart_of_c(tmp_path: Path) -> None:
    """A chart in a Simulink function has states of its own; whole numbers of C are doubles there."""

    def inside(system: WrittenSystem) -> None:
        block_, chart = system.chart("Inner")
        chart.data("a", "input", "double")
        chart.data("times", "output", "double")
        one = chart.state("One\nen: times = a;")
        other = chart.state("Two\nen: times = 10 * a;")
        chart.transition(None, one)
        chart.transition(one, other)
        chart.transition(other, one)
        system.line(system.inport("a", 1), block_)
        system.line(block_, system.outport("y", 1))

    model_ = written("A\ndu: r = f(3);", {"y = f(a)": inside}, "double")
    model_.charts[0].language = "C"
    runner = ModelRunner(read_model(model_.save(tmp_path / "one.slx")))
    assert both(runner, [0, 0, 0, 0], "r") == [0, 3, 30, 3]


def test_a_function_is_called_as_a_chart_is_initialized(tmp_path: Path) -> None:
    label = "A\nen: r = f(int8(5));\ndu: r = f(u);"
    runner = with_functions(tmp_path, label, {"y = f(a)": counting}, executeAtInitialization=1)
    assert both(runner, [1, 2, 3], "r") == [5, 6, 8]


def test_what_is_not_known_in_a_function_is_refused_with_its_place(tmp_path: Path) -> None:
    def inside(system: WrittenSystem) -> None:
        lookup = system.block("Lookup", "table", {"in": 1, "out": 1})
        system.line(system.inport("a", 1), lookup)
        system.line(lookup, system.outport("y", 1))

    read = read_model(written("A\ndu: r = f(u);", {"y = f(a)": inside}).save(tmp_path / "one.slx"))
    with pytest.raises(DrawnFault, match="C/f/table: Lookup is not known here"):
        ModelRunner(read)
    with pytest.raises(NotLowered, match="C/f/table: Lookup blocks are not known here"):
        lowered_model(read, "one.slx")


def test_a_link_in_a_function_is_told_when_the_model_is_read(tmp_path: Path) -> None:
    read = read_model(
        written("A", {"y = f(a)": lambda system: system.block("Reference", "link")}).save(
            tmp_path / "one.slx"
        )
    )
    assert [str(note).partition(".")[0] for note in notes_of(read)] == [
        "C/f/link, Reference block 3: it is a link to a library, which is in no file beside the model"
    ]


@pytest.mark.parametrize(
    ("label", "said"),
    [
        ("y = f(b)", r"C, the Simulink function f \(SSID 5\) has the Inports a, and its label says b"),
        ("f(a)", r"C, the Simulink function f \(SSID 5\) has the Outports y, and its label says none"),
    ],
)
def test_a_function_without_the_ports_of_its_label_is_refused(label: str, said: str, tmp_path: Path) -> None:
    read = read_model(written("A", {label: counting}).save(tmp_path / "one.slx"))
    with pytest.raises(DrawnFault, match=said):
        ModelRunner(read)
    with pytest.raises(NotLowered, match=said):
        lowered_model(read, "one.slx")


def test_a_function_whose_subsystem_is_not_there_is_refused(tmp_path: Path) -> None:
    model_ = written("A", {"y = f(a)": counting})
    model_.charts[0].functions.clear()
    with pytest.raises(DrawnFault, match=r"f \(SSID 5\) has no subsystem f in the block of its chart"):
        ModelRunner(read_model(model_.save(tmp_path / "one.slx")))


CHART = (
    '<Stateflow><machine id="1"><Children><chart id="2"><P Name="actionLanguage">2</P><Children>'
    '<state SSID="1"><P Name="labelString">A&#xA;en, du: y = f(a, b);</P><P Name="type">OR_STATE</P></state>'
    '<state SSID="3"><P Name="labelString">z = f(p, q)</P><P Name="type">FUNC_STATE</P>'
    '<simulink><P Name="isSimulinkFcn">1</P><P Name="blockName">my&#xA;f</P></simulink><Children>'
    + "".join(
        f'<data SSID="{ssid}" name="{name}"><P Name="scope">FUNCTION_{scope}_DATA</P>'
        '<P Name="dataType">Inherit: Same as Simulink</P></data>'
        for ssid, name, scope in ((4, "p", "INPUT"), (5, "q", "INPUT"), (6, "z", "OUTPUT"))
    )
    + '</Children></state><transition SSID="2"><dst><P Name="SSID">1</P></dst></transition>'
    '<data SSID="7" name="a"><P Name="scope">INPUT_DATA</P><P Name="dataType">int8</P></data>'
    '<data SSID="8" name="b"><P Name="scope">INPUT_DATA</P><P Name="dataType">int8</P></data>'
    '<data SSID="9" name="y"><P Name="scope">OUTPUT_DATA</P><P Name="dataType">int16</P></data>'
    "</Children></chart></Children></machine>"
    '<instance id="3"><P Name="name">C</P><P Name="chart">2</P></instance></Stateflow>'
)


def test_ports_are_arguments_since_r2014b(tmp_path: Path) -> None:
    """``ArgIn`` and ``ArgOut``, whose names are those of arguments; one that says no type is a double."""
    inside = (
        block("TriggerPort", "f", 20, "", TriggerType="function-call", IsSimulinkFunction="on")
        + block("ArgIn", "In1", 21, "", ArgumentName="p", OutDataTypeStr="int8")
        + block("ArgIn", "In2", 22, "", Port="2", ArgumentName="q")
        + block("ArgOut", "Out1", 23, "", ArgumentName="z") + block("Sum", "by", 24)
        + signal("21#out:1", "24#in:1") + signal("22#out:1", "24#in:2") + signal("24#out:1", "23#in:1")
    )  # fmt: skip
    function = block("SubSystem", "my&#xA;f", 19, f"<System>{inside}</System>")
    chart = block("SubSystem", "C", 5, f'<P Name="SFBlockType">Chart</P><System>{function}</System>')
    read = model(ports(5, "ab") + chart, tmp_path, "", CHART)
    assert run(read, [{"a": 7, "b": 2}, {"a": 100, "b": 100}]) == [(9,), (200,)]
