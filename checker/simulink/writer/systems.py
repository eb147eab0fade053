"""Block diagrams to be written into packages: blocks, the signals between them, and the blocks of charts."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import TypeAlias
from xml.etree.ElementTree import Element

from rovercheck.checker.simulink.writer.charts import WrittenChart, WrittenData, WrittenEvent, WrittenState
from rovercheck.checker.simulink.writer.elements import Values, below, made, put

Counts: TypeAlias = Mapping[str, int]
"""How many ports of each kind a block has."""
Parts: TypeAlias = dict[str, Element]
"""The systems of a package, by the names of their parts."""
TRIGGERS = {
    "FALLING_EDGE_EVENT": "falling", "EITHER_EDGE_EVENT": "either", "FUNCTION_CALL_EVENT": "function-call"
}  # fmt: skip


@dataclass(eq=False)
class WrittenBlock:
    """A block; its values are what stands in the file: only what is not as by default."""

    sid: str
    kind: str
    name: str
    ports: Counts = field(default_factory=dict)
    values: Values = field(default_factory=dict)
    inside: "WrittenSystem | WrittenChart | None" = None
    signals: Mapping[int, str] = field(default_factory=dict)


class WrittenSystem:
    """Blocks and signals; ``numbers`` gives the next number of a block, ``charts`` collects the charts."""

    def __init__(self, numbers: Callable[[], str], charts: list[WrittenChart], path: str = "") -> None:
        self.numbers, self.charts, self.path = numbers, charts, path
        self.blocks: list[WrittenBlock] = []
        self.lines: dict[tuple[str, str], list[str]] = {}

    def block(
        self,
        kind: str,
        name: str,
        ports: Counts | None = None,
        signals: Mapping[int, str] | None = None,
        **values: object,
    ) -> str:
        """A block; the answer is its number."""
        return self.add(WrittenBlock(self.numbers(), kind, name, ports or {}, values, None, signals or {}))

    def add(self, block: WrittenBlock) -> str:
        """A block that has its number already."""
        self.blocks.append(block)
        return block.sid

    def say(self, sid: str, **values: object) -> None:
        """Further values of a block that is there."""
        block = next(one for one in self.blocks if one.sid == sid)
        block.values = {**block.values, **values}

    def inport(self, name: str, number: int, **values: object) -> str:
        """An input of this system."""
        return self.add(WrittenBlock(self.numbers(), "Inport", name, {}, {**_port(number), **values}))

    def outport(self, name: str, number: int, **values: object) -> str:
        """An output of this system."""
        return self.add(WrittenBlock(self.numbers(), "Outport", name, {}, {**_port(number), **values}))

    def line(self, source: str, target: str) -> None:
        """A signal: ``"7"`` is port 1 of block 7, ``"7/2"`` port 2, ``"7#enable"`` its enable port."""
        block, _, number = source.partition("/")
        to, _, port = target.partition("/")
        end = target if "#" in target else f"{to}#in:{port or 1}"
        self.lines.setdefault((block, number or "1"), []).append(end)

    def subsystem(self, name: str, ins: int, outs: int, control: str = "") -> "tuple[str, WrittenSystem]":
        """A subsystem, perhaps one with a control port."""
        sid, inside = self.numbers(), WrittenSystem(self.numbers, self.charts, self._below(name))
        ports = {"in": ins, "out": outs} | ({control: 1} if control else {})
        return self.add(WrittenBlock(sid, "SubSystem", name, ports, {}, inside)), inside

    def chart(
        self, name: str, kind: str = "Chart", script: str = "", more: Values | None = None
    ) -> tuple[str, WrittenChart]:
        """The block of a chart or a MATLAB function; its ports are made of its data when it is written."""
        sid = self.numbers()
        chart = WrittenChart(self._below(name), len(self.charts) + 1, kind, script=script, more=more or {})
        self.charts.append(chart)
        return self.add(WrittenBlock(sid, "SubSystem", name, {}, {}, chart)), chart

    def simulink_function(self, chart: WrittenChart, label: str) -> "WrittenSystem":
        """A Simulink function of a chart with its arguments and results; its blocks are still to be drawn."""
        outs, _, call = label.rpartition("=")
        name, _, ins = call.partition("(")
        box = chart.function(label, inside={"simulink": {"isSimulinkFcn": 1, "blockName": name.strip()}})
        for scope, names in (("function input", ins), ("function output", outs)):
            for one in names.strip(" ()[]").replace(",", " ").split():
                chart.data(one, scope, "Inherit: Same as Simulink", holder=box)
        inside = WrittenSystem(self.numbers, self.charts, f"{chart.path}/{name.strip()}")
        inside.block("TriggerPort", "function", {}, {}, TriggerType="function-call")
        chart.functions[name.strip()] = inside
        return inside

    def atomic_subchart(
        self, chart: WrittenChart, label: str, holder: WrittenState | None = None, order: int = 0,
        binding: str = "",
    ) -> tuple[WrittenState, WrittenChart]:  # fmt: skip
        """A state of a chart whose content is a chart of its own."""
        name = label.partition("\n")[0]
        values = {"isComponent": 1, "blockName": name, "binding": binding or None}
        state = chart.state(label, holder, order, inside={"simulink": values})
        made = WrittenChart(f"{chart.path}/{name}", len(self.charts) + 1)
        made.language, made.saturates = chart.language, chart.saturates
        self.charts.append(made)
        return state, made

    def _below(self, name: str) -> str:
        own = name.replace("/", "//")
        return f"{self.path}/{own}" if self.path else own

    def count(self, kind: str) -> int:
        """How many blocks of a kind there are."""
        return sum(one.kind == kind for one in self.blocks)

    # --- as XML --------------------------------------------------------------------------------------------

    def element(self, parts: Parts | None, last: int) -> Element:
        """The system; ``parts`` collects those in it, and without ``parts`` they are written inline."""
        root = made("System", None, {
            "Location": "[-1, -7, 1537, 817]", "ZoomFactor": 100, "SIDHighWatermark": last
        })  # fmt: skip
        for number, block in enumerate(self.blocks):
            root.append(_block(block, number, parts, last))
        for number, ((sid, port), targets) in enumerate(self.lines.items()):
            line = below(root, "Line", {"ZOrder": number + 1, "Src": f"{sid}#out:{port}"})
            if len(targets) == 1:
                put(line, {"Dst": targets[0]})
                continue
            put(line, {"Points": "[20, 0]"})
            for order, target in enumerate(targets):
                below(line, "Branch", {"ZOrder": 100 + order, "Dst": target})
        return root


def _port(number: int) -> Mapping[str, object]:
    """The number of a port, which is not written for the first."""
    return {"Port": number} if number > 1 else {}


def _block(block: WrittenBlock, number: int, parts: Parts | None, last: int) -> Element:
    inside, ports, values = block.inside, block.ports, block.values
    if isinstance(inside, WrittenChart):
        inside, ports, values = _of_chart(block.sid, inside)
        values = {**values, **block.values}
    root = made("Block", {"BlockType": block.kind, "Name": block.name, "SID": block.sid})
    if parts is not None and ports:
        below(root, "PortCounts", None, **{kind: str(count) for kind, count in ports.items()})
    elif ports:
        control = [int("enable" in ports)] if ports.keys() & {"enable", "trigger"} else []
        counts = [ports.get("in", 0), ports.get("out", 0), *control, *[1] * ("trigger" in ports)]
        put(root, {"Ports": counts})
    put(root, {"Position": f"[{100 * number}, 50, {100 * number + 60}, 90]", "ZOrder": number + 1, **values})
    if block.signals:
        properties = below(root, "PortProperties")
        for index, name in block.signals.items():
            below(properties, "Port", {"Name": name}, Type="out", Index=str(index))
    if inside is not None and parts is None:
        root.append(inside.element(None, last))
    elif inside is not None and parts is not None:
        part = f"system_{block.sid.replace('::', '_')}"
        parts[part] = inside.element(parts, last)
        below(root, "System", None, Ref=part)
    return root


def _of_chart(sid: str, chart: WrittenChart) -> tuple[WrittenSystem, Counts, Values]:
    """What is in the block of a chart: ports by its data, its S-Function, and what belongs to that."""
    inner = WrittenSystem(str, [], chart.path)
    data = list(chart.of(WrittenData))
    ins = [one.name for one in data if one.scope == "INPUT_DATA"]
    outs = [one.name for one in data if one.scope == "OUTPUT_DATA"]
    events = [one for one in chart.of(WrittenEvent) if one.scope == "INPUT_EVENT"]
    outs += [f"{one.name}()" for one in chart.of(WrittenEvent) if one.scope == "OUTPUT_EVENT"]
    function, demux, terminator = f"{sid}::10", f"{sid}::11", f"{sid}::12"
    for number, name in enumerate(ins, 1):
        port = inner.add(WrittenBlock(f"{sid}::{19 + number}", "Inport", name, {}, _port(number)))
        inner.line(port, f"{function}/{number}")
    if events:
        trigger = {"TriggerType": TRIGGERS.get(events[0].trigger)}
        name = events[0].name if len(events) == 1 else " input events "
        values = {**trigger, "StatesWhenEnabling": "held", "ShowOutputPort": "on"}
        port = inner.add(WrittenBlock(f"{sid}::15", "TriggerPort", name, {}, values))
        inner.line(port, f"{function}/{len(ins) + 1}")
    inner.add(WrittenBlock(demux, "Demux", " Demux ", {"in": 1, "out": 1}, {"Outputs": 1}))
    counts = {"in": len(ins) + bool(events), "out": len(outs) + 1}
    inner.add(WrittenBlock(function, "S-Function", " SFunction ", counts, {
        "Tag": f"Stateflow S-Function {chart.number}", "FunctionName": "sf_sfun",
        "PortCounts": f"[{counts['in']} {counts['out']}]", "SFunctionDeploymentMode": "off",
        "EnableBusSupport": "on", "SFcnIsStateOwnerBlock": "off",
    }, None, dict(enumerate(outs, 2))))  # fmt: skip
    inner.add(WrittenBlock(terminator, "Terminator", " Terminator "))
    for number, name in enumerate(outs, 1):
        port = inner.add(WrittenBlock(f"{sid}::{59 + number}", "Outport", name, {}, _port(number)))
        inner.line(f"{function}/{number + 1}", port)
    for number, (name, system) in enumerate(chart.functions.items()):
        counts = {"in": system.count("Inport"), "out": system.count("Outport"), "trigger": 1}
        inner.add(WrittenBlock(f"{sid}::{100 + number}", "SubSystem", name, counts, {}, system))
    inner.line(demux, terminator)
    inner.line(function, demux)
    values = {
        "ErrorFcn": "Stateflow.Translate.translate", "PermitHierarchicalResolution": "ExplicitOnly",
        "TreatAsAtomicUnit": "on", "SFBlockType": chart.kind,
    }  # fmt: skip
    ports = {kind: count for kind, count in (("in", len(ins)), ("out", len(outs))) if count}
    return inner, ports | ({"trigger": 1} if events else {}), values


__all__ = ["Counts", "Parts", "WrittenBlock", "WrittenSystem"]
