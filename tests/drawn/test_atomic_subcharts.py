"""Atomic subcharts are executed as the states that they are, in both readings."""

from collections.abc import Callable
from pathlib import Path

import pytest

from rovercheck.checker.drawn.interpret.diagram import ModelRunner
from rovercheck.checker.drawn.refused import notes_of
from rovercheck.checker.simulink.model import read_model
from rovercheck.checker.simulink.writer.charts import WrittenChart
from rovercheck.checker.simulink.writer.packages import WrittenModel
from tests.drawn.test_lowering import both

Draw = Callable[[WrittenChart, WrittenChart], object]


def with_part(folder: Path, draw: Draw, label: str = "Part", binding: str = "") -> WrittenModel:
    """A chart C with an atomic subchart; ``draw`` draws what is around it and what is in it."""
    model = WrittenModel("one", step="0.1")
    block, chart = model.root.chart("C")
    chart.data("u", "input", "int8")
    chart.data("r", "output", "int16")
    state, part = model.root.atomic_subchart(chart, label, binding=binding)
    off = chart.state("Off\nen: r = int16(-1);")
    chart.transition(None, off)
    chart.transition(off, state, "[u > 0]")
    chart.transition(state, off, "[u == 0]")
    draw(chart, part)
    model.root.line(model.root.inport("u", 1, OutDataTypeStr="int8"), block)
    model.root.line(block, model.root.outport("r", 1))
    model.save(folder / "one.slx")
    return model


def counting(_: WrittenChart, part: WrittenChart) -> None:
    """It counts with a datum of its own, which stays as it is while it is not active."""
    for name, scope in (("u", "input"), ("r", "output")):
        part.data(name, scope, "int8" if name == "u" else "int16")
    part.data("n", "local", "int16", 5)
    one = part.state("One\nen: n = n + 1; r = n;\ndu: r = r + 10;\nex: n = n + 100;")
    two = part.state("Two\nen: r = int16(7) * int16(u);")
    part.transition(None, one)
    part.transition(one, two, "after(2, tick)")


def test_an_atomic_subchart_is_entered_executed_and_left_as_a_state(tmp_path: Path) -> None:
    """It was refused."""
    with_part(tmp_path, counting)
    read = read_model(tmp_path / "one.slx")
    assert ([one.path for one in read.charts], list(notes_of(read))) == (["C"], [])
    # entered, during, its transition; left and entered again with n as it was
    steps: list[float] = [0, 1, 1, 2, 2, 0, 1, 0]
    assert both(ModelRunner(read), steps, "r") == [-1, 6, 16, 14, 14, -1, 107, -1]


def test_data_of_an_atomic_subchart_stand_for_what_they_are_mapped_to(tmp_path: Path) -> None:
    """To another name, an element of a vector or a value."""

    def draw(chart: WrittenChart, part: WrittenChart) -> None:
        chart.data("v", "local", "int16", "[3 4]", size="2")
        for name, scope in (("in", "input"), ("out", "output"), ("v2", "output"), ("K", "parameter")):
            part.data(name, scope, "int16" if scope == "output" else "int8")
        f = part.function("y = f(x)", script="function y = f(x)\ny = int16(x) + int16(K);\nend\n")
        assert f.ssid == 5
        part.transition(None, part.state("S\nen, du: v2 = v2 + int16(in); out = f(in) + v2;"))

    with_part(tmp_path, draw, binding="1 u\n2 r\n3 v(2)\n4 20")
    runner = ModelRunner(read_model(tmp_path / "one.slx"))
    assert both(runner, [1, 1, 2, 3], "r") == [-1, 26, 29, 33]


def test_regions_functions_and_subcharts_in_an_atomic_subchart(tmp_path: Path) -> None:
    def draw(chart: WrittenChart, part: WrittenChart) -> None:
        part.parallel = True
        part.data("u", "input", "int8")
        part.data("r", "output", "int16")
        one, two = part.state("One\ndu: r = r * 2;", order=1), part.state("Two", order=2)
        a, b = part.state("A\nen: r = int16(u);", two), part.state("B\ndu: r = r + 1;", two, subchart=True)
        part.transition(None, a)
        part.transition(a, b, "[in(One)]")
        assert one.order == 1

    with_part(tmp_path, draw)
    runner = ModelRunner(read_model(tmp_path / "one.slx"))
    assert both(runner, [0, 3, 3, 3, 3], "r") == [-1, 3, 6, 13, 27]


def test_elements_of_an_atomic_subchart_have_numbers_above_those_around_it(tmp_path: Path) -> None:
    with_part(tmp_path, counting)
    [chart] = read_model(tmp_path / "one.slx").charts
    numbers = {one.name: one.ssid for one in chart.content.every_state()}
    assert numbers == {"Part": 3, "One": 1004, "Two": 1005, "Off": 4}


# --- what is refused ---------------------------------------------------------------------------------------


def events(_: WrittenChart, part: WrittenChart) -> None:
    part.event("E")
    part.transition(None, part.state("S"))


def flow(_: WrittenChart, part: WrittenChart) -> None:
    part.transition(None, part.junction(), "{}")


def language(_: WrittenChart, part: WrittenChart) -> None:
    part.language = "C"
    part.transition(None, part.state("S"))


def changes(_: WrittenChart, part: WrittenChart) -> None:
    part.data("u", "input", "int8")
    part.transition(None, part.state("S\ndu: if hasChanged(u), end"))


def hidden(_: WrittenChart, part: WrittenChart) -> None:
    part.data("x", "input", "int8")
    state = part.state("S\nen: u = x;")
    part.data("u", "local", "int8", holder=state)
    part.transition(None, state)


@pytest.mark.parametrize(
    ("draw", "said"),
    [
        (events, "it has events of its own, which only it answers. Make it a plain subchart"),
        (flow, "it has no states, and runs its flow chart in every step. Draw that in a during action"),
        (language, "it has another language or other integers than the chart around it. Give both the same"),
        (changes, "it asks whether data have changed since it was executed last. Make it a plain subchart"),
        (hidden, "x stands for u, and u is also a datum of its own. Rename that"),
    ],
)
def test_an_atomic_subchart_that_is_no_plain_one_is_refused(draw: Draw, said: str, tmp_path: Path) -> None:
    with_part(tmp_path, draw, binding="1 u")
    told = [str(note) for note in notes_of(read_model(tmp_path / "one.slx"))]
    assert told == [f"C, the state Part (SSID 3): it is an atomic subchart: {said}."]


def test_an_atomic_subchart_of_a_library_is_refused(tmp_path: Path) -> None:
    def draw(chart: WrittenChart, _: WrittenChart) -> None:
        chart.state("Other", inside={"simulink": {"isComponent": 1, "blockName": "Other"}})

    with_part(tmp_path, draw)
    [note] = [str(one) for one in notes_of(read_model(tmp_path / "one.slx")) if "Other" in str(one)]
    assert note.endswith("or is not in the file. Break the link, and save the model again.")
