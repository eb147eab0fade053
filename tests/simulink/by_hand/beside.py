"""Types and values that stand beside a model, and packages as old releases wrote them: models by hand."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from rovercheck.checker.simulink.writer.dictionaries import dictionary
from rovercheck.checker.simulink.writer.packages import DIAGRAM, Layout, WrittenModel, packed
from tests.simulink.by_hand.diagrams import Diagram
from tests.simulink.by_hand.models import ByHand, Given

_LEVEL = """classdef Level < Simulink.IntEnumType % of a tank
  enumeration
    LOW (2)   % the first
    MIDDLE(5)
    HIGH (-1)
  end
  methods (Static)
    function it = getDefaultValue()
      it = Level.MIDDLE;
    end
  end
end
"""
_MODE = "classdef Mode < int32\nenumeration\nON (3)\nOFF (0)\nend\nend\n"
_PACE = "classdef Pace < Simulink.IntEnumType\nenumeration\nSLOW (4)\nFAST (7)\nend\nend\n"


def _members() -> WrittenModel:
    """Enumerations of classes and of a dictionary, with every kind of default member."""
    model = WrittenModel("one", step="0.1", dictionary="types.sldd")
    block, chart = model.root.chart("C")
    chart.data("u", "input", "int8")
    chart.data("level", "output", "Enum: Level")
    chart.data("n", "output", "uint8")
    chart.data("gear", "local", "Enum: Gear", "Gear.R")
    chart.data("mode", "local", "Enum: Mode")
    chart.data("pace", "local", "Enum: Pace")
    chosen = "if u > 1, level = HIGH; elseif u == 0, level = Level.LOW; end"
    a = chart.state(f"A\ndu: {chosen}\nif gear == N, n = uint8(7); end")
    said = "n = uint8(gear) + uint8(level == Level.HIGH) * 10 + uint8(mode == Mode.OFF) * 20;"
    said += " n = n + uint8(pace) * 10;"
    b = chart.state(f"B\nen: gear = Gear.N; {said}\nex: gear = D;")
    chart.transition(None, a)
    chart.transition(a, b, "[level ~= Level.MIDDLE && u == 1]")
    chart.transition(b, a, "[gear == Gear.N && u > 0]")
    model.root.line(model.root.inport("u", 1, OutDataTypeStr="int8"), block)
    for number, name in enumerate(("level", "n"), 1):
        model.root.line(f"{block}/{number}", model.root.outport(name, number))
    return model


def _members_by_hand(given: Given) -> Iterator[tuple[float, ...]]:
    state, level, n = "", 5, 0
    for u in given:
        if not state or (state == "B" and u > 0):
            state = "A"
        elif state == "A" and level != 5 and u == 1:
            state, n = "B", 3 + 10 * (level == -1) + 20 + 40
        elif state == "A":
            level = -1 if u > 1 else 2 if u == 0 else level
        yield level, n


def _levels(folder: Path) -> Sequence[Path]:
    dictionary(folder / "types.sldd", {"Gear": {"R": 1, "N": 3, "D": 0}})
    for name, text in {"Level": _LEVEL, "Mode": _MODE, "Pace": _PACE}.items():
        (folder / f"{name}.m").write_text(text, encoding="utf-8")
    return ()


def _fields() -> WrittenModel:
    """Buses in buses, made of signals, read by a chart and taken apart."""
    d = Diagram()
    d.model.dictionary = "types.sldd"
    inner = d.add("BusCreator", d.u, d.constant("uint8(9)"), Inputs="2", OutDataTypeStr="Bus: Inner")
    bus = d.add("BusCreator", inner, d.add("UnitDelay", d.u), Inputs="2", OutDataTypeStr="Bus: Outer")
    block, chart = d.root.chart("C")
    chart.data("p", "input", "Bus: Outer")
    chart.data("y", "output", "int16")
    a = chart.state("A\nen, du: y = int16(p.inner.level) - int16(p.before);")
    b = chart.state("B\nen: y = int16(p.inner.count);")
    chart.transition(None, a)
    chart.transition(a, b, "[p.before == 2 && p.inner.level == 1]")
    chart.transition(b, a)
    d.root.line(bus, block)
    apart = d.root.block("BusSelector", "apart", {"in": 1, "out": 2}, {}, OutputSignals="inner.count,before")
    d.root.line(bus, apart)
    return d.given(block, apart, f"{apart}/2")


def _fields_by_hand(given: Given) -> Iterator[tuple[float, ...]]:
    state, before = "", 0
    for u in given:
        if state == "A" and before == 2 and u == 1:
            state, y = "B", 9
        else:
            state, y = "A", u - before
        yield y, 9, before
        before = u


def _buses(folder: Path) -> Sequence[Path]:
    inner = [("level", "int8", "1.0"), ("count", "uint8", "1.0")]
    dictionary(folder / "inner.sldd", buses={"Inner": inner}, names="old", part="dictionary/chunk0.xml")
    outer = [("inner", "Bus: Inner", "1"), ("before", "int8", "1")]
    dictionary(folder / "types.sldd", buses={"Outer": outer}, others=["inner.sldd"])
    return ()


_VALUES = """%{
K = 100;
%}
K = 3; LIMITS = [1 2 ...
  5];
P = Simulink.Parameter(LIMITS(2) * 2); % four
START = uint8(200);
"""


def _parameters() -> WrittenModel:
    """Values of a script and of a dictionary, in blocks and in a chart."""
    d = Diagram()
    d.model.dictionary = "types.sldd"
    gain = d.add("Gain", d.u, Gain="int8(K)")
    block, chart = d.root.chart("C")
    chart.data("u", "input", "int8")
    chart.data("y", "output", "int16")
    chart.data("P", "parameter", "int16")
    chart.data("STEPS", "parameter", "int16")
    chart.data("START", "local", "uint8", more={"initFromWorkspace": 1})
    text = "START = START + uint8(20); y = int16(START) + P * int16(u) + STEPS;"
    chart.transition(None, chart.state(f"A\nen, du: {text}"))
    d.root.line(d.u, block)
    return d.given(gain, block, d.constant("LIMITS(3) - 1"))


def _parameters_by_hand(given: Given) -> Iterator[tuple[float, ...]]:
    start = 200
    for u in given:
        start = min(start + 20, 255)
        yield (3 * u + 128) % 256 - 128, start + 4 * u + 12, 4


def _values(folder: Path) -> Sequence[Path]:
    dictionary(folder / "types.sldd", values={"STEPS": "12.0"})
    (folder / "values.m").write_text(_VALUES, encoding="utf-8")
    return [folder / "values.m"]


@dataclass
class RawPackage:
    """A package by its parts, as texts; it has one layout only."""

    parts: Mapping[str, bytes]
    layout: Layout = "inline"

    def save(self, path: Path) -> Path:
        """Write the package."""
        packed(path, self.parts)
        return path


_OLD = """<?xml version="1.0" encoding="ISO-8859-1"?>
<ModelInformation Version="1.0"><Model Name="old"><P Name="Version">7.9</P>
<P Name="Description">Drawn in München, by hand.</P>
<Array PropName="ConfigurationSets" Type="Handle" Dimension="1*1"><Object ClassName="Simulink.ConfigSet">
<Array PropName="Components" Type="Handle" Dimension="1*1"><Object ClassName="Simulink.SolverCC">
<P Name="Solver">FixedStepDiscrete</P><P Name="FixedStep">0.5</P></Object></Array></Object></Array>
<System><P Name="SIDHighWatermark">30</P>
<Block BlockType="Outport" Name="y" SID="9"/>
<Block BlockType="SubSystem" Name="Für&#xA;alle" SID="4">
<P Name="Ports">[2, 1]</P><P Name="SFBlockType">Chart</P>
<System>
<Block BlockType="Inport" Name="b" SID="4::1"><P Name="Port">2</P></Block>
<Block BlockType="Inport" Name="a" SID="4::2"/>
<Block BlockType="Outport" Name="n" SID="4::3"/>
<Block BlockType="S-Function" Name=" SFunction " SID="4::4">
<P Name="Tag">Stateflow S-Function old 1</P></Block>
</System></Block>
<Block BlockType="Inport" Name="u" SID="1"><P Name="OutDataTypeStr">int8</P></Block>
<Block BlockType="Constant" Name="c" SID="2"><P Name="Value">int8(2)</P></Block>
<Line><P Name="Src">1#out:1</P><Branch><Branch><P Name="Dst">4#in:1</P></Branch></Branch><Branch/></Line>
<Line><P Name="Src">2#out:1</P><P Name="Dst">4#in:2</P></Line>
<Line><P Name="Src">4#out:1</P><P Name="Dst">9#in:1</P></Line>
<Line><P Name="Dst">9#in:7</P></Line>
</System></Model></ModelInformation>"""
_MACHINE = """<?xml version="1.0" encoding="ISO-8859-1"?>
<Stateflow><instance id="50">
<P Name="chart">41</P><P Name="machine">40</P><P Name="name">Für&#xA;alle</P></instance>
<machine id="40"><Children><chart id="41"><P Name="screen">[1 1 1280 1024 1.25]</P><Children>
<transition SSID="9"><P Name="labelString">[b == a] /* gleich */ {n = n + 10;}</P>
<P Name="executionOrder">2</P>
<src><P Name="SSID">1</P></src><dst><P Name="SSID">3</P></dst></transition>
<transition SSID="8"><P Name="executionOrder">1</P><P Name="labelString">[a == 7]</P>
<src><P Name="SSID">1</P></src><dst/></transition>
<transition SSID="7"><src/><dst><P Name="SSID">1</P></dst></transition>
<transition SSID="6"><P Name="labelString">?</P>
<src><P Name="SSID">3</P></src><dst><P Name="SSID">1</P></dst></transition>
<state SSID="3"><P Name="labelString">Zwei/n++;</P><P Name="type">OR_STATE</P></state>
<state SSID="1"><P Name="type">OR_STATE</P><P Name="labelString">Eins
du: n += a;</P></state>
<data SSID="4" name="b"><P Name="dataType">int8</P><P Name="scope">INPUT_DATA</P></data>
<data SSID="5" name="n"><P Name="scope">OUTPUT_DATA</P><props><type><P Name="enumType">Left</P></type>
<P Name="initialValue">3</P></props><P Name="dataType">int16</P></data>
<data SSID="2" name="a"><P Name="scope">INPUT_DATA</P><P Name="dataType">int8</P></data>
</Children></chart><target id="42" name="sfun"/></Children></machine></Stateflow>"""


def _old() -> RawPackage:
    texts = {DIAGRAM: _OLD, "simulink/stateflow.xml": _MACHINE}
    parts = {name: text.encode("latin-1") for name, text in texts.items()}
    return RawPackage(parts | {"thumbnail.png": b"\x89PNG"})


def _old_by_hand(given: Given) -> Iterator[tuple[float, ...]]:
    """A chart in C, whose numbers wrap; a transition that leads nowhere is as if it were not drawn."""
    state, n = "", 3
    for u in given:
        if not state or state == "Zwei":
            state = "Eins"
        elif u == 2:
            state, n = "Zwei", n + 11
        else:
            n += u
        yield (n,)


BESIDE = (
    ByHand("members", _members, _members_by_hand, beside=_levels),
    ByHand("fields", _fields, _fields_by_hand, beside=_buses),
    ByHand("parameters", _parameters, _parameters_by_hand, (-100, -3, 0, 1, 43), _values),
    ByHand("old", _old, _old_by_hand, (-3, 0, 1, 2, 2, 7)),
)

__all__ = ["BESIDE", "RawPackage"]
