"""Blocks around charts: models by hand."""

from collections.abc import Iterator
from math import floor

from rovercheck.checker.simulink.writer.packages import WrittenModel
from rovercheck.checker.simulink.writer.systems import WrittenSystem
from tests.simulink.by_hand.models import ByHand, Given, Told, held, tell


class Diagram:
    """A model with the input ``u``, of which the blocks are added one after another."""

    def __init__(self, kind: str = "int8") -> None:
        self.model = WrittenModel("one", step="0.1")
        self.root = self.model.root
        self.u = self.root.inport("u", 1, OutDataTypeStr=kind)

    def add(self, kind: str, *inputs: str, within: WrittenSystem | None = None, **values: object) -> str:
        """A block of a kind, and the signals to its inputs."""
        system = within or self.root
        made = system.block(kind, f"{kind} {len(system.blocks)}", {"in": len(inputs), "out": 1}, {}, **values)
        for number, source in enumerate(inputs, 1):
            system.line(source, f"{made}/{number}")
        return made

    def constant(self, value: str) -> str:
        """A constant."""
        return self.add("Constant", Value=value)

    def given(self, *sources: str) -> WrittenModel:
        """The model, whose outputs these signals are."""
        for number, source in enumerate(sources, 1):
            self.root.line(source, self.root.outport(f"y{number}", number))
        return self.model


def _wrapped(value: int) -> int:
    return (value + 128) % 256 - 128


def _arithmetic() -> WrittenModel:
    """Sums, products and limits of integers, which wrap or stop as each block says."""
    d = Diagram()
    three, half = d.constant("int8(3)"), d.constant("0.5")
    total = d.add("Sum", d.u, three, Inputs="|-+")
    stops = d.add("Gain", d.u, Gain="3", SaturateOnIntegerOverflow="on")
    most = d.add("MinMax", d.u, three, Inputs="2", Function="max")
    inside = d.add("Saturate", d.u, LowerLimit="-4", UpperLimit="4")
    parts = d.add("Product", d.u, three, Inputs="*/")
    real = d.add("Product", d.add("DataTypeConversion", d.u, OutDataTypeStr="double"), half)
    down = d.add("DataTypeConversion", real, OutDataTypeStr="uint8")
    near = d.add(
        "DataTypeConversion", real, OutDataTypeStr="int8", RndMeth="Nearest", SaturateOnIntegerOverflow="on"
    )
    return d.given(total, stops, most, inside, d.add("Abs", d.u), parts, down, near)


def _arithmetic_by_hand(given: Given) -> Iterator[tuple[float, ...]]:
    for u in given:
        half = floor(u / 2)
        yield (
            _wrapped(3 - u), held(3 * u, -128, 127), max(u, 3), held(u, -4, 4), _wrapped(abs(u)), u // 3,
            half % 256, half + u % 2,
        )  # fmt: skip


def _decisions() -> WrittenModel:
    """Comparisons, logic and switches, with and without what they say by default."""
    d = Diagram()
    one, two = d.constant("int8(1)"), d.constant("int8(2)")
    least = d.add("RelationalOperator", d.u, one)
    more = d.add("RelationalOperator", d.u, two, Operator=">")
    both = d.add("Logic", least, d.u)
    odd = d.add("Logic", least, more, d.u, Operator="XOR", Inputs="3")
    none = d.add("Logic", least, more, Operator="NOR")
    other = d.add("Logic", d.u, Operator="NOT")
    default = d.add("Switch", one, d.u, two)
    above = d.add("Switch", d.u, d.u, two, Criteria="u2 > Threshold", Threshold="1")
    either = d.add("Switch", two, odd, d.u, Criteria="u2 ~= 0")
    library = d.add(
        "Reference", d.u, SourceBlock="simulink/Logic and Bit&#xA;Operations/Compare&#xA;To Constant",
        SourceType="Compare To Constant", relop="==", const="2",
    )  # fmt: skip
    return d.given(least, more, both, odd, none, other, default, above, either, library)


def _decisions_by_hand(given: Given) -> Iterator[tuple[float, ...]]:
    for u in given:
        least, more = u <= 1, u > 2
        odd = (least + more + (u != 0)) % 2
        yield (
            least, more, least and u != 0, odd, not (least or more), u == 0, 1 if u >= 0 else 2,
            u if u > 1 else 2, 2 if odd else u, u == 2,
        )  # fmt: skip


def _memories() -> WrittenModel:
    """Loops through delays, which have the type of what comes in, before what feeds them in the file."""
    d = Diagram()
    wide = d.root.block("Sum", "wide", {"in": 2, "out": 1}, {}, Inputs="+-")
    begins = {"InitialCondition": "int8(5)", "Priority": "1"}
    delay = d.root.block("UnitDelay", "delay", {"in": 1, "out": 1}, {}, **begins)
    memory = d.root.block("Memory", "memory", {"in": 1, "out": 1}, {})
    for source, target in ((delay, f"{wide}/1"), (memory, f"{wide}/2"), (wide, delay), (d.u, memory)):
        d.root.line(source, target)
    times, function = d.root.chart("F", "MATLAB Function", "function y = f(x)\ny = x * 100;\nend\n")
    function.data("x", "input")
    function.data("y", "output")
    d.root.line(memory, times)
    return d.given(wide, delay, memory, times, d.add("Sum", times, times))


def _memories_by_hand(given: Given) -> Iterator[tuple[float, ...]]:
    delay, memory = 5, 0
    for u in given:
        wide = _wrapped(delay - memory)
        times = held(memory * 100, -128, 127)
        yield wide, delay, memory, times, _wrapped(2 * times)
        delay, memory = wide, u


def _vectors() -> WrittenModel:
    """Vectors of signals: joined, chosen from and taken apart, and one that a chart is given."""
    d = Diagram()
    joined = d.add("Mux", d.u, d.constant("int8(4)"), d.add("UnitDelay", d.u), Inputs="3")
    some = d.add("Selector", joined, Indices="[3 1]", InputPortWidth="3")
    apart = d.root.block("Demux", "apart", {"in": 1, "out": 2}, {}, Outputs="2")
    d.root.line(some, apart)
    block, chart = d.root.chart("C")
    chart.data("v", "input", "int8", size="3")
    chart.data("y", "output", "int8", size="[1 2]")
    chart.data("m", "local", "int8", "[1 2; 3 4]", "[2 2]")
    chart.transition(None, chart.state("A\nen, du: y(1) = v(3, 1) + m(2, 1); y(end) = sum(v); m(2, :) = y;"))
    d.root.line(joined, block)
    ends = d.root.block("Demux", "ends", {"in": 1, "out": 2}, {}, Outputs="2")
    d.root.line(block, ends)
    script = "function [y, z] = f(x)\ny = x(1) * 2 + x(end);\nz = [x(2) y];\nend\n"
    total, function = d.root.chart("F", "MATLAB Function", script)
    function.data("x", "input", "int8")
    function.data("y", "output")
    function.data("z", "output")
    d.root.line(joined, total)
    both = d.root.block("Demux", "both", {"in": 1, "out": 2}, {}, Outputs="2")
    d.root.line(f"{total}/2", both)
    return d.given(apart, f"{apart}/2", ends, f"{ends}/2", total, f"{both}/2")


def _vectors_by_hand(given: Given) -> Iterator[tuple[float, ...]]:
    before, m = 0, 3
    for u in given:
        m = before + m
        last = 2 * u + before
        yield before, u, m, u + 4 + before, last, last
        before = u


def _part(d: Diagram, control: str, number: int, **port: object) -> str:
    """A subsystem under control that adds up u and a number; its delay is frozen with it."""
    block, inside = d.root.subsystem(f"Part {number}", 1, 1, control)
    inside.block("EnablePort" if control == "enable" else "TriggerPort", "Control", {}, {}, **port)
    add = inside.block("Sum", "add", {"in": 3, "out": 1}, {}, Inputs="+++")
    delay = inside.block("UnitDelay", "delay", {"in": 1, "out": 1}, {})
    by = inside.block("Constant", "by", {"out": 1}, {}, Value=f"int8({number})")
    for place, source in enumerate((inside.inport("i", 1), by, delay), 1):
        inside.line(source, f"{add}/{place}")
    inside.line(add, delay)
    return block


def _out_of(d: Diagram, block: str, **values: object) -> str:
    """The output of such a subsystem."""
    inside = next(one.inside for one in d.root.blocks if one.sid == block)
    assert isinstance(inside, WrittenSystem)
    add = next(one.sid for one in inside.blocks if one.name == "add")
    inside.line(add, inside.outport("o", 1, **values))
    d.root.line(d.u, block)
    return block


def _merged() -> WrittenModel:
    """Subsystems that are enabled, one of which gives its first value while it is not, and a merge of two."""
    d = Diagram()
    up, down = (d.add("RelationalOperator", d.u, d.constant("int8(1)"), Operator=sign) for sign in (">", "<"))
    first, second = (_out_of(d, _part(d, "enable", number)) for number in (1, 2))
    third = _out_of(d, _part(d, "enable", 3), OutputWhenDisabled="reset", InitialOutput="int8(9)")
    for source, target in ((up, first), (down, second), (up, third)):
        d.root.line(source, f"{target}#enable")
    return d.given(d.add("Merge", first, second, Inputs="2"), third)


def _merged_by_hand(given: Given) -> Iterator[tuple[float, ...]]:
    sums, merged = {1: 0, 2: 0, 3: 0}, 0
    for u in given:
        for number, on in ((1, u > 1), (2, u < 1)):
            if on:
                merged = sums[number] = _wrapped(sums[number] + u + number)
        if u > 1:
            sums[3] = _wrapped(sums[3] + u + 3)
        yield merged, sums[3] if u > 1 else 9


def _edges() -> WrittenModel:
    """Subsystems that a signal triggers where it rises, falls, or does either."""
    d = Diagram()
    kinds: tuple[dict[str, object], ...] = ({}, {"TriggerType": "falling"}, {"TriggerType": "either"})
    parts = [_out_of(d, _part(d, "trigger", number, **kind)) for number, kind in enumerate(kinds, 1)]
    for one in parts:
        d.root.line(d.u, f"{one}#trigger")
    return d.given(*parts)


def _edges_by_hand(given: Given) -> Iterator[tuple[float, ...]]:
    """In the first step nothing rises or falls."""
    sums, before = [0, 0, 0], None
    for u in given:
        if before is not None:
            rises, falls = before <= 0 < u, before > 0 >= u
            for number, runs in enumerate((rises, falls, rises or falls), 1):
                sums[number - 1] = _wrapped(sums[number - 1] + u + number) if runs else sums[number - 1]
        before = u
        yield tuple(sums)


def _grouped() -> WrittenModel:
    """Groups within groups, wires without ink, blocks that change nothing, and signals that lead nowhere."""
    d = Diagram()
    outer, inside = d.root.subsystem("Outer\n/ group", 1, 1)
    inner, within = inside.subsystem("Inner", 1, 1)
    same = d.add("ZeroOrderHold", within.inport("i", 1), within=within)
    twice = d.add("Gain", d.add("RateTransition", same, within=within), within=within, Gain="2")
    within.line(twice, within.outport("o", 1))
    inside.line(inside.inport("i", 1), inner)
    total = d.add("Sum", inner, inner, d.add("Ground", within=inside), within=inside, Inputs="+++")
    inside.line(total, inside.outport("o", 1))
    d.root.line(d.u, outer)
    d.root.block("Goto", "to", {"in": 1}, {}, GotoTag="A")
    d.root.line(outer, d.root.blocks[-1].sid)
    source = d.root.block("From", "from", {"out": 1})
    for kind in ("Scope", "Display", "Terminator"):
        d.root.line(source, d.root.block(kind, kind, {"in": 1}))
    d.root.block("Gain", "alone", {"in": 1, "out": 1}, {}, Gain="5")
    return d.given(source, outer)


def _grouped_by_hand(given: Given) -> Iterator[tuple[float, ...]]:
    for u in given:
        total = _wrapped(4 * u)
        yield total, total


def _raised() -> WrittenModel:
    """An event of a chart to other blocks, which changes its signal once a step."""
    d = Diagram()
    block, chart = d.root.chart("C")
    chart.data("u", "input", "int8")
    chart.data("n", "output", "int8")
    chart.event("OUT", "OUTPUT_EVENT", "EITHER_EDGE_EVENT")
    a, b = chart.state("A\nen: n = int8(1);"), chart.state("B\nen: n = int8(2);\nex: OUT;")
    chart.transition(None, a)
    chart.transition(a, b, "[u == 1]{OUT;}", 1)
    chart.transition(b, a, "[u == 2]")
    other, seen = d.root.chart("D")
    seen.data("t", "output", "uint32")
    seen.event("IN", "INPUT_EVENT", "EITHER_EDGE_EVENT")
    seen.transition(None, seen.state(f"S\nen: {tell(1)}\ndu: {tell(2)}\non IN: {tell(3)}"))
    d.root.line(d.u, block)
    d.root.line(f"{block}/2", f"{other}#trigger")
    return d.given(block, other, f"{block}/2")


def _raised_by_hand(given: Given) -> Iterator[tuple[float, ...]]:
    say, state, signal, seen = Told(), "", 0, False
    for u in given:
        changes = (state, u) in (("A", 1), ("B", 2))
        state = "A" if not state or (state, u) == ("B", 2) else "B" if (state, u) == ("A", 1) else state
        if changes:
            say(*((2, 3) if seen else (1,)))
            signal, seen = 1 - signal, True
        yield (1 if state == "A" else 2), say.t, signal


def _filtered() -> WrittenModel:
    """Real numbers with a few values: a difference of delays, compared with a threshold by a chart."""
    d = Diagram()
    real = d.add("DataTypeConversion", d.u, OutDataTypeStr="double")
    quarter = d.add("Gain", real, Gain="0.25")
    before = d.add("UnitDelay", quarter, InitialCondition="1.5")
    change = d.add("Sum", quarter, before, Inputs="+-")
    block, chart = d.root.chart("C")
    chart.data("x", "input", "double")
    chart.data("n", "output", "uint8")
    a, b = chart.state("A"), chart.state("B\nen: n = mod(n + 1, 100);")
    chart.transition(None, a)
    chart.transition(a, b, "[x >= 0.5]")
    chart.transition(b, a, "[x < -0.25]")
    d.root.line(change, block)
    return d.given(block, d.add("RelationalOperator", change, d.constant("0"), Operator="~="))


def _filtered_by_hand(given: Given) -> Iterator[tuple[float, ...]]:
    state, n, before = "", 0, 6
    for u in given:
        change, before = u - before, u
        if not state or (state == "B" and change < -1):
            state = "A"
        elif state == "A" and change >= 2:
            state, n = "B", (n + 1) % 100
        yield n, change != 0


DIAGRAMS = (
    ByHand("arithmetic", _arithmetic, _arithmetic_by_hand, (-128, -43, -7, -2, 0, 1, 3, 4, 5, 100, 127)),
    ByHand("decisions", _decisions, _decisions_by_hand, (-1, 0, 1, 2, 3)),
    ByHand("memories", _memories, _memories_by_hand, (-100, -1, 0, 1, 2, 77)),
    ByHand("vectors", _vectors, _vectors_by_hand, (-1, 0, 0, 1)),
    ByHand("merged", _merged, _merged_by_hand, (-2, 0, 1, 2, 3)),
    ByHand("edges", _edges, _edges_by_hand, (-2, -1, 0, 1, 2)),
    ByHand("grouped", _grouped, _grouped_by_hand, (-100, -1, 0, 1, 2, 77)),
    ByHand("raised", _raised, _raised_by_hand),
    ByHand("filtered", _filtered, _filtered_by_hand),
)

__all__ = ["DIAGRAMS", "Diagram"]
