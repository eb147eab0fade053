"""What the lowering of drawn models once did otherwise than the direct interpreter."""

from collections.abc import Mapping, Sequence
from pathlib import Path

import pytest

from rovercheck.checker.drawn.interpret.diagram import ModelRunner
from rovercheck.checker.drawn.lower.diagram import lowered_model
from rovercheck.checker.drawn.lower.run import LoweredRun
from rovercheck.checker.simulink.model import read_model
from rovercheck.checker.simulink.writer.charts import WrittenChart
from rovercheck.checker.simulink.writer.packages import WrittenModel
from rovercheck.spec_model.lang.domain import fixed
from tests.drawn.charts import LOG, note, running
from tests.drawn.two_readings import Row, compared

DOMAINS = {"u": fixed(-10, 10, 1), "v": fixed(-10, 10, 1), "log": fixed(0, 10**7, 1)}


def both(runner: ModelRunner, inputs: Sequence[float | Row], name: str = "log") -> list[float]:
    """What an output is in each step, the same in both readings."""
    rows: list[Row] = [one if isinstance(one, Mapping) else {"u": one} for one in inputs]
    found = compared(runner.model, rows, domains=DOMAINS)
    assert (found.rows, found.refused, found.fault) == (len(rows), "", "")
    run = LoweredRun(lowered_model(runner.model, "one.slx", DOMAINS))
    return [run.step(row)[name] for row in rows]


def test_data_that_nothing_writes_keep_their_first_values(tmp_path: Path) -> None:
    """They were read as inputs, with any value in each step."""

    def draw(c: WrittenChart) -> None:
        c.data("least", "local", "uint8", 3)
        c.transition(None, c.state("A\ndu: log = double(least) + u;"))

    runner = running(tmp_path, draw, outs={**LOG, "idle": "uint8"})
    assert both(runner, [1, 2, 3]) == [0, 5, 6]
    lowered = lowered_model(runner.model, "one.slx", DOMAINS)
    assert set(lowered.system.inputs) == {"u"}


def test_a_graphical_function_is_called_twice_in_one_expression(tmp_path: Path) -> None:
    """The system had what the second call gives for both."""

    def draw(c: WrittenChart) -> None:
        f = c.function("y = g(x)")
        for name, scope in (("x", "function input"), ("y", "function output")):
            c.data(name, scope, "int8", holder=f)
        c.transition(None, c.junction(f), "{y = x + 1;}", holder=f)
        c.transition(None, c.state("A\nen, du: log = g(u) + g(int8(10));"))

    runner = running(tmp_path, draw, {"u": "int8"}, {"log": "int8"})
    assert both(runner, [1, 2, 3]) == [13, 14, 15]


def test_a_chart_is_entered_at_initialization_with_its_states(tmp_path: Path) -> None:
    """Only data began as that leaves them, the active states did not; a second attempt began from there."""

    def draw(c: WrittenChart) -> None:
        a, b = c.state(f"A\nen: {note(1)}\ndu: {note(2)}"), c.state(f"B\nen: {note(3)}")
        c.transition(None, a)
        c.transition(a, b, "[u == 1 && hasChanged(u)]")

    runner = running(tmp_path, draw, executeAtInitialization=1)
    assert both(runner, [0, 1, 0]) == [12, 123, 123]


def test_outputs_are_those_of_initialization_before_the_first_event(tmp_path: Path) -> None:
    """They were the first values of the data until an event came."""
    model = WrittenModel("one", step="0.1")
    port, end = model.root.inport("u", 1, OutDataTypeStr="int8"), model.root.outport("y", 1)
    block, chart = model.root.chart("C")
    chart.data("log", "output", "uint8")
    chart.event("UP", "INPUT_EVENT", "RISING_EDGE_EVENT")
    chart.more = {"executeAtInitialization": 1}
    chart.transition(None, chart.state("A\nen: log = uint8(4);\non UP: log = log + 1;"))
    model.root.line(port, f"{block}#trigger")
    model.root.line(block, end)
    runner = ModelRunner(read_model(model.save(tmp_path / "one.slx")))
    assert both(runner, [0, 0, 1, 1, 0, 1], "y") == [4, 4, 5, 5, 5, 6]


COUNT = """function r = f()
persistent p
if isempty(p)
 p = 0;
end
p = min(p + 1, 9);
r = p;
end
"""


@pytest.mark.parametrize(
    ("guard", "left"), [("E[f() > 1]", 8), ("[u == 1 && f() > 1]", 5), ("after(5, tick)[f() > 1]", 6)]
)
def test_a_guard_is_computed_only_where_its_event_occurs(tmp_path: Path, guard: str, left: int) -> None:
    """A function in it was called in every step, and its persistent variable changed."""

    def draw(c: WrittenChart) -> None:
        c.event("E")
        a, b = c.state("A\nex: log = 7;"), c.state("B")
        c.function("r = f()", script=COUNT)
        c.transition(None, a)
        c.transition(a, b, guard)

    found = both(running(tmp_path, draw), [0, 0, 0, 0, 1, 1, 1, 1])
    assert found == [0] * left + [7] * (8 - left)


def test_a_time_begins_anew_only_where_its_condition_is_looked_at(tmp_path: Path) -> None:
    """The right side of an ``&&`` reset it also where the left side was false."""

    def draw(c: WrittenChart) -> None:
        c.data("seen", "local", "double")
        a, b = c.state("A\ndu: seen = u;"), c.state(f"B\nen: {note(1)}")
        c.transition(None, a)
        c.transition(a, b, "[u ~= 0 && duration(seen == u) >= 0.3]")

    both(running(tmp_path, draw), [0, 2, 2, 0, 2, 0, 0, 1, 1, 1, 1, 1])


def test_no_element_is_looked_for_where_the_left_side_says_so(tmp_path: Path) -> None:
    """An index was a fault also where ``&&`` does not come to it."""

    def draw(c: WrittenChart) -> None:
        c.data("list", "local", "uint8", 5, "3")
        c.transition(None, c.state("A\ndu: if u >= 1 && u <= 3 && list(u) == 5, log = log + 1; end"))

    assert both(running(tmp_path, draw), [0, 0, 1, 4, 3]) == [0, 0, 1, 1, 2]


def test_times_of_the_chart_itself_do_not_go_on(tmp_path: Path) -> None:
    """A default transition of the chart counted one step in its first execution."""

    def draw(c: WrittenChart) -> None:
        c.transition(None, c.state("A"), "/log = 5 + temporalCount(tick);")

    assert both(running(tmp_path, draw), [0, 0]) == [5, 5]


def test_every_so_many_events_counts_no_steps(tmp_path: Path) -> None:
    """``every(2, E)`` counted each step, too."""

    def draw(c: WrittenChart) -> None:
        c.event("E")
        first = c.state("S\ndu: if u == 1, send(E, T); end", order=1)
        second = c.state(f"T\non every(2, E): {note(1)}", order=2)
        assert first is not second

    found = both(running(tmp_path, draw, parallel=True), [0, 0, 1, 0, 1, 1, 1])
    assert found == [0, 0, 0, 0, 1, 1, 11]


def test_events_that_come_in_are_counted(tmp_path: Path) -> None:
    """In both readings only events that the chart sends itself were."""
    model = WrittenModel("one", step="0.1")
    port, end = model.root.inport("u", 1, OutDataTypeStr="int8"), model.root.outport("y", 1)
    block, chart = model.root.chart("C")
    chart.data("log", "output", "uint8")
    chart.event("UP", "INPUT_EVENT", "EITHER_EDGE_EVENT")
    first, second = chart.state("A"), chart.state("B\nen: log = uint8(9);")
    chart.transition(None, first)
    chart.transition(first, second, "after(2, UP)")
    model.root.line(port, f"{block}#trigger")
    model.root.line(block, end)
    runner = ModelRunner(read_model(model.save(tmp_path / "one.slx")))
    assert both(runner, [0, 1, 1, 0, 1, 0], "y") == [0, 0, 0, 0, 9, 9]


def test_bits_of_signed_numbers_stay_in_their_type(tmp_path: Path) -> None:
    """Bits that were joined twice were refused: they might lie outside the type."""

    def draw(c: WrittenChart) -> None:
        c.data("g", "local", "int8")
        c.transition(None, c.state("A\ndu: g = u; log = ((g ^ 5) | 2) & 127; y = (g | 1) ^ 3;"))

    outs = {"log": "int8", "y": "int8"}
    runner = running(tmp_path, draw, {"u": "int8"}, outs, language="C with bit operations")
    rows: list[float] = [0, 9, -9, -1, 6]
    assert both(runner, rows, "y") == [0, (9 | 1) ^ 3, (-9 | 1) ^ 3, (-1 | 1) ^ 3, (6 | 1) ^ 3]


def test_the_least_of_a_sum_and_a_constant_has_a_range(tmp_path: Path) -> None:
    """The range of a sum that is held between two ends grew without end, and was refused."""

    def draw(c: WrittenChart) -> None:
        c.transition(None, c.state("A\ndu: y = max(min(y + u, 4), -4);"))

    runner = running(tmp_path, draw, outs={"y": "double"})
    assert both(runner, [0, 3, 3, -9], "y") == [0, 3, 4, -4]


def test_events_answered_within_each_other_do_not_make_a_step_long(tmp_path: Path) -> None:
    """Two events that both regions may send made more than ten thousand statements of six states."""

    def draw(c: WrittenChart) -> None:
        regions = [c.state(f"R{n}\ndu: {note(n)}", order=n) for n in range(1, 3)]
        for name in "EF":
            c.event(name)
            c.data(f"seen{name}", "local", "int8", 100)
        for number, region in enumerate(regions):
            a, b = c.state(f"A{number}", region), c.state(f"B{number}", region)
            c.transition(None, a)
            for order, event in enumerate("EF", 1):
                c.transition(a, b, f"[u ~= seen{event}]{{seen{event} = u; {event};}}", order)
                c.transition(b, a, f"{event}/{note(order + 2)}", order)

    runner = running(tmp_path, draw, ins={"u": "int8"}, outs={"log": "uint32"}, parallel=True)
    both(runner, [0, 1])


def test_a_region_that_an_event_entered_already_is_not_entered_again(tmp_path: Path) -> None:
    """The entry action of the first region has the state around it left and entered with all regions."""

    def draw(c: WrittenChart) -> None:
        c.event("E")
        c.data("sent", "local", "boolean")
        p = c.state("P", parallel=True)
        first = c.state(f"R1\nen: {note(1)} if ~sent, sent = true; E; end", p, order=1)
        second = c.state(f"R2\nen: {note(2)}", p, order=2)
        assert first is not second
        c.transition(None, p)
        c.transition(p, p, "E")

    assert both(running(tmp_path, draw), [0, 0]) == [112, 112]


def test_a_time_of_a_state_that_is_not_active_does_not_go_on(tmp_path: Path) -> None:
    """It would be one more thing by which the states of the system differ."""

    def draw(c: WrittenChart) -> None:
        a, b = c.state("A"), c.state(f"B\nen: {note(1)}")
        c.transition(None, a)
        c.transition(a, b, "[duration(u == 1) >= 0.3]")

    runner = running(tmp_path, draw)
    both(runner, [1, 1, 1, 1, 1])
    run = LoweredRun(lowered_model(runner.model, "one.slx", DOMAINS))
    for _ in range(6):
        run.step({"u": 1})
    assert [raw for name, raw in run.active().items() if "held" in name] == [0]


# --- diagrams -----------------------------------------------------------------------------------------------


def delayed(folder: Path, *first: str) -> ModelRunner:
    """An input behind delays, one after the other, and each of them as an output."""
    model = WrittenModel("one", step="0.1")
    source = model.root.inport("u", 1, OutDataTypeStr="double")
    for number, value in enumerate(first, 1):
        values = {"InitialCondition": value}
        before = source
        source = model.root.block("UnitDelay", f"d{number}", {"in": 1, "out": 1}, {}, **values)
        model.root.line(before, source)
        model.root.line(source, model.root.outport(f"y{number}", number))
        double = model.root.block("Gain", f"g{number}", {"in": 1, "out": 1}, Gain="2")
        model.root.line(source, double)
        model.root.line(double, model.root.outport(f"z{number}", number + len(first)))
    return ModelRunner(read_model(model.save(folder / "one.slx")))


@pytest.mark.parametrize(("name", "values"), [("y1", [7, 1, 2]), ("z1", [14, 2, 4]), ("y2", [8, 7, 1])])
def test_a_delay_gives_what_it_got_a_step_before(tmp_path: Path, name: str, values: list[float]) -> None:
    """Outputs of the model, and a delay behind another one, had what came in just then."""
    runner = delayed(tmp_path, "7", "8")
    assert both(runner, [1, 2, 3], name) == values


@pytest.mark.parametrize("atomic", ["off", "on"])
def test_a_delay_in_a_subsystem_that_always_runs_gives_what_it_got_a_step_before(
    tmp_path: Path, atomic: str
) -> None:
    """No test had an atomic subsystem without a control port, which is a system of its own."""
    model = WrittenModel("one", step="0.1")
    u = model.root.inport("u", 1, OutDataTypeStr="double")
    block, inside = model.root.subsystem("Sub", 1, 1)
    deeper, innermost = inside.subsystem("Deeper", 1, 1)
    model.root.say(block, TreatAsAtomicUnit=atomic)
    inside.say(deeper, TreatAsAtomicUnit=atomic)
    for outer, inner, name in ((inside, deeper, "i"), (innermost, "", "j")):
        delay = outer.block("UnitDelay", "d", {"in": 1, "out": 1}, {}, InitialCondition="5")
        outer.line(outer.inport(name, 1), delay)
        outer.line(delay, inner or outer.outport("o", 1))
    inside.line(deeper, inside.outport("o", 1))
    model.root.line(u, block)
    model.root.line(block, model.root.outport("y", 1))
    assert both(ModelRunner(read_model(model.save(tmp_path / "one.slx"))), [1, 2, 3, 4], "y") == [5, 5, 1, 2]


def test_a_disabled_subsystem_holds_what_passes_through_it(tmp_path: Path) -> None:
    """What was an output of another chart, or of a delay, went through also while it was disabled."""
    model = WrittenModel("one", step="0.1")
    u, on = (model.root.inport(name, n, OutDataTypeStr="double") for n, name in enumerate("uv", 1))
    block, inside = model.root.subsystem("Sub", 1, 2, "enable")
    inside.block("EnablePort", "Enable", {}, {})
    port = inside.inport("i", 1)
    delay = inside.block("UnitDelay", "d", {"in": 1, "out": 1}, InitialCondition="3")
    inside.line(port, delay)
    inside.line(port, inside.outport("o", 1))
    inside.line(delay, inside.outport("p", 2))
    before = model.root.block("UnitDelay", "d", {"in": 1, "out": 1}, InitialCondition="5")
    model.root.line(u, before)
    model.root.line(before, f"{block}/1")
    model.root.line(on, f"{block}#enable")
    for number in (1, 2):
        model.root.line(f"{block}/{number}", model.root.outport(f"y{number}", number))
    runner = ModelRunner(read_model(model.save(tmp_path / "one.slx")))
    rows: list[Row] = [{"u": n, "v": v} for n, v in enumerate((0, 1, 1, 0, 1), 1)]
    assert both(runner, rows, "y1") == [0, 1, 2, 2, 4]
    assert both(runner, rows, "y2") == [3, 3, 1, 1, 2]


def test_a_state_transition_table_is_entered_at_initialization(tmp_path: Path) -> None:
    """The interpreter entered only charts of states before the first step."""
    model = WrittenModel("one", step="0.1")
    port, end = model.root.inport("u", 1, OutDataTypeStr="int8"), model.root.outport("y", 1)
    block, chart = model.root.chart("T", "State Transition Table")
    chart.more = {"executeAtInitialization": 1}
    chart.data("u", "input", "int8")
    chart.data("log", "output", "uint8")
    a, b = chart.state("A\nen: log = uint8(1);\ndu: log = uint8(2);"), chart.state("B\nen: log = uint8(3);")
    chart.transition(None, a)
    chart.transition(a, b, "[u == 1]")
    model.root.line(port, block)
    model.root.line(block, end)
    runner = ModelRunner(read_model(model.save(tmp_path / "one.slx")))
    assert both(runner, [0, 1, 0], "y") == [2, 3, 3]


def test_a_number_is_rounded_to_steps_larger_than_one(tmp_path: Path) -> None:
    def draw(chart: WrittenChart) -> None:
        chart.transition(None, chart.state("A\nen, du: log = u + 1;"))

    runner = running(tmp_path, draw)
    lowered = lowered_model(runner.model, "one.slx", {"u": fixed(0, 20, 1), "log": fixed(0, 100, 5)})
    run = LoweredRun(lowered)
    assert [run.step({"u": value})["log"] for value in (0, 1, 2, 13)] == [0, 0, 5, 15]


def test_states_that_share_a_junction_count_a_duration_each(tmp_path: Path) -> None:
    def draw(chart: WrittenChart) -> None:
        one, other, end = chart.state("A"), chart.state("B"), chart.state("C\nen: log = 1;")
        shared = chart.junction()
        chart.transition(None, one)
        chart.transition(one, shared)
        chart.transition(one, other, "[u > 5]", 2)
        chart.transition(other, shared)
        chart.transition(shared, end, "[duration(u > 0) > 0.2]")

    model = running(tmp_path, draw).model
    assert compared(model, [{"u": 1}] * 6, domains={"u": fixed(0, 9, 1)}).rows == 6
