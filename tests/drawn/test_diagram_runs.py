"""Diagrams around charts at work: order, delays, control, events, and what is refused."""

import re
from collections.abc import Mapping
from pathlib import Path

import pytest

from rovercheck.checker.drawn.faults import DrawnFault
from rovercheck.checker.drawn.interpret.diagram import ModelRunner
from rovercheck.checker.drawn.interpret.values import TRUE
from rovercheck.checker.drawn.lower.diagram import lowered_model
from rovercheck.checker.drawn.lower.symbols import NotLowered
from rovercheck.checker.simulink.model import read_model
from rovercheck.checker.simulink.writer.charts import WrittenChart
from rovercheck.checker.simulink.writer.packages import WrittenModel
from rovercheck.checker.simulink.writer.systems import WrittenSystem
from tests.drawn.charts import logged, note, running
from tests.drawn.two_readings import compared

TWO = {"in": 2, "out": 1}


def read(model: WrittenModel, folder: Path) -> ModelRunner:
    return ModelRunner(read_model(model.save(folder / "one.slx")))


def ports(system: WrittenSystem, ins: Mapping[str, str], outs: int = 1) -> tuple[list[str], list[str]]:
    given = [system.inport(name, n, OutDataTypeStr=kind) for n, (name, kind) in enumerate(ins.items(), 1)]
    return given, [system.outport(f"y{n}", n) for n in range(1, outs + 1)]


@pytest.mark.parametrize(
    ("kind", "values", "expected"),
    [
        ("Sum", {"Inputs": "+-"}, -3), ("Product", {"Inputs": "*/"}, 0.4), ("Logic", {"Operator": "XOR"}, 0),
        ("Logic", {"Operator": "NAND"}, 0), ("RelationalOperator", {"Operator": "<"}, 1),
        ("RelationalOperator", {"Operator": "~="}, 1), ("MinMax", {"Function": "max"}, 5),
        ("Sum", {"Inputs": "|++", "OutDataTypeStr": "uint8"}, 7),
    ],
)  # fmt: skip
def test_blocks_compute_what_they_are_named_for(
    tmp_path: Path, kind: str, values: Mapping[str, object], expected: float
) -> None:
    model = WrittenModel("one")
    [a, b], [y] = ports(model.root, {"a": "double", "b": "double"})
    block = model.root.block(kind, "block", TWO, {}, **values)
    model.root.line(a, f"{block}/1")
    model.root.line(b, f"{block}/2")
    model.root.line(block, y)
    assert read(model, tmp_path).step({"a": 2, "b": 5}) == {"y1": expected}


@pytest.mark.parametrize(
    ("kind", "values", "given", "expected"),
    [
        ("Gain", {"Gain": "2.5"}, 2, 5), ("Abs", {}, -3, 3), ("Logic", {"Operator": "NOT"}, 0, 1),
        ("Saturate", {"LowerLimit": "-1", "UpperLimit": "1"}, 7, 1),
        ("DataTypeConversion", {"OutDataTypeStr": "int8"}, -1.5, -2),
        ("DataTypeConversion", {"OutDataTypeStr": "int8", "RndMeth": "Zero"}, -1.5, -1),
        ("DataTypeConversion", {"OutDataTypeStr": "uint8"}, 260, 4),
        ("DataTypeConversion", {"OutDataTypeStr": "uint8", "SaturateOnIntegerOverflow": "on"}, 260, 255),
    ],
)  # fmt: skip
def test_blocks_with_one_input_do_too(
    tmp_path: Path, kind: str, values: Mapping[str, object], given: float, expected: float
) -> None:
    model = WrittenModel("one")
    [a], [y] = ports(model.root, {"a": "double"})
    block = model.root.block(kind, "block", {"in": 1, "out": 1}, {}, **values)
    model.root.line(a, block)
    model.root.line(block, y)
    assert read(model, tmp_path).step({"a": given}) == {"y1": expected}


@pytest.mark.parametrize(("criteria", "chosen"), [("u2 >= Threshold", 1), ("u2 > Threshold", 3)])
def test_a_switch_takes_its_first_input_where_its_second_says_so(
    tmp_path: Path, criteria: str, chosen: float
) -> None:
    model = WrittenModel("one")
    [a, b, c], [y] = ports(model.root, {"a": "double", "b": "double", "c": "double"})
    switch = model.root.block("Switch", "s", {"in": 3, "out": 1}, Criteria=criteria, Threshold="5")
    for number, port in enumerate((a, b, c), 1):
        model.root.line(port, f"{switch}/{number}")
    model.root.line(switch, y)
    assert read(model, tmp_path).step({"a": 1, "b": 5, "c": 3}) == {"y1": chosen}


def test_a_delay_gives_what_it_got_a_step_before_also_to_a_block_that_feeds_it(tmp_path: Path) -> None:
    model = WrittenModel("one")
    [a], [y] = ports(model.root, {"a": "double"})
    total = model.root.block("Sum", "total", TWO)
    delay = model.root.block("UnitDelay", "before", {"in": 1, "out": 1}, InitialCondition="10")
    model.root.line(a, f"{total}/1")
    model.root.line(delay, f"{total}/2")
    model.root.line(total, delay)
    model.root.line(total, y)
    runner = read(model, tmp_path)
    assert [runner.step({"a": 1})["y1"] for _ in range(3)] == [11, 12, 13]


def test_blocks_that_feed_each_other_without_a_delay_are_refused(tmp_path: Path) -> None:
    model = WrittenModel("one")
    [a], [y] = ports(model.root, {"a": "double"})
    total = model.root.block("Sum", "total", TWO)
    model.root.line(a, f"{total}/1")
    model.root.line(total, f"{total}/2")
    model.root.line(total, y)
    with pytest.raises(DrawnFault, match="feed each other without a delay"):
        read(model, tmp_path)


def test_what_feeds_each_other_only_through_a_group_is_no_loop(tmp_path: Path) -> None:
    """A subsystem that is not atomic only groups its blocks, each of which has its own place in the order."""
    model = WrittenModel("one")
    [a], [y] = ports(model.root, {"a": "double"})
    group, inside = model.root.subsystem("Group", 2, 2)
    for number in (1, 2):
        gain = inside.block("Gain", f"by {number}", {"in": 1, "out": 1}, Gain=str(number + 1))
        inside.line(inside.inport(f"u{number}", number), gain)
        inside.line(gain, inside.outport(f"v{number}", number))
    model.root.line(a, f"{group}/1")
    model.root.line(f"{group}/1", f"{group}/2")
    model.root.line(f"{group}/2", y)
    assert read(model, tmp_path).step({"a": 5}) == {"y1": 30}


def test_a_from_gives_the_signal_of_the_goto_with_its_tag(tmp_path: Path) -> None:
    model = WrittenModel("one")
    [a, b], [y1, y2] = ports(model.root, {"a": "double", "b": "double"}, 2)
    for tag, port in (("first", a), ("second", b)):
        model.root.line(port, model.root.block("Goto", f"to {tag}", {"in": 1}, {}, GotoTag=tag))
    for tag, end in (("second", y1), ("first", y2)):
        model.root.line(model.root.block("From", f"from {tag}", {"out": 1}, {}, GotoTag=tag), end)
    assert read(model, tmp_path).step({"a": 3, "b": 7}) == {"y1": 7, "y2": 3}


def enabled(folder: Path, outport: Mapping[str, object] | None = None, **values: object) -> ModelRunner:
    """A chart that counts, in a subsystem that runs where ``on`` is true."""
    model = WrittenModel("one")
    [on], [y] = ports(model.root, {"on": "boolean"})
    block, inside = model.root.subsystem("Sub", 0, 1, "enable")
    inside.block("EnablePort", "Enable", {}, {}, **values)
    out = inside.outport("n", 1, **(outport or {}))
    chart_block, chart = inside.chart("Count")
    chart.data("n", "output", "uint8", 7)
    chart.transition(None, chart.state("A\nen: n = uint8(1);\ndu: n = n + 1;"))
    inside.line(chart_block, out)
    model.root.line(on, f"{block}#enable")
    model.root.line(block, y)
    return read(model, folder)


def test_a_subsystem_that_is_not_enabled_is_frozen_and_gives_first_what_its_chart_begins_with(
    tmp_path: Path,
) -> None:
    runner = enabled(tmp_path)
    assert [runner.step({"on": on})["y1"] for on in (0, 1, 1, 0, 0, 1)] == [7, 1, 2, 2, 2, 3]


def test_an_output_may_begin_anew_while_its_subsystem_is_disabled(tmp_path: Path) -> None:
    """Its chart goes on from where it was."""
    runner = enabled(tmp_path, {"OutputWhenDisabled": "reset", "InitialOutput": "4"})
    rows = [{"on": on} for on in (0, 1, 1, 0, 0, 1, 0)]
    assert compared(runner.model, rows).rows == len(rows)
    assert [runner.step(row)["y1"] for row in rows] == [4, 1, 2, 4, 4, 3, 4]


def test_an_output_that_begins_anew_needs_a_value(tmp_path: Path) -> None:
    with pytest.raises(DrawnFault, match="n: OutputWhenDisabled = reset needs an initial output"):
        enabled(tmp_path, {"OutputWhenDisabled": "reset"})


def test_the_states_of_a_subsystem_begin_anew_whenever_it_is_enabled(tmp_path: Path) -> None:
    """Its chart is entered again, with the initial values of its data."""
    runner = enabled(tmp_path, StatesWhenEnabling="reset")
    rows = [{"on": on} for on in (0, 1, 1, 1, 0, 0, 1, 1, 0)]
    assert compared(runner.model, rows).rows == len(rows)
    assert [runner.step(row)["y1"] for row in rows] == [7, 1, 2, 3, 3, 3, 1, 2, 2]


@pytest.mark.parametrize(
    ("around", "inside", "said"),
    [
        (
            "EnablePort",
            "",
            "and what it is in is enabled, triggered or called: whether that enables it",
        ),
        ("", "EnablePort", "and Inner in it is controlled itself. Set States when enabling to held"),
        ("", "DataStoreMemory", "and Inner in it is a data store. Set States when enabling to held"),
        ("", "history", "and Inner in it has a history junction. Set States when enabling to held"),
        ("", "executeAtInitialization", "and Inner in it is entered before the first step. Set"),
        ("", "OUTPUT_EVENT", "and Inner in it has events from or to other blocks. Set"),
    ],
)
def test_what_may_or_may_not_begin_anew_with_a_subsystem_is_refused(
    around: str, inside: str, said: str, tmp_path: Path
) -> None:
    model = WrittenModel("one")
    [on], [] = ports(model.root, {"on": "boolean"}, 0)
    system = model.root
    if around:
        outer, system = model.root.subsystem("Outer", 1, 0, "enable")
        system.block(around, "Enable")
        model.root.line(on, outer)
        model.root.line(on, f"{outer}#enable")
        on = system.inport("on", 1)
    sub, below = system.subsystem("Sub", 0, 0, "enable")
    below.block("EnablePort", "Enable", {}, {}, StatesWhenEnabling="reset")
    system.line(on, f"{sub}#enable")
    if inside == "DataStoreMemory":
        below.block(inside, "Inner")
    elif inside == "EnablePort":
        inner, third = below.subsystem("Inner", 0, 0, "enable")
        third.block(inside, "Enable")
        below.line(below.block("Constant", "one", {"out": 1}), f"{inner}#enable")
    elif inside:
        _, chart = below.chart("Inner")
        state = chart.state("A")
        chart.transition(None, state)
        chart.more = {inside: 1} if inside == "executeAtInitialization" else {}
        if inside == "history":
            chart.junction(state, history=True)
        elif inside == "OUTPUT_EVENT":
            chart.event("E", inside, "EITHER_EDGE_EVENT")
    found = read_model(model.save(tmp_path / "one.slx"))
    with pytest.raises(DrawnFault, match=re.escape(said)):
        ModelRunner(found)
    with pytest.raises(NotLowered, match=re.escape(said)):
        lowered_model(found, "one.slx")


def test_a_chart_with_input_events_runs_when_one_occurs_and_once_for_each(tmp_path: Path) -> None:
    model = WrittenModel("one")
    [a, b], [y] = ports(model.root, {"a": "double", "b": "double"})
    both = model.root.block("Mux", "both", TWO)
    block, chart = model.root.chart("C")
    chart.data("log", "output", "double")
    chart.event("UP", "INPUT_EVENT", "RISING_EDGE_EVENT")
    chart.event("ANY", "INPUT_EVENT", "EITHER_EDGE_EVENT")
    chart.transition(None, chart.state(f"A\non UP: {note(1)}\non ANY: {note(2)}\ndu: {note(3)}"))
    model.root.line(a, f"{both}/1")
    model.root.line(b, f"{both}/2")
    model.root.line(both, f"{block}#trigger")
    model.root.line(block, y)
    runner = read(model, tmp_path)
    steps = [(0, 0), (1, 0), (1, 1), (0, 1), (1, 0)]
    found = [runner.step({"a": one, "b": other})["y1"] for one, other in steps]
    assert found == [0, 0, 32, 32, 323132], "entered by the first, then UP before ANY"


def test_a_block_of_another_rate_is_refused(tmp_path: Path) -> None:
    model = WrittenModel("one")
    [a], [y] = ports(model.root, {"a": "double"})
    delay = model.root.block("UnitDelay", "slow", {"in": 1, "out": 1}, SampleTime="0.5")
    model.root.line(a, delay)
    model.root.line(delay, y)
    with pytest.raises(DrawnFault, match=r"slow runs every 0.5 s, and the model every 0.1 s"):
        read(model, tmp_path)


def test_a_block_without_a_meaning_is_named(tmp_path: Path) -> None:
    model = WrittenModel("one")
    [a], [y] = ports(model.root, {"a": "double"})
    block = model.root.block("Lookup_n-D", "table", {"in": 1, "out": 1})
    model.root.line(a, block)
    model.root.line(block, y)
    with pytest.raises(DrawnFault, match="the block table: Lookup_n-D is not known here"):
        read(model, tmp_path)


def test_a_function_of_the_chart_may_have_the_name_of_a_word_of_time(tmp_path: Path) -> None:
    def draw(c: WrittenChart) -> None:
        a = c.state("A\nen: log = count(u);")
        c.function("y = count(x)", script="function y = count(x)\ny = x + 40;\nend\n")
        c.transition(None, a)

    assert logged(running(tmp_path, draw), [2]) == [42]


def test_what_is_refused_is_not_run(tmp_path: Path) -> None:
    def draw(c: WrittenChart) -> None:
        c.transition(None, c.state("A"))

    with pytest.raises(DrawnFault, match="C, the chart: it has super step semantics"):
        running(tmp_path, draw, enableNonTerminalStates=1)


def test_a_parameter_has_the_value_of_a_script_beside_the_model(tmp_path: Path) -> None:
    def draw(c: WrittenChart) -> None:
        c.data("LIMIT", "parameter", "double")
        c.transition(None, c.state("A\nen: log = LIMIT + u;"))

    with pytest.raises(DrawnFault, match=r"C: the value of LIMIT stands in no file: name a script"):
        running(tmp_path, draw)
    script = tmp_path / "values.m"
    script.write_text("LIMIT = 2 * 20; % of all\n", encoding="utf-8")
    runner = ModelRunner(read_model(tmp_path / "one.slx", [script]))
    assert runner.step({"u": 2}) == {"log": 42}


def test_an_output_may_hold_whether_a_state_is_active(tmp_path: Path) -> None:
    def draw(c: WrittenChart) -> None:
        a, b = c.state("A"), c.state("B")
        c.data("in_b", "output", "boolean", more={"outputState": b.ssid})
        c.transition(None, a)
        c.transition(a, b, "[u == 1]", 1)
        c.transition(b, a, "[u == 0]", 1)

    runner = running(tmp_path, draw)
    [one] = [machine.memory for machine in runner.machines]
    [in_b] = [d.ssid for d in runner.model.charts[0].content.data if d.name == "in_b"]
    found = []
    for u in (0, 1, 1, 0):
        runner.step({"u": u})
        found.append(one.values[in_b])
    assert [value == TRUE for value in found] == [False, True, True, False]


def test_functions_of_one_name_in_two_boxes_are_refused(tmp_path: Path) -> None:
    """The last one silently took the place of the other."""

    def draw(c: WrittenChart) -> None:
        for name, value in (("One", 1), ("Two", 2)):
            c.function("y = f()", c.state(name, box=True), script=f"function y = f()\ny = {value};\nend\n")
        c.transition(None, c.state("A\nen: log = f();"))

    with pytest.raises(DrawnFault, match=r"the function f .*: another function beside it, or in a box"):
        running(tmp_path, draw)


def test_a_name_in_a_box_that_there_is_around_it_is_refused(tmp_path: Path) -> None:
    """What had the name around the box read and wrote the datum in it."""

    def draw(c: WrittenChart) -> None:
        c.data("n", "local", "uint8", 3)
        box = c.state("Box", box=True)
        c.data("n", "local", "uint8", 7, holder=box)
        c.transition(None, c.state("A\nen: log = double(n);"))

    with pytest.raises(DrawnFault, match=r"the box Box .*: n is also a name around it, or in another box"):
        running(tmp_path, draw)
