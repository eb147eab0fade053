"""What stands in a package of Simulink is read as it stands there, in all layouts of all releases."""

import re
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest

from rovercheck.checker.drawn.records import DrawnChart, DrawnModel, DrawnState
from rovercheck.checker.simulink.model import read_model
from rovercheck.checker.simulink.writer.charts import WrittenChart
from rovercheck.checker.simulink.writer.packages import DIAGRAM, Layout, WrittenModel
from rovercheck.spec_model.lang.errors import ModelError
from tests.simulink.outline import chart_lines, outline
from tests.simulink.samples import SAMPLES, package_of, write_beside

OUTLINES = Path(__file__).parent / "outlines"
LAYOUTS: tuple[Layout, ...] = ("parts", "single", "inline")


def one_chart(draw: Callable[[WrittenChart], object], folder: Path, layout: Layout = "parts") -> DrawnChart:
    """The chart of a model with one, as it is read."""
    model = WrittenModel("one", layout=layout)
    draw(model.root.chart("Chart")[1])
    (chart,) = read_model(model.save(folder / "one.slx")).charts
    return chart


def states(chart: DrawnChart) -> dict[str, DrawnState]:
    return {state.name: state for state in chart.content.every_state()}


# --- the examples ------------------------------------------------------------------------------------------


@pytest.mark.parametrize("sample", SAMPLES)
def test_everything_in_an_example_is_read_as_it_is_drawn(sample: str) -> None:
    model = read_model(package_of(sample))
    assert outline(model) == (OUTLINES / f"{sample}.txt").read_text(encoding="utf-8")
    assert [Path(file).suffix for file in model.files[:2]] == [".slx", ".sldd"][: len(model.files)]


@pytest.mark.parametrize("sample", SAMPLES)
def test_an_example_that_is_made_anew_is_the_same_to_the_last_line(sample: str, tmp_path: Path) -> None:
    write_beside(sample, tmp_path)
    own = SAMPLES[sample]().save(tmp_path / f"{sample.partition('_')[2]}.slx")
    assert replace(read_model(own), files=()) == replace(read_model(package_of(sample)), files=())


@pytest.mark.parametrize("layout", LAYOUTS)
@pytest.mark.parametrize("sample", SAMPLES)
def test_a_model_is_the_same_in_every_layout(sample: str, layout: Layout, tmp_path: Path) -> None:
    write_beside(sample, tmp_path)
    model = SAMPLES[sample]()
    model.layout = layout
    found = read_model(model.save(tmp_path / f"{model.name}.slx"))
    listed = r" Ports=\[[\d, ]*\],?"
    assert told_without(listed, found) == told_without(listed, read_model(package_of(sample)))
    part = {"parts": "simulink/stateflow/chart_", "single": "simulink/stateflow.xml", "inline": DIAGRAM}
    assert all(chart.part.startswith(part[layout]) for chart in found.charts)


def told_without(pattern: str, model: DrawnModel) -> list[str]:
    """The outline, in which a list of ports in older layouts is not told; the counts are."""
    lines = re.sub(pattern, "", outline(model)).splitlines()
    return [", ".join(sorted(line.split(", "))) if "block" in line else line for line in lines]


# --- transitions -------------------------------------------------------------------------------------------


def test_of_a_wire_across_borders_only_the_whole_is_read(tmp_path: Path) -> None:
    def draw(chart: WrittenChart) -> None:
        outer, other = chart.state("Outer", subchart=True), chart.state("Other")
        inner = chart.state("Inner", outer)
        chart.crossing(other, inner, "[x]", 3, outer)

    (wire,) = one_chart(draw, tmp_path).content.transitions
    assert (wire.source, wire.target, wire.order, wire.label, wire.inner) == (2, 3, 3, "[x]", False)


def test_a_transition_is_inner_where_it_is_nested_in_the_state_that_it_leaves(tmp_path: Path) -> None:
    def draw(chart: WrittenChart) -> None:
        state = chart.state("Outer")
        child = chart.state("Child", state)
        chart.transition(state, state, "outer loop")
        chart.transition(state, state, "inner loop", inner=True)
        chart.transition(state, child, "to the child from outside")
        chart.transition(state, child, "to the child from inside", inner=True)
        chart.transition(child, state, "to the parent")
        chart.transition(child, state, "to the parent inside", holder=state)

    chart = one_chart(draw, tmp_path)
    found = {t.label: t.inner for level in chart.content.every_level() for t in level.transitions}
    assert {label for label, inner in found.items() if inner} == {"inner loop", "to the child from inside"}
    assert len(found) == 6


def test_an_order_that_is_none_is_zero_and_an_end_that_is_not_there_is_none(tmp_path: Path) -> None:
    def draw(chart: WrittenChart) -> None:
        state = chart.state("S")
        chart.transition(state, None, "dangles", 4294967295)

    (dangling,) = one_chart(draw, tmp_path).content.transitions
    assert (dangling.source, dangling.target, dangling.order) == (1, None, 0)


# --- what is commented out ---------------------------------------------------------------------------------


def commented(chart: WrittenChart) -> None:
    """A state with a child, a transition and a function that are commented out, each in its way."""
    explicit, implicit = {"isExplicitlyCommented": 1}, {"isImplicitlyCommented": 1}
    one, other = chart.state("One"), chart.state("Other")
    out = chart.state("Out", more=explicit)
    inner = chart.state("Inner", out)
    chart.transition(None, one)
    chart.transition(None, inner, holder=out)
    chart.transition(one, out, "[a]", 1)
    chart.transition(inner, one, "[b]", 1)
    chart.transition(one, other, "[c]", 2, more=explicit)
    chart.transition(one, other, "[d]", 3)
    chart.transition(other, one, "[e]", 1, more=implicit)
    chart.function("f", inside={"commentInfo": explicit})


def test_what_is_commented_out_is_as_if_it_were_not_drawn(tmp_path: Path) -> None:
    """States and transitions that are commented out were executed."""
    chart = one_chart(commented, tmp_path)
    assert [one.name for one in chart.content.every_state()] == ["One", "Other"]
    assert [one.label for one in chart.content.transitions] == ["", "[d]"]


# --- states, functions and data ----------------------------------------------------------------------------


def test_functions_boxes_notes_and_atomic_subcharts_are_told_apart(tmp_path: Path) -> None:
    def draw(chart: WrittenChart) -> None:
        chart.state("A/b: no section")
        chart.state("Box", box=True)
        chart.state("A note: <b>x</b>", more={"isNoteBox": 1})
        chart.function("y = \n... f(a)")
        chart.function("m", script="function m\nend")
        chart.function("t", inside={"truthTable": {"isTruthTable": 1}})
        chart.function("t2", script="function t2\nend", inside={"truthTable": {"isTruthTable": 1}})
        chart.function("s", inside={"simulink": {"isSimulinkFcn": 1, "blockName": "s"}})
        chart.state("Part", inside={"simulink": {"isComponent": 1, "blockName": "Part"}})
        chart.state("Act", inside={"simulink": {"isActionSubsystem": 1, "blockName": "Act"}})

    found = states(one_chart(draw, tmp_path))
    assert {name: (one.kind, one.function) for name, one in found.items()} == {
        "A": ("exclusive", ""), "Box": ("box", ""), "A note: <b>x<": ("note", ""),
        "y = f(a)": ("function", "graphical"), "m": ("function", "MATLAB"), "t": ("function", "truth table"),
        "t2": ("function", "truth table"), "s": ("function", "Simulink"), "Part": ("exclusive", ""),
        "Act": ("exclusive", ""),
    }  # fmt: skip
    assert [name for name, one in found.items() if one.atomic] == ["Part"]
    assert [name for name, one in found.items() if one.action_subsystem] == ["Act"]
    assert [(name, one.block) for name, one in found.items() if one.block] == [
        ("s", "s"), ("Part", "Part"), ("Act", "Act")
    ]  # fmt: skip
    assert found["t2"].script == "function t2\nend"


def test_the_properties_of_a_chart_are_read_and_their_defaults_are_known(tmp_path: Path) -> None:
    def draw(chart: WrittenChart) -> None:
        chart.more = {
            "updateMethod": "DISCRETE", "sampleTime": "0.5", "enableNonTerminalStates": 1,
            "stateMachineType": "MEALY_MACHINE", "initializeOutput": 1, "exportChartFunctions": 1,
            "executeAtInitialization": 1,
        }  # fmt: skip
        chart.inside = {"activeStateOutput": {"customName": "mode", "useCustomName": 1}}

    def plain(chart: WrittenChart) -> None:
        chart.language, chart.explicit, chart.saturates = "C", False, False

    told = next(chart_lines(full := one_chart(draw, tmp_path)))
    assert told == (
        "chart 'Chart': MATLAB chart, discrete, Mealy, explicit order, saturates, at initialization, "
        "initializes outputs, super step, exports functions"
    )
    assert (full.sample_time, full.activity_output) == ("0.5", "mode")
    assert next(chart_lines(one_chart(plain, tmp_path))) == "chart 'Chart': C chart, inherited, classic"


@pytest.mark.parametrize(
    ("kind", "read"),
    [("Truth Table", "truth table"), ("State Transition Table", "state transition table")],
)
def test_a_table_is_a_chart_of_its_kind(kind: str, read: str, tmp_path: Path) -> None:
    model = WrittenModel("tables")
    model.root.chart("Table", kind)[1].state("S")
    found = read_model(model.save(tmp_path / "tables.slx"))
    (chart,), (block,) = found.charts, found.system.blocks
    assert (chart.kind, chart.path, block.chart) == (read, "Table", "Table")


def test_data_and_events_keep_what_is_written_of_them(tmp_path: Path) -> None:
    def draw(chart: WrittenChart) -> None:
        chart.data("p", "parameter", "int8", "3", "[1 4]", low=-5, high="LIMIT")
        chart.data("w", "local", more={"initFromWorkspace": 1})
        chart.data("m", "local", inside={"message": {"isMessage": 1}})
        chart.data("a", "output", "boolean", more={"outputState": 9})
        chart.data("d", "data store", "Bus: Cockpit")
        chart.event("up", "INPUT_EVENT", "RISING_EDGE_EVENT")
        chart.event("call", "OUTPUT_EVENT")
        chart.event("own", "LOCAL_EVENT", "EITHER_EDGE_EVENT")

    content = one_chart(draw, tmp_path).content
    p, w, m, a, d = content.data
    assert (p.scope, p.size, p.initial, p.minimum, p.maximum) == ("parameter", "[1 4]", "3", "-5", "LIMIT")
    assert (w.from_workspace, m.message, a.activity_of) == (True, True, 9)
    assert (d.scope, d.type) == ("data store", "Bus: Cockpit")
    told = [(one.name, one.scope, one.trigger) for one in content.events]
    assert told == [("up", "input", "rising"), ("call", "output", "function call"), ("own", "local", "")]


def test_two_elements_with_one_number_are_refused(tmp_path: Path) -> None:
    def draw(chart: WrittenChart) -> None:
        chart.junction(chart.state("S")).ssid = 3
        chart.data("d", "local")

    with pytest.raises(ModelError, match=r"line \d+: the element has SSID 3, and so has the one in line \d+"):
        one_chart(draw, tmp_path)


def test_a_class_of_data_of_all_charts_is_found_too(tmp_path: Path) -> None:
    (tmp_path / "Gear.m").write_text("classdef Gear < uint8\nenumeration\nN (0)\nend\nend\n", "utf-8")
    shared = {"SHARED": {"scope": "LOCAL_DATA", "dataType": "Enum: Gear"}}
    found = read_model(WrittenModel("all", machine=shared).save(tmp_path / "all.slx"))
    assert [one.name for one in found.enumerations] == ["Gear"]
