"""Data stores whose order, type or place is not drawn are refused in both readings, with a way around."""

from collections.abc import Callable
from pathlib import Path

import pytest

from rovercheck.checker.drawn.faults import DrawnFault
from rovercheck.checker.drawn.interpret.diagram import ModelRunner
from rovercheck.checker.drawn.lower.diagram import lowered_model
from rovercheck.checker.drawn.lower.symbols import NotLowered
from rovercheck.checker.drawn.records import DrawnModel
from rovercheck.checker.simulink.model import read_model
from rovercheck.checker.simulink.writer.charts import WrittenChart, WrittenState
from rovercheck.checker.simulink.writer.packages import WrittenModel
from rovercheck.checker.simulink.writer.systems import WrittenSystem
from tests.drawn.two_readings import compared

Draw = Callable[[WrittenSystem], object]
ONE = {"out": 1}


def memory(root: WrittenSystem, **values: object) -> str:
    return root.block("DataStoreMemory", "Memory", {}, {}, DataStoreName="A", **values)


def written(root: WrittenSystem, name: str = "W", value: str = "int8(3)", **values: object) -> None:
    constant = root.block("Constant", f"{name} value", ONE, {}, Value=value)
    root.line(constant, root.block("DataStoreWrite", name, {"in": 1}, {}, DataStoreName="A", **values))


def read(root: WrittenSystem, name: str = "R", **values: object) -> str:
    return root.block("DataStoreRead", name, ONE, {}, DataStoreName="A", **values)


def chart(
    root: WrittenSystem, kind: str = "Inherit: Same as Simulink"
) -> tuple[WrittenChart, WrittenState]:  # fmt: skip
    """A chart with a datum A that is a data store, and its state."""
    made = root.chart("C")[1]
    made.data("A", "data store", kind)
    state = made.state("S\ndu: A = A + 1;")
    made.transition(None, state)
    return made, state


def drawn(draw: Draw, folder: Path) -> DrawnModel:
    model = WrittenModel("one", step="0.1")
    draw(model.root)
    return read_model(model.save(folder / "one.slx"))


def no_order(root: WrittenSystem) -> None:
    memory(root)
    written(root, value="3")
    root.line(read(root), root.outport("y", 1))


def two_groups(root: WrittenSystem) -> None:
    memory(root)
    written(root.subsystem("G", 0, 0)[1], value="3", Priority="1")
    root.line(read(root, Priority="2"), root.outport("y", 1))


def one_priority(root: WrittenSystem) -> None:
    memory(root)
    written(root, value="3", Priority="1")
    chart(root)


def other_type(root: WrittenSystem) -> None:
    memory(root)
    written(root)


def two_types(root: WrittenSystem) -> None:
    memory(root, OutDataTypeStr="int16")
    chart(root, "int8")


def no_type(root: WrittenSystem) -> None:
    memory(root, InitialValue="int8(1)")
    chart(root)


def no_memory(root: WrittenSystem) -> None:
    memory(root.subsystem("Below", 0, 0)[1])
    written(root)


def two_memories(root: WrittenSystem) -> None:
    memory(root)
    root.block("DataStoreMemory", "Again", {}, {}, DataStoreName="A")


def an_element(root: WrittenSystem) -> None:
    memory(root)
    read(root, DataStoreElements="A(1)")


def undeclared(root: WrittenSystem) -> None:
    memory(root)
    function = root.chart("F", "MATLAB Function", "function f\nA = A + 1;\nend\n")[1]
    function.data("A", "data store", "double")


def global_alone(root: WrittenSystem) -> None:
    root.chart("F", "MATLAB Function", "function f\nglobal A\nA = 1;\nend\n")


def at_first(root: WrittenSystem) -> None:
    memory(root)
    chart(root)[0].more = {"executeAtInitialization": 1}


def of_a_state(root: WrittenSystem) -> None:
    memory(root)
    made = root.chart("C")[1]
    made.data("A", "data store", "double", holder=made.state("S"))


@pytest.mark.parametrize(
    ("draw", "said"),
    [
        (no_order, "R and W use the data store Memory, and nothing says which of them is executed first: c"),
        (two_groups, "R and G/W use the data store Memory, and nothing says which of them is executed first"),
        (one_priority, "use the data store Memory, and nothing says which of them is executed first"),
        (other_type, "the data store Memory is of double, and its value of int8: give both one type"),
        (two_types, "Memory: it is of int16 and of int8: give it one type"),
        (no_type, "Memory: its type follows from nothing: give it one, as int32"),
        (no_memory, "W: no Data Store Memory block A is drawn around it, and a signal of the workspace is"),
        (two_memories, "two Data Store Memory blocks beside each other are called A: rename one"),
        (an_element, "it reads or writes some elements of a data store. Read it whole, and use a selector"),
        (
            at_first,
            "C: it is entered before the first step, and uses the data store A: enter it in the first",
        ),
        (undeclared, "F: f uses the data store A, and does not say so: write `global A` in its first line"),
        (global_alone, "`global` A: it is no data store of the function: pass the value"),
        (of_a_state, "it is a data store of a state. Make it one of the chart"),
    ],
)
def test_what_does_not_follow_from_the_drawing_is_refused(draw: Draw, said: str, tmp_path: Path) -> None:
    model = drawn(draw, tmp_path)
    with pytest.raises(NotLowered) as lowered:
        lowered_model(model, "one.slx")
    with pytest.raises(DrawnFault) as direct:
        ModelRunner(model).step({})
    assert said in str(lowered.value) and said in str(direct.value)


@pytest.mark.parametrize("word", ["hasChanged(A)", "rising(A)"])
def test_changes_of_a_data_store_are_refused(word: str, tmp_path: Path) -> None:
    """Others write it within a step: what it was at the start of the step is not that of the chart's turn."""

    def draw(root: WrittenSystem) -> None:
        memory(root)
        made, state = chart(root)
        made.transition(state, made.state("B"), f"[{word}]")

    model = drawn(draw, tmp_path)
    said = "changes of a data store, which others write within a step, are not seen here"
    with pytest.raises(NotLowered, match=said):
        lowered_model(model, "one.slx")
    runner = ModelRunner(model)
    runner.step({})
    with pytest.raises(DrawnFault, match=said):
        runner.step({})


def test_readers_alone_need_no_order(tmp_path: Path) -> None:
    """Only where one of two writes does it show which of them is executed first."""

    def draw(root: WrittenSystem) -> None:
        memory(root, InitialValue="[1 2 3]", OutDataTypeStr="uint8")
        for name in ("y", "z"):
            root.line(read(root, f"R{name}"), root.outport(name, 1 + (name == "z")))

    model = drawn(draw, tmp_path)
    assert compared(model, [{}] * 2).rows == 2
    assert ModelRunner(model).step({}) == {f"{name}({n})": n for name in "yz" for n in (1, 2, 3)}


def test_a_matlab_function_uses_a_data_store_as_a_chart_does(tmp_path: Path) -> None:
    """An element of it is written; the memory has the value of its first element in all of them at first."""

    def draw(root: WrittenSystem) -> None:
        memory(root, InitialValue="4", Dimensions="[1 2]", OutDataTypeStr="int16")
        script = "function y = f(u)\nglobal A\nA(2) = A(1) + A(2) + u;\ny = A(2);\nend\n"
        block, function = root.chart("F", "MATLAB Function", script)
        function.data("u", "input", "int16")
        function.data("y", "output", "int16")
        function.data("A", "data store", "Inherit: Same as Simulink")
        root.line(root.inport("u", 1, OutDataTypeStr="int16"), block)
        root.line(block, root.outport("y", 1))

    model, rows = drawn(draw, tmp_path), [{"u": value} for value in (1, 0, -20)]
    assert compared(model, rows).rows == len(rows)
    runner = ModelRunner(model)
    assert [runner.step(row)["y"] for row in rows] == [9, 13, -3]
