"""The six packages of ``examples/simulink``, made anew: each model is drawn as its README.md tells."""

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

from rovercheck.checker.simulink.writer.charts import WrittenChart, WrittenJunction, WrittenState
from rovercheck.checker.simulink.writer.dictionaries import dictionary
from rovercheck.checker.simulink.writer.packages import Layout, WrittenModel
from rovercheck.checker.simulink.writer.systems import WrittenSystem

EXAMPLES = Path(__file__).parents[2] / "examples" / "simulink"


def _around(
    system: WrittenSystem, ins: Mapping[str, str], outs: Sequence[str]
) -> tuple[list[str], list[str]]:
    """Ports of a system: inputs with their types, and outputs."""
    inputs = [
        system.inport(name, number, OutDataTypeStr=kind) for number, (name, kind) in enumerate(ins.items(), 1)
    ]
    return inputs, [system.outport(name, number) for number, name in enumerate(outs, 1)]


def _wired(system: WrittenSystem, block: str, ins: Sequence[str], outs: Sequence[str]) -> None:
    """Signals from inputs of a system to the block, and from it to the outputs."""
    for number, sid in enumerate(ins, 1):
        system.line(sid, f"{block}/{number}")
    for number, sid in enumerate(outs, 1):
        system.line(f"{block}/{number}", sid)


def lamp(layout: Layout = "parts") -> WrittenModel:
    """A flat chart."""
    model = WrittenModel("lamp", layout=layout)
    ins, outs = _around(model.root, {"button": "boolean"}, ["level"])
    block, chart = model.root.chart("Lamp")
    off = chart.state("Off\nen: level = uint8(0);")
    dim = chart.state("Dim\nentry:\n  level = uint8(1);")
    bright = chart.state("Bright\nen:\nlevel = uint8(2); % full power")
    chart.data("button", "input")
    chart.data("level", "output", "uint8")
    chart.transition(None, off)
    chart.transition(off, dim, "[button]")
    chart.transition(dim, off, "[after(3, sec)]", 2)
    chart.transition(dim, bright, "[button]")
    chart.transition(bright, off, "[~button && after(0.5, sec) || ...\n after(5, sec)]")
    _wired(model.root, block, ins, outs)
    return model


def _history(state: WrittenState) -> int:
    """The SSID of the history junction of a state."""
    return next(one.ssid for one in state.children if isinstance(one, WrittenJunction))


def microwave(layout: Layout = "parts") -> WrittenModel:
    """Levels, history and a junction."""
    model = WrittenModel("microwave", release="R2023b", layout=layout)
    kinds = {"door": "boolean", "start": "boolean", "minutes": "uint8"}
    ins, outs = _around(model.root, kinds, ["heating", "left", "bell"])
    block, chart = model.root.chart("Oven")
    idle = chart.state("Idle\nen: heating = false;")
    cooking = chart.state("Cooking\ndu: left = left - 1;\nex: heating = false;")
    chart.junction(cooking, history=True)
    heat = chart.state("Heat/heating = true;", cooking)
    rest = chart.state("Rest\nen:\nheating = false;", cooking)
    paused = chart.state("Paused")
    choice = chart.junction()
    chart.frames = {
        idle.ssid: (160, 60, 160, 66), choice.ssid: (430, 190, 14, 14), cooking.ssid: (60, 300, 540, 240),
        heat.ssid: (110, 420, 130, 50), rest.ssid: (430, 420, 130, 66), paused.ssid: (260, 640, 110, 50),
        _history(cooking): (100, 500, 14, 14),
    }  # fmt: skip
    for name, kind in {"door": "", "start": "", "minutes": "uint8"}.items():
        chart.data(name, "input", kind)
    for name, kind in {"heating": "boolean", "left": "uint16", "bell": "boolean"}.items():
        chart.data(name, "output", kind)
    chart.transition(None, idle)
    chart.transition(idle, choice, "[start && ~door]")
    chart.transition(choice, cooking, "{left = uint16(5); bell = false;}", 2)
    chart.transition(choice, cooking, "[minutes > 0]{left = uint16(minutes) * 7; bell = false;}")
    chart.transition(cooking, paused, "[door]")
    chart.transition(cooking, idle, "[left == 0]/bell = true;", 2)
    chart.transition(paused, cooking, "[~door]")
    chart.transition(None, heat)
    chart.transition(heat, rest, "[after(0.5, sec)]")
    chart.transition(rest, heat, "[after(3, tick)]")
    _wired(model.root, block, ins, outs)
    return model


def crossing(layout: Layout = "parts") -> WrittenModel:
    """Regions, events that are sent to one, and an enumeration of a dictionary."""
    model = WrittenModel("crossing", "0.02", layout=layout, dictionary="crossing.sldd")
    kinds = {"request": "boolean", "fault": "boolean"}
    ins, outs = _around(model.root, kinds, ["cars", "walk", "count"])
    block, chart = model.root.chart("Crossing")
    chart.parallel = True
    walkers = chart.state("Walkers", order=3)
    watch = chart.state("Watch", order=1, subchart=True)
    cars = chart.state("Cars", order=2, subchart=True)
    calm, asked = chart.state("Calm", watch), chart.state("Asked", watch)
    green = chart.state("Green\nen: cars = LampColour.GREEN;", cars)
    amber = chart.state("Amber\nen: cars = AMBER;", cars)
    red = chart.state("Red\nen: cars = RED;", cars)
    wait = chart.state("Wait\nen: walk = false;", walkers)
    cross = chart.state("Cross\nen: walk = true;", walkers)
    chart.data("request", "input")
    chart.data("fault", "input")
    chart.data("cars", "output", "Enum: LampColour")
    chart.data("walk", "output", "boolean")
    chart.data("count", "output", "uint8", "253")
    chart.event("GO")
    chart.event("HALT")
    for first in (calm, green, wait):
        chart.transition(None, first)
    chart.transition(calm, asked, "[hasChanged(request) && request]\n{\ncount = count + 1;\n}")
    chart.transition(asked, calm, "[duration(~request) >= 0.1]{send(HALT, Cars);}")
    chart.transition(green, amber, "HALT")
    chart.transition(green, red, "[fault]", 2)
    chart.transition(amber, red, "[after(200, msec)]")
    chart.transition(red, green, "GO[~fault]")
    chart.transition(wait, cross, "[in(Cars.Red)]")
    chart.transition(cross, wait, "[after(0.5, sec)]{send(GO, Cars);}")
    _wired(model.root, block, ins, outs)
    return model


def smoother(layout: Layout = "single") -> WrittenModel:
    """The C action language, a graphical function, and one part for all charts."""
    model = WrittenModel("smoother", "0.01", "R2018a", layout)
    ins, outs = _around(model.root, {"raw": "int16", "mode": "uint8"}, ["mean", "flags", "trace"])
    block, chart = model.root.chart("Smoother")
    chart.language, chart.explicit = "C with bit operations", False
    idle = chart.state("Idle/\nen: flags = 0;")
    busy = chart.state(
        "Busy/\nduring: mean = quot(mean + raw, 2); /* towards zero */\nflags = (mode >> 1) | (flags & 0x80);"
    )
    first, second = chart.junction(), chart.junction()
    function = chart.function("q = quot(a, b)")
    start, end = chart.junction(function), chart.junction(function)
    for name, scope in {"a": "function input", "b": "function input", "q": "function output"}.items():
        chart.data(name, scope, "int16", holder=function)
    chart.transition(None, start, holder=function)
    chart.transition(start, end, "[b == 0] {q = 0;}", holder=function)
    chart.transition(start, end, "{q = a / b;}", 2, holder=function)
    chart.data("raw", "input", "int16")
    chart.data("mode", "input", "uint8")
    for name, kind in {"mean": "int16", "flags": "uint8", "trace": "int32"}.items():
        chart.data(name, "output", kind, "0")
    chart.transition(None, idle)
    chart.transition(idle, busy, "[mode & 0x01]")
    chart.transition(busy, first, "[mode & 0x02] {trace += 1;}")
    chart.transition(first, idle, "[raw < 0] {trace += 10;} / trace += 100;")
    chart.transition(first, second, "[raw > 100] {trace++;}", 2)
    chart.transition(second, idle, "[mode & 0x08]")
    chart.transition(busy, idle, "[!(mode & 0x01)]", 2)
    _wired(model.root, block, ins, outs)
    return model


def tank(layout: Layout = "parts") -> WrittenModel:
    """Two charts, a MATLAB function, a bus, an enabled subsystem, Goto and From, and a delay."""
    model = WrittenModel("tank", "0.1", "R2025b", layout, "tank.sldd")
    root = model.root
    kinds = {"probe": "Bus: Probe", "clock_ms": "uint32", "ready": "boolean", "hold": "boolean"}
    ins, outs = _around(root, kinds, ["status", "flags", "open", "strokes", "age"])
    probe, now, ready, hold = ins
    valve, inside = root.subsystem("Actuation", 2, 2, "enable")
    select = root.block(
        "BusSelector", "Bus\nSelector", {"in": 1, "out": 2}, {1: "<level>", 2: "<taken_ms>"},
        OutputSignals="level,taken_ms",
    )  # fmt: skip
    collect, function = root.chart("Collect", "MATLAB Function", _script("collect"))
    for name, scope in {"status": "input", "flags": "output", "ready": "input"}.items():
        function.data(name, scope)
    monitor, chart = root.chart("Monitor")
    delay = root.block("UnitDelay", "Unit Delay", InitialCondition="false", SampleTime="-1")
    to, back = root.block("Goto", "Goto", GotoTag="rdy"), root.block("From", "From", GotoTag="rdy")
    inverse = root.block(
        "Logic", "Logical\nOperator", {"in": 1, "out": 1}, Operator="NOT", AllPortsSameDT="off",
        OutDataTypeStr="boolean",
    )  # fmt: skip
    _monitor(chart)
    _actuation(inside)
    for source, target in (
        (probe, select), (select, monitor), (f"{select}/2", f"{monitor}/2"), (select, f"{valve}/2"),
        (now, f"{monitor}/3"), (ready, to), (monitor, collect), (back, f"{collect}/2"), (collect, valve),
        (hold, inverse), (inverse, f"{valve}#enable"), (valve, delay), (delay, f"{monitor}/4"),
        (monitor, outs[0]), (collect, outs[1]), (valve, outs[2]), (f"{valve}/2", outs[3]),
        (f"{monitor}/2", outs[4]),
    ):  # fmt: skip
        root.line(source, target)
    return model


def _monitor(chart: WrittenChart) -> None:
    age = "du: age = clock_ms - taken_ms;"
    ok = chart.state("Ok\nen: status = LevelStatus.LEVEL_OK;\n" + age)
    low = chart.state("Low\nen: status = LevelStatus.LEVEL_LOW;\n" + age)
    lost = chart.state("Lost\nen, du: status = LevelStatus.LEVEL_LOST;\n" + age)
    function = chart.function("y = isLost(now, stamp)", script=_script("isLost"))
    for name, scope in {"now": "function input", "stamp": "function input", "y": "function output"}.items():
        chart.data(name, scope, holder=function)
    for name in ("level", "taken_ms", "clock_ms", "open"):
        chart.data(name, "input")
    chart.data("status", "output", "Enum: LevelStatus")
    chart.data("age", "output", "uint32")
    chart.transition(None, ok)
    chart.transition(ok, lost, "[isLost(clock_ms, taken_ms)]")
    chart.transition(ok, low, "[level < 10 && ~open]", 2)
    chart.transition(low, lost, "[isLost(clock_ms, taken_ms)]")
    chart.transition(low, ok, "[duration(level >= 12.5) > 0.5]", 2)
    chart.transition(lost, ok, "[~isLost(clock_ms, taken_ms)]")


def _actuation(inside: WrittenSystem) -> None:
    ins = [inside.inport("flags", 1), inside.inport("level", 2)]
    outs = [inside.outport("open", 1), inside.outport("strokes", 2)]
    inside.block("EnablePort", "Enable")
    block, chart = inside.chart("Valve")
    closed = chart.state("Closed\nen: open = false;")
    opened = chart.state("Opened\nen: open = true; strokes = strokes + 1;")
    chart.data("flags", "input")
    chart.data("level", "input")
    chart.data("open", "output", "boolean")
    chart.data("strokes", "output", "uint8", "0")
    chart.transition(None, closed)
    label = "[bitand(flags, uint32(1)) ~= 0 && bitand(flags, uint32(8)) == 0]"
    chart.transition(closed, opened, label)
    chart.transition(opened, closed, "[after(0.4, sec) || level > 20]")
    _wired(inside, block, ins, outs)


def press(layout: Layout = "parts") -> WrittenModel:
    """The border of a subchart, an inner transition, events for all, memory and a vector."""
    model = WrittenModel("press", "0.05", layout=layout)
    root = model.root
    ins = [
        root.inport("cmd", 1, OutDataTypeStr="uint8"),
        root.inport("force", 2, OutDataTypeStr="double", PortDimensions="[1 3]"),
    ]
    outs = [root.outport(name, number) for number, name in enumerate(["phase", "total", "alarms"], 1)]
    block, chart = root.chart("Press", more={"executeAtInitialization": 1})
    ready = chart.state("Ready\nen: phase = uint8(0); busy = false;")
    work = chart.state(
        "Work\nen: phase = uint8(1);\ndu: total = acc(force);\non HIT: alarms = alarms + 1;", subchart=True
    )
    fault = chart.state("Fault\nen:\n  phase = uint8(99);\n  busy = false;")
    approach = chart.state("Approach\nen: phase = uint8(10);", work)
    pressing = chart.state("Press\nen: phase = uint8(11);", work)
    retract = chart.state("Retract\nen: phase = uint8(12);\nex: phase = phase + 50;", work)
    function = chart.function("y = acc(f)", script=_script("acc"))
    chart.data("f", "function input", holder=function)
    chart.data("y", "function output", holder=function)
    chart.data("cmd", "input", "uint8")
    chart.data("force", "input", "double", size="[1 3]")
    chart.data("phase", "output", "uint8")
    chart.data("total", "output", "double")
    chart.data("alarms", "output", "uint8", "0")
    chart.data("busy", "local", "boolean", "false")
    chart.event("FAIL")
    chart.event("HIT")
    chart.transition(None, ready)
    chart.transition(None, approach)
    chart.crossing(ready, pressing, "[cmd == 2]", 1, work)
    chart.transition(ready, work, "[cmd == 1]", 2)
    chart.transition(work, fault, "FAIL[cmd ~= 7]")
    chart.transition(work, ready, "[cmd == 9]", 2)
    chart.transition(work, pressing, "[cmd == 3]", inner=True)
    hit = "[force(1) >= 4 && ~busy]{busy = true; send(HIT, Work); busy = false;}"
    chart.transition(approach, pressing, hit)
    fail = "[after(4, tick) && ~busy]{busy = true; FAIL; alarms = alarms + 100; busy = false;}"
    chart.transition(pressing, retract, fail)
    chart.transition(retract, approach, "[temporalCount(tick) >= 2]")
    chart.transition(fault, ready, "[cmd == 0]")
    _wired(root, block, ins, outs)
    return model


def _script(name: str) -> str:
    return (Path(__file__).parent / "scripts" / f"{name}.m").read_text(encoding="utf-8")


SAMPLES: Mapping[str, Callable[[], WrittenModel]] = {
    "1_lamp": lamp, "2_microwave": microwave, "3_crossing": crossing, "4_smoother": smoother, "5_tank": tank,
    "6_press": press,
}  # fmt: skip


def package_of(sample: str) -> Path:
    """The package of a sample as it is among the examples."""
    return EXAMPLES / sample / f"{sample.partition('_')[2]}.slx"


def write_beside(sample: str, folder: Path) -> None:
    """The files beside a sample."""
    if sample == "3_crossing":
        dictionary(folder / "crossing.sldd", {"LampColour": {"RED": 0, "AMBER": 1, "GREEN": 2}})
    if sample == "5_tank":
        fields = [("level", "single", "1.0"), ("taken_ms", "uint32", "1.0")]
        dictionary(folder / "tank.sldd", buses={"Probe": fields})
        (folder / "LevelStatus.m").write_bytes((EXAMPLES / sample / "LevelStatus.m").read_bytes())


__all__ = ["EXAMPLES", "SAMPLES", "package_of", "write_beside"]
