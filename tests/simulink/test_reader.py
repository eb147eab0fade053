"""What stands in a package of Simulink is read as it stands there, in all layouts of all releases."""

import re
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest

from rovercheck.checker.drawn.records import DrawnChart, DrawnModel, DrawnState, names_of
from rovercheck.checker.simulink.model import read_model
from rovercheck.spec_model.lang.errors import ModelError
from tests.simulink.outline import chart_lines, outline
from tests.simulink.samples import SAMPLES, package_of, write_beside
from tests.simulink.writer.charts import WrittenChart
from tests.simulink.writer.dictionaries import dictionary
from tests.simulink.writer.packages import DIAGRAM, Layout, WrittenModel, packed

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


# --- diagrams ----------------------------------------------------------------------------------------------


@pytest.mark.parametrize("layout", LAYOUTS)
def test_a_chart_finds_its_block_whatever_its_name(layout: Layout, tmp_path: Path) -> None:
    """Line breaks in a name stay, and slashes in it are doubled in paths."""
    model = WrittenModel("names", layout=layout)
    _, inside = model.root.subsystem('in/out\nof <"it">', 1, 1)
    inside.chart("a/b\n& c")
    found = read_model(model.save(tmp_path / "names.slx"))
    (chart,) = found.charts
    assert chart.path in {block.chart for block in found.system.every_block()}
    assert names_of(chart.path) == ('in/out\nof <"it">', "a/b\n& c")
    assert chart.name == "a/b\n& c"


@pytest.mark.parametrize("layout", LAYOUTS)
def test_ports_are_counted_in_old_and_new_layouts(layout: Layout, tmp_path: Path) -> None:
    model = WrittenModel("ports", layout=layout)
    model.root.subsystem("Enabled", 2, 0, "enable")
    model.root.subsystem("Triggered", 0, 1, "trigger")
    blocks = read_model(model.save(tmp_path / "ports.slx")).system.blocks
    counts = [{k: v for k, v in b.parameters.items() if k.startswith("ports") and v != "0"} for b in blocks]
    assert counts == [{"ports in": "2", "ports enable": "1"}, {"ports out": "1", "ports trigger": "1"}]


SYSTEM = """
<Block BlockType="Gain" Name="g" SID="1"><P Name="Position">{position}</P></Block>
<Line><P Name="Src">1#out:1</P>
  <Branch><P Name="Dst">2#in:1</P></Branch>
  <Branch><Branch><P Name="Dst">3#enable</P></Branch><Branch/></Branch>
</Line>
<Line><P Name="Src">1#out:2</P></Line>
<Line><P Name="Dst">1#in:1</P></Line>
<Line><P Name="Src">4#state</P><P Name="Dst">5::6#trigger</P></Line>
"""


def diagram(system: str, folder: Path, more: str = "") -> DrawnModel:
    """A model in one part, of which the system is written by hand."""
    text = f"<ModelInformation><Model>{more}<System>{system}</System></Model></ModelInformation>"
    packed(folder / "hand.slx", {DIAGRAM: text})
    return read_model(folder / "hand.slx")


def test_branches_nest_and_ends_that_are_not_connected_are_no_signals(tmp_path: Path) -> None:
    lines = diagram(SYSTEM.format(position=""), tmp_path).system.lines
    assert [(one.source, one.from_port, one.target, one.to_port) for one in lines] == [
        ("1", 1, "2", "1"), ("1", 1, "3", "enable"), ("4", 0, "5::6", "trigger")
    ]  # fmt: skip


@pytest.mark.parametrize(
    "end", ["1#enable", "1#in:1", "1#out", "out:1", "1#out:x", "1#out:1234567", "1#up:1"]
)
def test_a_signal_comes_out_of_an_output(end: str, tmp_path: Path) -> None:
    with pytest.raises(ModelError, match=f"a signal ends at '{end}', which is no port"):
        diagram(f'<Line><P Name="Src">{end}</P><P Name="Dst">2#in:1</P></Line>', tmp_path)


@pytest.mark.parametrize(
    ("position", "rectangle"),
    [
        ("[10, 20, 40, 60]", (10, 20, 30, 40)),
        ("[10 20 40 60]", (10, 20, 30, 40)),
        ("[-10.5,20,4e1,60,70]", (-10.5, 20, 50.5, 40)),
        ("", (0, 0, 0, 0)),
        (f"[{'9' * 300}, 1e999, 3, 4]", (0, 0, 3, 4)),
    ],
)
def test_a_position_is_four_numbers_however_it_is_written(
    position: str, rectangle: tuple[float, ...], tmp_path: Path
) -> None:
    block = diagram(SYSTEM.format(position=position), tmp_path).system.blocks[0]
    assert block.rectangle == rectangle


def test_the_solver_is_that_of_the_configuration_that_is_active(tmp_path: Path) -> None:
    files = SAMPLES["1_lamp"]().files()
    for number, (active, name) in enumerate([("false", "one"), ("true", "two")]):
        files[f"simulink/{name}.xml"] = (
            f'<ConfigSet><Object ClassName="Simulink.SolverCC"><P Name="FixedStep" Class="char">{number}</P>'
            "</Object></ConfigSet>"
        ).encode()
        files["simulink/configSetInfo.xml"] = (
            '<ConfigSetInfo><ConfigSet PartName="/simulink/one.xml" Active="false">a</ConfigSet>'
            f'<ConfigSet PartName="/simulink/{name}.xml" Active="{active}">b</ConfigSet></ConfigSetInfo>'
        ).encode()
    packed(tmp_path / "lamp.slx", files)
    assert read_model(tmp_path / "lamp.slx").step == "1"


def test_of_configurations_inline_the_active_one_counts(tmp_path: Path) -> None:
    solver = '<Object ClassName="Simulink.SolverCC"><P Name="FixedStep">{}</P></Object>'
    sets = "".join(
        f'<Object ClassName="Simulink.ConfigSet" ObjectID="{n}">{solver.format(f"0.{n}")}</Object>'
        for n in (1, 2)
    )
    both = f'<Array PropName="ConfigurationSets">{sets}</Array>'
    assert diagram("", tmp_path, both).step == "0.1"
    active = '<Object PropName="ActiveConfigurationSet" ObjectID="2"/>'
    assert diagram("", tmp_path, both + active).step == "0.2"


def test_names_of_signals_are_read_in_old_and_new_layouts(tmp_path: Path) -> None:
    new = (
        '<PortProperties><Port Type="out" Index="2"><P Name="Name">b</P></Port><Port Type="in" Index="1"/>'
        "</PortProperties>"
    )
    old = '<Port><P Name="PortNumber">2</P><P Name="Name">b</P></Port><Port><P Name="PortNumber">1</P></Port>'
    for inside in (new, old):
        text = f'<Block BlockType="Demux" Name="d" SID="1">{inside}</Block>'
        assert diagram(text, tmp_path).system.blocks[0].signals == {"2": "b"}


# --- beside the model --------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("names", "part"),
    [("new", "data/chunk0.xml"), ("old", "dictionary/data.xml"), ("old", "data/chunk3.xml")],
)
def test_a_dictionary_is_read_with_those_that_it_refers_to(names: str, part: str, tmp_path: Path) -> None:
    old = {"names": "old", "part": part} if names == "old" else {}
    model = WrittenModel("typed", dictionary="types.sldd")
    dictionary(tmp_path / "types.sldd", {"Gear": {"P": 2, "N": 0}}, others=["more.sldd"], **old)
    fields = [("speed", "single", "1.0"), ("list", "Enum: Gear", "[1.0, 3.0]")]
    dictionary(tmp_path / "more.sldd", None, {"Car": fields}, {"LIMIT": "3.5"}, ["types.sldd"], **old)
    found = read_model(model.save(tmp_path / "typed.slx"))
    (gear,), (car,), (limit,) = found.enumerations, found.buses, found.parameters
    assert (gear.members, gear.default, gear.file) == ({"P": 2, "N": 0}, "P", "types.sldd")
    assert [(e.name, e.type, e.dimensions) for e in car.elements] == [
        ("speed", "single", "1"), ("list", "Enum: Gear", "1 3")
    ]  # fmt: skip
    assert (limit.value, limit.file) == ("3.5", "more.sldd")
    assert [Path(file).name for file in found.files] == ["typed.slx", "types.sldd", "more.sldd"]


def test_files_that_are_named_beside_the_model_are_read_too(tmp_path: Path) -> None:
    (tmp_path / "values.m").write_text(
        "A = 5; % five\nB = single(0.2);\nif A == 5\n  C.x = 1;\nend\n", encoding="utf-8"
    )
    (tmp_path / "Gear.m").write_text(
        "classdef Gear < int8 % a type\n  enumeration\n    P (-1), N(0)\n    D (1) % M (7)\n  end\n"
        "  methods (Static)\n    function d = getDefaultValue()\n      d = Gear.D;\n    end\n  end\nend\n",
        encoding="utf-8",
    )
    model = WrittenModel("lamp").save(tmp_path / "lamp.slx")
    found = read_model(model, [tmp_path / "values.m", tmp_path / "Gear.m"])
    assert [(one.name, one.value) for one in found.parameters] == [("A", "5"), ("B", "single(0.2)")]
    (gear,) = found.enumerations
    assert (gear.members, gear.default, gear.storage) == ({"P": -1, "N": 0, "D": 1}, "D", "int8")


def test_what_a_model_names_and_is_not_there_is_left_out(tmp_path: Path) -> None:
    model = WrittenModel("odd", dictionary="x" * 5000)
    model.root.inport("a", 1, OutDataTypeStr=f"Enum: {'A' * 5000}")
    model.root.inport("b", 2, OutDataTypeStr="Enum: ../Other")
    found = read_model(model.save(tmp_path / "odd.slx"))
    assert (found.enumerations, len(found.files)) == ((), 1)


@pytest.mark.parametrize(
    "encoding", ["utf-8", "utf-8-sig", "utf-16", "shift_jis", "euc_kr", "gb18030", "big5", "koi8-r"]
)
def test_an_encoding_that_a_part_declares_is_understood(encoding: str, tmp_path: Path) -> None:
    name = {"koi8-r": "Лампа", "euc_kr": "램프", "big5": "燈"}.get(encoding, "灯")
    files = SAMPLES["1_lamp"]().files()
    text = f'<System><Block BlockType="Gain" Name="{name}" SID="1"/></System>'
    declared = f'<?xml version="1.0" encoding="{encoding.removesuffix("-sig")}"?>{text}'
    files["simulink/systems/system_root.xml"] = declared.encode(encoding)
    packed(tmp_path / "lamp.slx", files)
    assert [block.name for block in read_model(tmp_path / "lamp.slx").system.blocks] == [name]
