"""Charts as short texts, written into packages as releases of Simulink write them.

Not by the writer of this project: with what editors leave in files, in another order, defaults left out.
"""

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from itertools import count
from pathlib import Path
from typing import Literal
from xml.sax.saxutils import escape

from rovercheck.checker.drawn.records import DrawnModel
from rovercheck.checker.simulink.model import read_model
from rovercheck.checker.simulink.writer.packages import DIAGRAM, packed

Layout = Literal["R2015a", "R2024a"]
SCOPES = {
    "in": "INPUT_DATA", "out": "OUTPUT_DATA", "local": "LOCAL_DATA", "constant": "CONSTANT_DATA",
    "parameter": "PARAMETER_DATA", "temporary": "TEMPORARY_DATA", "takes": "FUNCTION_INPUT_DATA",
    "gives": "FUNCTION_OUTPUT_DATA",
}  # fmt: skip
KINDS = {
    "state": "OR_STATE", "subchart": "OR_STATE", "region": "AND_STATE", "function": "FUNC_STATE",
    "box": "GROUP_STATE",
}  # fmt: skip
LANGUAGES = {"C": "", "C bits": '<P Name="actionLanguage">1</P>', "MATLAB": '<P Name="actionLanguage">2</P>'}
_ARROW = re.compile(r"(\w*)\s*-(?:(\d+)-)?>\s*(\w+)\s*(?:: ?(.*))?", re.DOTALL)
_SIZED = re.compile(r"(\w+)(\[[^\]]*\])?")


@dataclass
class Element:
    """A line of the text, with what is indented below it."""

    text: str
    inside: list["Element"] = field(default_factory=list)
    ssid: int = 0


@dataclass
class ChartText:
    """A chart by lines, of which the words mean what they say; what is indented is drawn inside.

    ``in u int8``, ``out y = 3``, ``event E``, ``event E input rising``; ``state A: en: y = 1;`` (``\\n`` is a
    line break), ``region``, ``subchart``, ``box``, ``function``; ``junction j``, ``history h``; ``-> A`` is a
    default transition, ``A -> B: label`` another one, ``A -2-> B`` the second in order; one from A inside A
    is inner.
    """

    name: str
    text: str
    language: str = "C bits"
    step: str = "0.1"
    more: Mapping[str, object] = field(default_factory=dict)
    files: Mapping[str, str] = field(default_factory=dict)

    def save(self, folder: Path, layout: Layout) -> Path:
        """Write the package, and the files beside it."""
        for name, said in self.files.items():
            (folder / name).write_text(said, encoding="utf-8")
        path = folder / f"{self.name}.slx"
        packed(path, _Package(self, layout).parts())
        return path

    def read(self, folder: Path, layout: Layout = "R2024a") -> DrawnModel:
        """The model, as it is read from its package."""
        return read_model(self.save(folder, layout), [folder / name for name in self.files])


def _outline(text: str) -> Element:
    root = Element("")
    levels = [(-1, root)]
    for line in text.splitlines():
        if line.strip():
            depth = len(line) - len(line.lstrip())
            while levels[-1][0] >= depth:
                levels.pop()
            one = Element(line.strip().replace("\\n", "\n"))
            levels[-1][1].inside.append(one)
            levels.append((depth, one))
    return root


class _Package:
    def __init__(self, chart: ChartText, layout: Layout) -> None:
        self.chart, self.new = chart, layout == "R2024a"
        self.root = _outline(chart.text)
        self._numbers = count(3)
        self._named: dict[str, int] = {}
        self._orders: dict[tuple[str, bool], int] = {}
        self._kinds: dict[int, str] = {}
        self._number(self.root)
        self.events = [one.text.split() for one in self.root.inside if one.text.startswith("event")]

    def _number(self, holder: Element) -> None:
        for one in holder.inside:
            one.ssid = next(self._numbers)
            found = re.match(r"(state|region|subchart|junction|history)\s+(\w+)", one.text)
            if found:
                self._named[found[2]] = one.ssid
            self._number(one)

    # --- the chart -----------------------------------------------------------------------------------------

    def _chart(self) -> str:
        more = "".join(f'<P Name="{key}">{value}</P>' for key, value in self.chart.more.items())
        regions = any(one.text.startswith("region") for one in self.root.inside)
        return (
            '<chart id="21"><P Name="name">C</P><P Name="windowPosition">[359 251 1000 660]</P>'
            '<P Name="viewLimits">[0 156.75 0 153.75]</P><P Name="screen">[1 1 1280 1024 1.25]</P>'
            + (f'<P Name="decomposition">{"SET_CHART" if regions else "CLUSTER_CHART"}</P>')
            + '<P Name="firstData">30</P><P Name="viewObj">21</P><P Name="ssIdHighWaterMark">88</P>'
            + LANGUAGES[self.chart.language]
            + more
            + '<P Name="chartFileNumber">1</P><P Name="disableImplicitCasting">1</P>'
            '<P Name="userSpecifiedStateTransitionExecutionOrder">1</P><P Name="visible">1</P>'
            + self._children(self.root)
            + "</chart>"
        )

    def _children(self, holder: Element) -> str:
        # transitions stand before data and states, as the order of children is not reliable
        made = [self._element(one, holder) for one in holder.inside]
        drawn = [one for one in made if not one.startswith(("<data", "<event"))]
        ordered = [one for one in made if one.startswith(("<data", "<event"))]
        return f"<Children>{''.join(reversed(drawn))}{''.join(ordered)}</Children>"

    def _element(self, one: Element, holder: Element) -> str:
        word, _, rest = one.text.partition(" ")
        if word in SCOPES:
            return self._datum(one, word, rest)
        if word == "event":
            return self._event(one, rest.split())
        if word in ("junction", "history"):
            type_ = "HISTORY_JUNCTION" if word == "history" else "CONNECTIVE_JUNCTION"
            label = '<P Name="labelString">H</P>' if word == "history" else ""
            return (
                f'<junction SSID="{one.ssid}">{label}<P Name="position">[23.5747 49.5747 7]</P>'
                f'<P Name="subviewer">21</P><P Name="ssIdNumber">{one.ssid}</P><P Name="type">{type_}</P>'
                '<P Name="linkNode">[21 0 0]</P></junction>'
            )
        if word in KINDS:
            return self._state(one, word, rest, holder)
        return self._transition(one, holder)

    def _state(self, one: Element, word: str, rest: str, holder: Element) -> str:
        regions = any(inner.text.startswith("region") for inner in one.inside)
        name, _, label = rest.partition(":")
        script = next((inner.text for inner in one.inside if inner.text.startswith("script ")), "")
        written = rest
        if word != "function" and "/" not in name and label:
            written = f"{name}\n{label.strip()}"
        inside = [inner for inner in one.inside if not inner.text.startswith("script ")]
        peers = [peer for peer in holder.inside if peer.text.startswith("region")]
        order = f'<P Name="executionOrder">{peers.index(one) + 1}</P>' if word == "region" else ""
        eml = f'<eml><P Name="isEML">1</P><P Name="script">{escape(script[7:])}</P></eml>' if script else ""
        return (
            f'<state SSID="{one.ssid}"><P Name="labelString">{escape(written)}</P>'
            '<P Name="position">[30.6 35.5 133.4 150.7]</P><P Name="fontSize">12</P>'
            f'<P Name="ssIdNumber">{one.ssid}</P>'
            + ('<P Name="superState">SUBCHART</P>' if word == "subchart" else "")
            + '<P Name="treeNode">[21 0 0 0]</P><P Name="subviewer">21</P>'
            f'<P Name="type">{KINDS[word]}</P><P Name="decomposition">'
            f"{'SET_STATE' if regions else 'CLUSTER_STATE'}</P>{order}{eml}"
            + self._children(Element(one.text, inside, one.ssid))
            + "</state>"
        )

    def _transition(self, one: Element, holder: Element) -> str:
        found = _ARROW.fullmatch(one.text)
        assert found, one.text
        source, written, target, label = found.groups()
        key = (source or f"default of {holder.ssid}", self._named.get(source) == holder.ssid)
        order = int(written) if written else self._orders.get(key, 0) + 1
        self._orders[key] = order
        start = f'<P Name="SSID">{self._named[source]}</P>' if source else ""
        return (
            f'<transition SSID="{one.ssid}">'
            + (f'<P Name="labelString">{escape(label)}</P>' if label else "")
            + '<P Name="labelPosition">[82.125 58.251 8.146 14.964 0]</P><P Name="fontSize">12</P>'
            f'<src>{start}<P Name="intersection">[3 0 1 0.4 82.2 41.8 0 0]</P></src>'
            f'<dst><P Name="SSID">{self._named[target]}</P>'
            '<P Name="intersection">[1 0 -1 0.5 81.4 75.1 0 0]</P></dst>'
            f'<P Name="midPoint">[81.6 57.1]</P><P Name="chart">21</P><P Name="linkNode">[21 0 0]</P>'
            f'<P Name="ssIdNumber">{one.ssid}</P><P Name="subviewer">21</P><P Name="drawStyle">SMART</P>'
            f'<P Name="executionOrder">{order}</P></transition>'
        )

    def _datum(self, one: Element, word: str, rest: str) -> str:
        said, _, initial = rest.partition("=")
        name, *kind = said.split(maxsplit=1)
        sized = _SIZED.fullmatch(name)
        assert sized, rest
        type_ = kind[0].strip() if kind else "double"
        size = f'<P Name="size">{sized[2]}</P>' if sized[2] else ""
        return (
            f'<data SSID="{one.ssid}" name="{sized[1]}"><P Name="linkNode">[21 0 0]</P>'
            f'<P Name="scope">{SCOPES[word]}</P><P Name="machine">20</P><props><array>{size}'
            '<P Name="firstIndex">0</P></array><type><P Name="method">SF_BUILT_IN_TYPE</P>'
            '<P Name="primitive">SF_DOUBLE_TYPE</P><P Name="isSigned">1</P><P Name="wordLength">16</P></type>'
            "<complexity>SF_COMPLEX_NO</complexity><frame>SF_FRAME_NO</frame>"
            + (f'<P Name="initialValue">{escape(initial.strip())}</P>' if initial else "")
            + f'</props><P Name="dataType">{type_}</P><P Name="dataLimits">[0 0 0 0]</P></data>'
        )

    def _event(self, one: Element, words: list[str]) -> str:
        name, scope, trigger = (*words, "local", "")[:3]
        return (
            f'<event SSID="{one.ssid}"><P Name="name">{name}</P><P Name="linkNode">[21 0 0]</P>'
            f'<P Name="scope">{scope.upper()}_EVENT</P>'
            f'<P Name="trigger">{(trigger or "function_call").upper()}'
            f"{'_EVENT' if not trigger or trigger == 'function_call' else '_EDGE_EVENT'}</P></event>"
        )

    # --- the diagram ---------------------------------------------------------------------------------------

    def _ports(self, scope: str) -> list[tuple[str, str]]:
        found = []
        for one in self.root.inside:
            word, _, rest = one.text.partition(" ")
            if word == scope:
                name, *kind = rest.partition("=")[0].split(maxsplit=1)
                found.append((name, kind[0].strip() if kind else "double"))
        return found

    def _system(self) -> tuple[str, str]:
        """The diagram around the chart, and what is in the block of the chart."""
        ins, outs = self._ports("in"), self._ports("out")
        triggers = [words for words in self.events if words[2:3] == ["input"]]
        blocks, lines, inside, wires = [], [], [], []

        def line(source: str, target: str) -> str:
            ends = f'<P Name="Src">{source}</P><P Name="Dst">{target}</P>'
            return f'<Line ZOrder="1"><P Name="ZOrder">1</P>{ends}</Line>'

        for number, (name, kind) in enumerate(ins, 1):
            sized = _SIZED.fullmatch(name)
            assert sized
            size = f'<P Name="PortDimensions">{sized[2]}</P>' if sized[2] else ""
            port = f'<P Name="Port">{number}</P>' if number > 1 else ""
            blocks.append(
                f'<Block BlockType="Inport" Name="{sized[1]}" SID="{number}">'
                '<P Name="Position">[25, 38, 55, 52]</P>'
                f'<P Name="ZOrder">-1</P>{port}{size}<P Name="IconDisplay">Port number</P>'
                f'<P Name="OutDataTypeStr">{kind}</P></Block>'
            )
            lines.append(line(f"{number}#out:1", f"50#in:{number}"))
            inside.append(
                f'<Block BlockType="Inport" Name="{sized[1]}" SID="50::{number}">'
                f'<P Name="Position">[20, 101, 40, 119]</P>{port}'
                '<P Name="IconDisplay">Port number</P></Block>'
            )
            wires.append(line(f"50::{number}#out:1", f"50::90#in:{number}"))
        for number, (name, _) in enumerate(outs, 1):
            port = f'<P Name="Port">{number}</P>' if number > 1 else ""
            sized = _SIZED.fullmatch(name)
            assert sized
            blocks.append(
                f'<Block BlockType="Outport" Name="{sized[1]}" SID="{60 + number}">'
                f'<P Name="Position">[370, 38, 400, 52]</P>{port}'
                '<P Name="IconDisplay">Port number</P></Block>'
            )
            lines.append(line(f"50#out:{number}", f"{60 + number}#in:1"))
            inside.append(
                f'<Block BlockType="Outport" Name="{sized[1]}" SID="50::{40 + number}"><P Name="Position">'
                f'[460, 101, 480, 119]</P>{port}<P Name="IconDisplay">Port number</P></Block>'
            )
            wires.append(line(f"50::90#out:{number + 1}", f"50::{40 + number}#in:1"))
        if triggers:
            names = [words[1] for words in triggers]
            for number, name in enumerate(names, 1):
                sid = 30 + number
                blocks.append(
                    f'<Block BlockType="Inport" Name="{name}" SID="{sid}">'
                    f'<P Name="Port">{len(ins) + number}</P>'
                    '<P Name="OutDataTypeStr">boolean</P></Block>'
                )
                if len(names) > 1:
                    lines.append(line(f"{sid}#out:1", f"49#in:{number}"))
                else:
                    lines.append(line(f"{sid}#out:1", "50#trigger"))
            if len(names) > 1:
                blocks.append(
                    f'<Block BlockType="Mux" Name="Mux" SID="49"><P Name="Ports">[{len(names)}, 1]</P>'
                    f'<P Name="Inputs">{len(names)}</P></Block>'
                )
                lines.append(line("49#out:1", "50#trigger"))
            title = names[0] if len(names) == 1 else "input events"
            inside.append(
                f'<Block BlockType="TriggerPort" Name="{title}" SID="50::95"><P Name="Ports">[]</P>'
                f'<P Name="TriggerType">{triggers[0][3]}</P></Block>'
            )
            wires.append(line("50::95#out:1", "50::90#trigger"))
        inside += [
            '<Block BlockType="Demux" Name=" Demux " SID="50::88"><P Name="Ports">[1, 1]</P>'
            '<P Name="Outputs">1</P></Block>',
            f'<Block BlockType="S-Function" Name=" SFunction " SID="50::90"><P Name="Ports">[{len(ins)}, '
            f'{len(outs) + 1}]</P><P Name="FunctionName">sf_sfun</P>'
            '<P Name="Tag">Stateflow S-Function known 1</P>'
            "</Block>",
            '<Block BlockType="Terminator" Name=" Terminator " SID="50::89"/>',
        ]
        wires += [line("50::90#out:1", "50::88#in:1"), line("50::88#out:1", "50::89#in:1")]
        held = f'<P Name="SIDHighWatermark">95</P>{"".join(inside)}{"".join(wires)}'
        own = '<System Ref="system_50"/>' if self.new else f"<System>{held}</System>"
        trigger = ' trigger="1"' if triggers else ""
        ports = (
            f'<PortCounts in="{len(ins)}" out="{len(outs)}"{trigger}/>'
            if self.new
            else f'<P Name="Ports">[{len(ins)}, {len(outs)}{", 0, 1" if triggers else ""}]</P>'
        )
        blocks.append(
            f'<Block BlockType="SubSystem" Name="C" SID="50">{ports}<P Name="Position">[120, 20, 240, 90]</P>'
            '<P Name="ZOrder">-2</P><P Name="LibraryVersion">1.32</P><P Name="ErrorFcn">Stateflow.Translate.'
            'translate</P><P Name="PermitHierarchicalResolution">ExplicitOnly</P>'
            '<P Name="TreatAsAtomicUnit">on</P>'
            '<P Name="RTWMemSecFuncInitTerm">Inherit from model</P><P Name="SFBlockType">Chart</P>'
            f'<P Name="Variant">off</P>{own}</Block>'
        )
        return "".join(blocks + lines), held

    # --- the package ---------------------------------------------------------------------------------------

    def parts(self) -> dict[str, str]:
        """The parts by their names."""
        head = '<?xml version="1.0" encoding="utf-8"?>\n'
        system, inside = self._system()
        solver = (
            '<Object Version="14.3.0" ClassName="Simulink.SolverCC"><P Name="StartTime">0.0</P>'
            f'<P Name="StopTime">20</P><P Name="FixedStep">{self.chart.step}</P>'
            '<P Name="Solver">FixedStepDiscrete</P></Object>'
        )
        config = (
            '<Object Version="14.3.0" ClassName="Simulink.ConfigSet"><P Name="Description"/><Array '
            f'PropName="Components" Type="Handle" Dimension="1*1">{solver}</Array></Object>'
        )
        targets = '<target id="91" name="sfun"><P Name="machine">20</P></target>'
        instance = (
            '<instance id="92"><P Name="machine">20</P><P Name="name">C</P><P Name="chart">21</P></instance>'
        )
        release = "R2024a" if self.new else "R2015a"
        version = f"<mwcoreProperties><matlabRelease>{release}</matlabRelease></mwcoreProperties>"
        made = {"metadata/mwcoreProperties.xml": head + version, "[Content_Types].xml": head + "<Types/>"}
        stateflow = (
            '<Stateflow><machine id="20"><P Name="isLibrary">0</P><P Name="sfVersion">76014001.0005</P>'
            f"<Children>{targets}{{}}</Children></machine>{instance}</Stateflow>"
        )
        if not self.new:
            made[DIAGRAM] = (
                f'{head}<ModelInformation Version="1.0"><Model Name="known"><P Name="Version">8.5</P>'
                f"<ConfigurationSet>{config}</ConfigurationSet><System>"
                f'<P Name="Location">[2, 70, 1442, 800]</P><P Name="Open">on</P>'
                f"{system}</System></Model></ModelInformation>"
            )
            made["simulink/stateflow.xml"] = head + stateflow.format(self._chart())
            return made
        made[DIAGRAM] = (
            f'{head}<ModelInformation Version="1.0"><Model><P Name="Version">23.2</P>'
            '<System Ref="system_root"/></Model></ModelInformation>'
        )
        made["simulink/systems/system_root.xml"] = f"{head}<System>{system}</System>"
        made["simulink/systems/system_50.xml"] = f"{head}<System>{inside}</System>"
        made["simulink/configSet0.xml"] = f"{head}<ConfigSet>{config}</ConfigSet>"
        made["simulink/configSetInfo.xml"] = (
            f'{head}<ConfigSetInfo><ConfigSet PartName="/simulink/configSet0.xml" Active="true"/>'
            "</ConfigSetInfo>"
        )
        made["simulink/stateflow/machine.xml"] = head + stateflow.format('<chart Ref="chart_21"/>')
        made["simulink/stateflow/chart_21.xml"] = head + self._chart()
        return made


__all__ = ["ChartText", "Layout"]
