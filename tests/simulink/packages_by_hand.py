"""Packages written by hand as Simulink writes them, and the writer of this project does not."""

from collections.abc import Mapping, Sequence
from pathlib import Path

from rovercheck.checker.drawn.faults import DrawnFault
from rovercheck.checker.drawn.interpret.diagram import ModelRunner
from rovercheck.checker.drawn.lower.diagram import lowered_model
from rovercheck.checker.drawn.lower.symbols import NotLowered
from rovercheck.checker.drawn.records import DrawnModel
from rovercheck.checker.simulink.model import read_model
from rovercheck.checker.simulink.writer.packages import DIAGRAM, packed
from tests.drawn.two_readings import Row, compared


def block(kind: str, name: str, sid: int, inside: str = "", **values: object) -> str:
    """A block with its parameters, and perhaps with what else stands in it."""
    written = "".join(f'<P Name="{key}">{value}</P>' for key, value in values.items())
    return f'<Block BlockType="{kind}" Name="{name}" SID="{sid}">{written}{inside}</Block>'


def ports(sid: int, ins: str = "ab", outs: str = "y", kind: str = "int8", to: Sequence[int] = ()) -> str:
    """Inports of a type, from 1 on, and Outports, from 90 on, connected with the ports of a block.

    ``to`` are the numbers of the input ports, where they are not 1, 2, 3...
    """
    made = [
        block("Inport", name, number, "", **_port(number), OutDataTypeStr=kind)
        + signal(f"{number}#out:1", f"{sid}#in:{port}")
        for number, (name, port) in enumerate(zip(ins, to or range(1, 99), strict=False), 1)
    ]
    made += [
        block("Outport", name, 89 + number, "", **_port(number))
        + signal(f"{sid}#out:{number}", f"{89 + number}#in:1")
        for number, name in enumerate(outs, 1)
    ]
    return "".join(made)


def _port(number: int) -> dict[str, object]:
    return {"Port": number} if number > 1 else {}


def signal(source: str, target: str) -> str:
    """A signal without branches."""
    return f'<Line><P Name="Src">{source}</P><P Name="Dst">{target}</P></Line>'


def datum(ssid: int, name: str, scope: str, kind: str = "int8", initial: str = "") -> str:
    """A datum of a chart."""
    return (
        f'<data SSID="{ssid}" name="{name}"><P Name="scope">{scope}</P><props>'
        f'<P Name="initialValue">{initial}</P></props><P Name="dataType">{kind}</P></data>'
    )


def chart(label: str, data: str) -> str:
    """The part of the file for one chart of one state, of which the block is called C."""
    return (
        '<Stateflow><machine id="1"><Children><chart id="2"><P Name="actionLanguage">2</P><Children>'
        f'<state SSID="1"><P Name="labelString">{label}</P><P Name="type">OR_STATE</P></state>'
        '<transition SSID="2"><dst><P Name="SSID">1</P></dst></transition>'
        f"{data}</Children></chart></Children></machine>"
        '<instance id="3"><P Name="name">C</P><P Name="chart">2</P></instance></Stateflow>'
    )


def model(
    system: str, folder: Path, more: str = "", charts: str = "", files: Mapping[str, str] | None = None
) -> DrawnModel:
    """The model of a system in one part; ``more`` stands before it, ``files`` are beside it."""
    text = f"<ModelInformation><Model>{more}<System>{system}</System></Model>{charts}</ModelInformation>"
    packed(folder / "hand.slx", {DIAGRAM: text})
    for name, said in (files or {}).items():
        (folder / name).write_text(said, encoding="utf-8")
    return read_model(folder / "hand.slx", [folder / name for name in files or {}])


def run(read: DrawnModel, rows: Sequence[Row]) -> list[tuple[float, ...]]:
    """The outputs in each row, the same in both readings."""
    found = compared(read, rows)
    assert (found.rows, found.refused, found.fault) == (len(rows), "", ""), found
    runner = ModelRunner(read)
    return [tuple(runner.step(row).values()) for row in rows]


def refused(read: DrawnModel) -> tuple[str, str]:
    """What the direct interpreter says of a model, and what the lowering says."""
    try:
        ModelRunner(read).step({})
        return "", ""
    except DrawnFault as error:
        direct = str(error)
    try:
        lowered_model(read, "hand.slx")
    except NotLowered as error:
        return direct, str(error)
    return direct, ""
