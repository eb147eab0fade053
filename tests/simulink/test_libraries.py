"""Links to libraries that stand beside a model: the block of the library is read in their place."""

import os
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Literal

import pytest

from rovercheck.checker.drawn.records import DrawnModel
from rovercheck.checker.drawn.refused import notes_of
from rovercheck.checker.model.drawn import SimulinkModel, read_simulink
from rovercheck.checker.simulink.model import read_model
from rovercheck.checker.simulink.writer.packages import DIAGRAM, packed
from rovercheck.spec_model.lang.errors import ModelError
from tests.simulink.packages_by_hand import block, datum, model, refused, run, signal

Layout = Literal["parts", "inline"]
LAYOUTS: tuple[Layout, ...] = ("parts", "inline")


def masked(**values: str) -> str:
    """A mask with parameters and their values in the library."""
    made = "".join(
        f'<MaskParameter Name="{name}" Type="edit"><Prompt>it</Prompt><Value>{value}</Value></MaskParameter>'
        for name, value in values.items()
    )
    return f"<Mask>{made}</Mask>"


def system(*inside: str) -> str:
    return f"<System>{''.join(inside)}</System>"


def chart_of(name: str, ssid: int, labels: str, data: str) -> tuple[str, str]:
    """The elements of a chart and of its instance."""
    drawn = (
        f'<chart id="{ssid}"><P Name="actionLanguage">2</P><P Name="saturateOnIntegerOverflow">1</P>'
        f"<Children>{labels}{data}</Children></chart>"
    )
    return drawn, f'<instance id="9{ssid}"><P Name="name">{name}</P><P Name="chart">{ssid}</P></instance>'


def state(ssid: int, label: str) -> str:
    return f'<state SSID="{ssid}"><P Name="labelString">{label}</P><P Name="type">OR_STATE</P></state>'


def default(ssid: int, to: int) -> str:
    return f'<transition SSID="{ssid}"><dst><P Name="SSID">{to}</P></dst></transition>'


def sub(name: str, sid: int, ins: str, outs: str, *inside: str, **values: object) -> str:
    """A subsystem with ports from 101 on and from 201 on; what stands before its system is in ``inside``."""
    ports = "".join(
        block(kind, one, first + n, "", Port=n)
        for kind, names, first in (("Inport", ins, 100), ("Outport", outs, 200))
        for n, one in enumerate(names, 1)
    )
    before = "".join(one for one in inside if one.startswith("<Mask"))
    rest = [one for one in inside if not one.startswith("<Mask")]
    return block("SubSystem", name, sid, before + system(ports, *rest), **values)


SCALED = sub(
    "Scaled", 4, "i", "o", masked(K="2", N="5"),
    block("Gain", "gain", 1, Gain="K", OutDataTypeStr="int16") + signal("101#out:1", "1#in:1"),
    block("UnitDelay", "last", 2, InitialCondition="int16(N)"), signal("1#out:1", "2#in:1"),
    signal("2#out:1", "201#in:1"),
)  # fmt: skip
COUNTER = sub("Count&#xA;er", 5, "u", "y", masked(STEP="1"), SFBlockType="Chart")
CHART = chart_of(
    "Group/Count\ner", 7, state(1, "A&#xA;en: y = int16(100); du: y = y + u * STEP;") + default(2, 1),
    datum(3, "u", "INPUT_DATA", "int16") + datum(4, "y", "OUTPUT_DATA", "int16")
    + datum(5, "STEP", "PARAMETER_DATA", "int16"),
)  # fmt: skip
GROUP = sub("Group", 6, "", "", COUNTER)


def library(folder: Path, layout: Layout, blocks: str, *charts: tuple[str, str], name: str = "lib") -> None:
    """A library, in the layout of older or of newer releases."""
    elements = "".join(one for one, _ in charts)
    machine = f'<Stateflow><machine id="1"><Children>{elements}</Children></machine>'
    machine += "".join(instance for _, instance in charts) + "</Stateflow>"
    if layout == "inline":
        text = f"<ModelInformation><Library>{system(blocks)}</Library>{machine}</ModelInformation>"
        packed(folder / f"{name}.slx", {DIAGRAM: text})
        return
    files = {DIAGRAM: '<ModelInformation><Library><System Ref="system_root"/></Library></ModelInformation>'}
    parts = dict(_apart(system(blocks)))
    files |= {f"simulink/systems/{part}.xml": text for part, text in parts.items()}
    files["simulink/stateflow/machine.xml"] = machine
    packed(folder / f"{name}.slx", files)


def _apart(root: str) -> Iterator[tuple[str, str]]:
    """The systems of a text, innermost first, each in a part of its own."""
    number = 0
    while (end := root.find("</System>")) + len("</System>") < len(root):
        start = root.rfind("<System>", 0, end)
        stop = end + len("</System>")
        number += 1
        yield f"system_{number}", root[start:stop]
        root = f'{root[:start]}<System Ref="system_{number}"/>{root[stop:]}'
    yield "system_root", root


def link(name: str, sid: int, source: str, new: bool = True, inside: str = "", **values: object) -> str:
    """A link to a block of a library, with its values of the mask, as newer or as older releases write it."""
    written = "".join(f'<P Name="{key}">{value}</P>' for key, value in values.items())
    inside += f"<InstanceData>{written}</InstanceData>" if new else written
    return block("Reference", name, sid, inside, SourceBlock=source, SourceType="SubSystem")


def around(sid: int, *more: str) -> str:
    """A link between an input u and an output y of the model."""
    ends = block("Inport", "u", 1, OutDataTypeStr="int16") + block("Outport", "y", 2)
    return ends + signal("1#out:1", f"{sid}#in:1") + signal(f"{sid}#out:1", "2#in:1") + "".join(more)


def rows(*values: int) -> list[Mapping[str, float]]:
    return [{"u": value} for value in values]


@pytest.mark.parametrize("layout", LAYOUTS)
@pytest.mark.parametrize("new", [False, True])
def test_a_link_is_the_block_of_its_library_with_its_own_values(
    layout: Layout, new: bool, tmp_path: Path
) -> None:
    """Names of the mask have the values of the library, or those of the link, of names around it."""
    library(tmp_path, layout, SCALED)
    read = model(around(4, link("It", 4, "lib/Scaled", new, K="3*V")), tmp_path, files={"v.m": "V = 2;"})
    assert run(read, rows(1, 10, -4)) == [(5,), (6,), (60,)]
    assert [Path(one).name for one in read.files] == ["hand.slx", "lib.slx", "v.m"]


@pytest.mark.parametrize("layout", LAYOUTS)
def test_two_links_to_one_block_are_two_blocks(layout: Layout, tmp_path: Path) -> None:
    """Their blocks have the same numbers in the library, and would be one."""
    library(tmp_path, layout, SCALED)
    two = link("One", 4, "lib/Scaled", N="0") + link("Two", 5, "lib/Scaled", K="10", N="7")
    add = block("Sum", "both", 6) + signal("4#out:1", "6#in:1") + signal("5#out:1", "6#in:2")
    wires = signal("1#out:1", "4#in:1") + signal("1#out:1", "5#in:1") + signal("6#out:1", "2#in:1")
    ends = block("Inport", "u", 1, OutDataTypeStr="int16") + block("Outport", "y", 2)
    assert run(model(ends + two + add + wires, tmp_path), rows(1, 2, 3)) == [(7,), (12,), (24,)]


@pytest.mark.parametrize("layout", LAYOUTS)
def test_a_chart_of_a_library_is_one_of_the_model_at_each_link(layout: Layout, tmp_path: Path) -> None:
    """Its parameters are those of the mask of its block."""
    library(tmp_path, layout, GROUP, CHART)
    first = link("First", 4, "lib/Group/Count&#xA;er", STEP="4")
    second = link("Second", 5, "lib/Group/Count&#xA;er") + signal("4#out:1", "5#in:1")
    wires = signal("1#out:1", "4#in:1") + signal("5#out:1", "2#in:1")
    ends = block("Inport", "u", 1, OutDataTypeStr="int16") + block("Outport", "y", 2)
    read = model(ends + first + second + wires, tmp_path)
    assert [one.path for one in read.charts] == ["First", "Second"]
    y = z = 0
    expected = []
    for step, u in enumerate((1, 2, -3, 5)):
        y = 100 if not step else y + 4 * u
        z = 100 if not step else z + y
        expected.append((z,))
    assert run(read, rows(1, 2, -3, 5)) == expected


@pytest.mark.parametrize("layout", LAYOUTS)
def test_a_link_within_a_library_leads_to_another_one(layout: Layout, tmp_path: Path) -> None:
    inner = (
        link("Inner", 8, "lib/Scaled", K="L") + signal("101#out:1", "8#in:1") + signal("8#out:1", "201#in:1")
    )
    library(tmp_path, layout, SCALED)
    library(tmp_path, layout, sub("Outer", 3, "i", "o", masked(L="1"), inner), name="other")
    assert run(model(around(4, link("It", 4, "other/Outer", L="7")), tmp_path), rows(1, 2, 3)) == [
        (5,), (7,), (14,)
    ]  # fmt: skip


@pytest.mark.parametrize("layout", LAYOUTS)
def test_an_atomic_subchart_may_be_a_link(layout: Layout, tmp_path: Path) -> None:
    part = chart_of(
        "Part", 8, state(1, "In&#xA;en: y = int16(1); du: y = y + u;") + default(2, 1),
        datum(3, "u", "INPUT_DATA", "int16") + datum(4, "y", "OUTPUT_DATA", "int16"),
    )  # fmt: skip
    library(tmp_path, layout, sub("Part", 3, "u", "y", SFBlockType="Chart"), part)
    atomic = (
        '<state SSID="1"><P Name="labelString">Sub</P><P Name="type">OR_STATE</P><simulink>'
        '<P Name="isComponent">1</P><P Name="blockName">Sub</P></simulink></state>'
    )
    drawn, instance = chart_of(
        "C", 2, atomic + default(2, 1),
        datum(3, "u", "INPUT_DATA", "int16") + datum(4, "y", "OUTPUT_DATA", "int16"),
    )  # fmt: skip
    text = f'<Stateflow><machine id="1"><Children>{drawn}</Children></machine>{instance}</Stateflow>'
    own = sub("C", 4, "u", "y", link("Sub", 9, "lib/Part"), SFBlockType="Chart")
    assert run(model(around(4, own), tmp_path, "", text), rows(5, 6, 7)) == [(1,), (7,), (14,)]


def told(read: DrawnModel) -> list[str]:
    return [str(note) for note in notes_of(read)]


@pytest.mark.parametrize(
    ("made", "said"),
    [
        (link("It", 4, "nowhere/Scaled"), "it is a link to a library, which is in no file beside the model."),
        (link("It", 4, "lib/Other"), "it is a link to a library, which is in no file beside the model."),
        (link("It", 4, "../lib/Scaled"), "it is a link to a library, which is in no file beside the model."),
        (link("It", 4, "lib/Plain"), "it is a link to a block of a library that is no subsystem."),
        (
            link("It", 4, "lib/Scaled", inside="<LinkData/>"),
            "it is a link to a library that is changed here.",
        ),
    ],
)
def test_a_link_that_is_not_followed_is_refused(made: str, said: str, tmp_path: Path) -> None:
    library(tmp_path, "inline", SCALED + block("Gain", "Plain", 9, Gain="2"))
    read = model(around(4, made), tmp_path)
    assert all(said in one for one in (*told(read), *refused(read)))
    assert len(told(read)) == 1


def test_a_library_in_which_the_same_link_is_is_refused(tmp_path: Path) -> None:
    """It was read without an end."""
    library(tmp_path, "inline", sub("Loop", 3, "i", "o", link("Again", 8, "lib/Loop")))
    [one] = told(model(around(4, link("It", 4, "lib/Loop")), tmp_path))
    assert one.startswith(
        "It/Again, Reference block 4:8: it is a link to a library in which the same link is."
    )


def test_a_library_elsewhere_is_named(tmp_path: Path) -> None:
    (tmp_path / "far").mkdir()
    library(tmp_path / "far", "inline", SCALED)
    model(around(4, link("It", 4, "lib/Scaled")), tmp_path)
    read = read_model(tmp_path / "hand.slx", [tmp_path / "far" / "lib.slx"])
    assert run(read, rows(1, 10)) == [(5,), (2,)]


def test_libraries_that_lead_to_each_other_many_times_are_read_within_bounds(tmp_path: Path) -> None:
    """Ten levels of ten links each would be ten thousand million blocks."""
    for level in range(10):
        links = "".join(link(f"L{n}", 10 + n, f"lib{level + 1}/S") for n in range(10))
        library(tmp_path, "inline", sub("S", 3, "", "", links), name=f"lib{level}")
    with pytest.raises(ModelError, match="the paths of the blocks have more than 50,000,000 letters"):
        model(around(4, link("It", 4, "lib0/S")), tmp_path)


def test_a_library_that_changes_changes_the_model(tmp_path: Path) -> None:
    """A model is read once as long as no file of it changes."""
    library(tmp_path, "inline", SCALED)
    model(around(4, link("It", 4, "lib/Scaled", K="1")), tmp_path)
    before = begun(read_simulink(tmp_path / "hand.slx"))
    library(tmp_path, "inline", SCALED.replace("int16(N)", "int16(N + 1)"))
    os.utime(tmp_path / "lib.slx", (0, 0))
    assert (before, begun(read_simulink(tmp_path / "hand.slx"))) == ("int16((5))", "int16((5) + 1)")


def begun(read: SimulinkModel) -> str:
    """What the delay of a model begins with."""
    every = read.lowered.model.system.every_block()
    return next(one.parameters["InitialCondition"] for one in every if one.kind == "UnitDelay")
