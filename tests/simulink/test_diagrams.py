"""Diagrams of Simulink, their solver, and the types and values beside them are read as they are written."""

from pathlib import Path

import pytest

from rovercheck.checker.drawn.records import DrawnModel, names_of
from rovercheck.checker.simulink.model import read_model
from rovercheck.checker.simulink.writer.dictionaries import Names, dictionary
from rovercheck.checker.simulink.writer.packages import DIAGRAM, Layout, WrittenModel, packed
from rovercheck.spec_model.lang.errors import ModelError
from tests.simulink.samples import SAMPLES

LAYOUTS: tuple[Layout, ...] = ("parts", "single", "inline")


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
def test_a_dictionary_is_read_with_those_that_it_refers_to(names: Names, part: str, tmp_path: Path) -> None:
    model = WrittenModel("typed", dictionary="types.sldd")
    dictionary(
        tmp_path / "types.sldd", {"Gear": {"P": 2, "N": 0}}, others=["more.sldd"], names=names, part=part
    )
    fields = [("speed", "single", "1.0"), ("list", "Enum: Gear", "[1.0, 3.0]")]
    dictionary(tmp_path / "more.sldd", None, {"Car": fields}, {"LIMIT": "3.5"}, ["types.sldd"], names, part)
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
