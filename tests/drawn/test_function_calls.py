"""Events of a chart that are function calls: what they call is executed at once, in both readings."""

from collections.abc import Callable
from pathlib import Path

import pytest

from rovercheck.checker.drawn.faults import DrawnFault
from rovercheck.checker.drawn.interpret.diagram import ModelRunner
from rovercheck.checker.drawn.lower.diagram import lowered_model
from rovercheck.checker.drawn.lower.symbols import NotLowered
from rovercheck.checker.simulink.model import read_model
from rovercheck.checker.simulink.writer.charts import WrittenChart
from rovercheck.checker.simulink.writer.packages import WrittenModel
from rovercheck.checker.simulink.writer.systems import WrittenSystem
from tests.drawn.test_lowering import both

CALL, IN = "FUNCTION_CALL_EVENT", "INPUT_EVENT"


class Calling:
    """A model of a chart C with the input ``u``, an output ``n`` and events that are function calls."""

    def __init__(self, label: str, *events: str, back: int = 0, **more: object) -> None:
        self.model = WrittenModel("one", step="0.1")
        self.root = self.model.root
        self.block, self.chart = self.root.chart("C")
        self.chart.more = more
        self.chart.data("u", "input", "int8")
        for number in range(1, back + 1):
            self.chart.data(f"b{number}", "input", "int8")
        for name in ("n", "log"):
            self.chart.data(name, "output", "int32" if name == "log" else "int8")
        for one in events:
            self.chart.event(one, "OUTPUT_EVENT", CALL)
        self.chart.transition(None, self.chart.state(label))
        self.root.line(self.root.inport("u", 1, OutDataTypeStr="int8"), self.block)
        self.ends = 0
        self.out(f"{self.block}/2", "log")

    def event(self, number: int) -> str:
        """The port of an event, from 1."""
        return f"{self.block}/{2 + number}"

    def out(self, source: str, name: str) -> None:
        """An output of the model."""
        self.ends += 1
        self.root.line(source, self.root.outport(name, self.ends))

    def runner(self, folder: Path) -> ModelRunner:
        """The model, read again."""
        return ModelRunner(read_model(self.model.save(folder / "one.slx")))

    def refused(self, folder: Path) -> tuple[str, str]:
        """What both readings say of the model."""
        read = read_model(self.model.save(folder / "one.slx"))
        with pytest.raises(DrawnFault) as direct:
            ModelRunner(read).step({"u": 0})
        with pytest.raises(NotLowered) as lowered:
            lowered_model(read, "one.slx")
        return str(direct.value), str(lowered.value)


def summing(root: WrittenSystem, name: str = "X") -> str:
    """A called subsystem that adds what comes in to what it gave at its last call."""
    sub, inside = root.subsystem(name, 1, 1, "trigger")
    inside.block("TriggerPort", "function", {}, {}, TriggerType="function-call")
    delay = inside.block("UnitDelay", "before", {"in": 1, "out": 1}, {}, InitialCondition="int8(0)")
    add = inside.block("Sum", "add", {"in": 2, "out": 1}, {}, Inputs="++", SaturateOnIntegerOverflow="on")
    inside.line(inside.inport("i", 1, OutDataTypeStr="int8"), f"{add}/1")
    inside.line(delay, f"{add}/2")
    inside.line(add, delay)
    inside.line(add, inside.outport("o", 1))
    return sub


TWICE = "A\ndu: if u > 0, n = u; F; log = 100 * int32(b1); n = n + 1; send(F); log = log + int32(b1); end"


def test_a_subsystem_is_executed_within_the_action_that_calls_it(tmp_path: Path) -> None:
    """It sees the outputs of the chart as they are then, and the chart sees what it gives.

    A chart with such an event was refused.
    """
    made = Calling(TWICE, "F", back=1)
    sub = summing(made.root)
    made.root.line(f"{made.block}/1", sub)
    made.root.line(made.event(1), f"{sub}#trigger")
    made.root.line(sub, f"{made.block}/2")
    made.out(sub, "sum")
    runner = made.runner(tmp_path)
    steps: list[float] = [1, 1, 0, 3]
    # calls with 1, 2 in the second step, and with 3, 4 in the fourth; the first one only enters
    assert both(runner, steps, "log") == [0, 103, 103, 610]
    assert both(runner, steps, "sum") == [0, 3, 3, 10]


def test_what_is_called_is_executed_where_it_is_called_and_never_else(tmp_path: Path) -> None:
    made = Calling("A\ndu: if u > 0, F; end\nn = 1;", "F")
    sub, inside = made.root.subsystem("X", 0, 1, "trigger")
    inside.block("TriggerPort", "function", {}, {}, TriggerType="function-call")
    block, chart = inside.chart("Count")
    chart.data("times", "output", "uint8", initial=7)
    state = chart.state("A\nen: times = uint8(1);")
    chart.transition(None, state)
    chart.transition(state, chart.state("B\ndu: times = times + 1;"), "after(2, tick)")
    inside.line(block, inside.outport("o", 1))
    made.root.line(made.event(1), f"{sub}#trigger")
    made.out(sub, "times")
    assert both(made.runner(tmp_path), [1, 0, 1, 1, 0, 1, 1, 1], "times") == [7, 7, 1, 1, 1, 1, 2, 3]


def test_the_blocks_after_a_chart_see_what_it_has_called(tmp_path: Path) -> None:
    """A block that reads a called one is executed after the chart, one that feeds it before."""
    made = Calling("A\ndu: n = u; F;", "F")
    sub = summing(made.root)
    twice = made.root.block("Gain", "twice", {"in": 1, "out": 1}, {}, Gain="2")
    half = made.root.block("Gain", "minus", {"in": 1, "out": 1}, {}, Gain="-1")
    made.root.line("2", half)
    made.root.line(half, sub)
    made.root.line(sub, twice)
    made.root.line(made.event(1), f"{sub}#trigger")
    made.out(twice, "twice")
    assert both(made.runner(tmp_path), [5, 1, 2], "twice") == [0, -2, -6]


def called_chart(root: WrittenSystem, name: str, *events: str) -> tuple[str, WrittenChart]:
    """A chart with input events that are function calls, an input ``i`` and an output ``o``."""
    block, chart = root.chart(name)
    chart.data("i", "input", "int8")
    chart.data("o", "output", "int32")
    for one in events:
        chart.event(one, IN, CALL)
    return block, chart


def test_a_chart_is_woken_by_each_call(tmp_path: Path) -> None:
    """Several calls come in through a Mux; each is another event, and the first only has it entered."""
    made = Calling("A\ndu: n = u; if u == 1, F; G; F; end, if u == 2, G; end\nlog = log + 1;", "F", "G")
    block, chart = called_chart(made.root, "D", "P", "Q")
    state = chart.state("S\nen: o = int32(1);\non P: o = 10 * o + int32(i);\non Q: o = 10 * o + 5;")
    chart.transition(None, state)
    chart.transition(state, state, "Q[i == 2]")
    mux = made.root.block("Mux", "both", {"in": 2, "out": 1}, {}, Inputs="2")
    made.root.line(f"{made.block}/1", block)
    made.root.line(made.event(1), f"{mux}/1")
    made.root.line(made.event(2), f"{mux}/2")
    made.root.line(mux, f"{block}#trigger")
    made.out(block, "o")
    runner = made.runner(tmp_path)
    assert both(runner, [0, 0, 1, 1, 2, 1], "o") == [0, 0, 151, 151151, 1, 1151]


def test_a_called_chart_calls_a_subsystem(tmp_path: Path) -> None:
    """What that gives is seen by the one in the middle at once, and by the first after its call."""
    made = Calling("A\ndu: n = u; F; log = int32(b1);", "F", back=1)
    block, chart = called_chart(made.root, "D", "P")
    chart.data("back", "input", "int8")
    chart.event("G", "OUTPUT_EVENT", CALL)
    chart.transition(None, chart.state("S\ndu: o = int32(back); G; o = 100 * o + int32(back);"))
    sub = summing(made.root)
    for source, target in (
        (f"{made.block}/1", f"{block}/1"), (made.event(1), f"{block}#trigger"),
        (f"{block}/2", f"{sub}#trigger"),
        (f"{made.block}/1", sub), (sub, f"{block}/2"), (sub, f"{made.block}/2"),
    ):  # fmt: skip
        made.root.line(source, target)
    made.out(block, "o")
    runner = made.runner(tmp_path)
    # the first step enters C, the second one D; from then on the sum grows by u
    assert both(runner, [1, 1, 2, 3], "o") == [0, 0, 2, 205]
    assert both(runner, [1, 1, 2, 3], "log") == [0, 0, 2, 5]


def test_a_called_matlab_function_is_executed_once_a_call(tmp_path: Path) -> None:
    made = Calling("A\ndu: k = int8(0); while k < u, F; k = k + 1; end", "F")
    made.chart.data("k", "local", "int8")
    script = "function y = f()\npersistent k\nif isempty(k), k = int8(0); end\nk = k + 1; y = k;\nend\n"
    block, chart = made.root.chart("f", "MATLAB Function", script)
    chart.data("y", "output", "int8")
    chart.event("P", IN, CALL)
    made.root.line(made.event(1), f"{block}#trigger")
    made.out(block, "y")
    assert both(made.runner(tmp_path), [3, 2, 0, 1], "y") == [0, 2, 2, 3]


def test_a_matlab_function_with_a_trigger_is_executed_at_its_edges(tmp_path: Path) -> None:
    """It was executed in every step."""
    model = WrittenModel("one", step="0.1")
    script = "function y = f()\npersistent k\nif isempty(k), k = int8(0); end\nk = k + 1; y = k;\nend\n"
    block, chart = model.root.chart("f", "MATLAB Function", script)
    chart.data("y", "output", "int8")
    chart.event("P", IN, "RISING_EDGE_EVENT")
    model.root.line(model.root.inport("u", 1, OutDataTypeStr="int8"), f"{block}#trigger")
    model.root.line(block, model.root.outport("y", 1))
    runner = ModelRunner(read_model(model.save(tmp_path / "one.slx")))
    assert both(runner, [1, 0, 1, 1, 0, 1], "y") == [0, 0, 1, 1, 1, 2]


def test_times_and_changes_of_a_called_chart_are_those_of_its_calls(tmp_path: Path) -> None:
    made = Calling("A\ndu: n = u; F;", "F")
    block, chart = called_chart(made.root, "D", "P")
    one = chart.state("S\ndu: o = o + 1; if hasChanged(i), o = o + 10; end")
    chart.transition(None, one)
    chart.transition(one, chart.state("T\nen: o = -o;"), "[count(i > 1) >= 2]")
    made.root.line(f"{made.block}/1", block)
    made.root.line(made.event(1), f"{block}#trigger")
    made.out(block, "o")
    assert both(made.runner(tmp_path), [0, 0, 1, 1, 2, 2, 2], "o") == [0, 0, 11, 12, 23, 24, -24]


def test_a_call_that_leads_nowhere_does_nothing(tmp_path: Path) -> None:
    made = Calling("A\ndu: F; G; log = log + 1;", "F", "G")
    made.root.line(made.event(2), made.root.block("Terminator", "end", {"in": 1}))
    assert both(made.runner(tmp_path), [0, 0, 0], "log") == [0, 1, 2]


def test_two_called_blocks_of_which_one_feeds_the_other(tmp_path: Path) -> None:
    """The second sees what the first gave at its last call, in whichever order they are called."""
    made = Calling("A\ndu: n = u; if u > 1, F; G; else, G; F; end", "F", "G")
    one, other = summing(made.root, "Y"), summing(made.root, "X")
    made.root.line(f"{made.block}/1", one)
    made.root.line(one, other)
    made.root.line(made.event(1), f"{one}#trigger")
    made.root.line(made.event(2), f"{other}#trigger")
    made.out(other, "sum")
    assert both(made.runner(tmp_path), [0, 1, 1, 2, 1], "sum") == [0, 0, 1, 5, 9]


def test_times_count_the_steps_of_a_chart_and_not_its_events(tmp_path: Path) -> None:
    """Two edges of one step wake the chart up twice, and are one step of it; each call is one."""

    def count(chart: WrittenChart) -> None:
        chart.data("o", "output", "int8")
        state = chart.state("S\ndu: o = o + 1;")
        chart.transition(None, state)
        chart.transition(state, chart.state("T\nen: o = -o;"), "after(2, tick)")

    model = WrittenModel("one", step="0.1")
    block, chart = model.root.chart("C")
    count(chart)
    mux = model.root.block("Mux", "both", {"in": 2, "out": 1}, {}, Inputs="2")
    port = model.root.inport("u", 1, OutDataTypeStr="int8")
    for number, name in enumerate("PQ", 1):
        chart.event(name, IN, "EITHER_EDGE_EVENT")
        model.root.line(port, f"{mux}/{number}")
    model.root.line(mux, f"{block}#trigger")
    model.root.line(block, model.root.outport("o", 1))
    runner = ModelRunner(read_model(model.save(tmp_path / "one.slx")))
    # the second step enters it and executes it once; its transition is taken two steps later
    assert both(runner, [0, 1, 0, 1], "o") == [0, 1, 3, -3]

    made = Calling("A\ndu: F; F;", "F")
    block, chart = made.root.chart("D")
    chart.event("P", IN, CALL)
    count(chart)
    made.root.line(made.event(1), f"{block}#trigger")
    made.out(block, "o")
    assert both(made.runner(tmp_path), [0, 0, 0], "o") == [0, 1, -1]


# --- what is refused ---------------------------------------------------------------------------------------


def to_a_block(made: Calling, target: str) -> None:
    made.root.line(made.event(1), target)


def split(made: Calling, **values: object) -> str:
    """Two subsystems X and Y that one call executes; the answer is the split."""
    block = made.root.block("FunctionCallSplit", "Split", {"in": 1, "out": 2}, {}, **values)
    to_a_block(made, block)
    one, other = summing(made.root, "X"), summing(made.root, "Y")
    made.root.line(block, f"{one}#trigger")
    made.root.line(f"{block}/2", f"{other}#trigger")
    return block


def reverse(made: Calling) -> None:
    split(made, OutputPortLayout="reverse")


def branch(made: Calling) -> None:
    made.root.line(split(made), f"{summing(made.root, 'Z')}#trigger")


def backward(made: Calling) -> None:
    split(made)
    subs = {one.name: one.sid for one in made.root.blocks}
    made.root.line(subs["Y"], subs["X"])


def to_a_gain(made: Calling) -> None:
    made.root.line(f"{split(made)}/2", made.root.block("Gain", "G", {"in": 1, "out": 1}))


def unfed(made: Calling) -> None:
    block = made.root.block("FunctionCallSplit", "Split", {"in": 1, "out": 2})
    made.root.line(block, f"{summing(made.root)}#trigger")


def generated(made: Calling, **values: object) -> None:
    kind = {"SourceBlock": "simulink/Generator", "SourceType": "Function-Call Generator"}
    block = made.root.block("Reference", "Gen", {"out": 1}, {}, **kind, **values)
    made.root.line(block, f"{summing(made.root)}#trigger")


def two_numbers(made: Calling) -> None:
    generated(made, sample_time="0.1", numberOfIterations="[1 2]")


def other_rate(made: Calling) -> None:
    generated(made)


def loop(made: Calling) -> None:
    sub = summing(made.root)
    gain = made.root.block("Gain", "G", {"in": 1, "out": 1}, {}, Gain="2")
    to_a_block(made, f"{sub}#trigger")
    made.root.line(f"{made.block}/1", gain)
    made.root.line(gain, sub)


def two(made: Calling) -> None:
    for name in "XY":
        to_a_block(made, f"{summing(made.root, name)}#trigger")


def signal(made: Calling) -> None:
    made.root.line(f"{made.block}/1", f"{summing(made.root)}#trigger")


def edge(made: Calling) -> None:
    sub, inside = made.root.subsystem("X", 0, 0, "trigger")
    inside.block("TriggerPort", "t", {}, {}, TriggerType="either")
    to_a_block(made, f"{sub}#trigger")


def outside(made: Calling) -> None:
    made.root.line("2", f"{summing(made.root)}#trigger")


def anew(made: Calling) -> None:
    sub, inside = made.root.subsystem("X", 0, 0, "trigger")
    inside.block("TriggerPort", "t", {}, {}, TriggerType="function-call", StatesWhenEnabling="reset")
    to_a_block(made, f"{sub}#trigger")


@pytest.mark.parametrize(
    ("draw", "said"),
    [
        (loop, "feed each other without a delay (what a chart calls"),
        (two, "a function call leads to X and Y: put a Function-Call Split between"),
        (signal, "output 1 of C is data, and X waits for a function call"),
        (edge, "C, the event F (SSID 4) leads to the SubSystem block X, which no function call executes"),
        (outside, "the function call of X comes from outside its subsystem"),
        (anew, "StatesWhenEnabling = reset"),
        (reverse, "its outputs are in another layout. Set that to default"),
        (branch, "a function call leads to X and Z: put a Function-Call Split between, or send an event"),
        (backward, "Y feeds X, which one function call executes before it: put a delay between"),
        (to_a_gain, "Split leads to the Gain block G, which no function call executes"),
        (unfed, "no function call comes into Split: connect one, or delete the block"),
        (two_numbers, "its number of iterations must be a whole constant from 1 to 100"),
        (other_rate, "the block Gen runs every 1 s, and the model every 0.1 s: give them one rate"),
    ],
)  # fmt: skip
def test_a_call_without_a_meaning_is_refused(
    draw: Callable[[Calling], None], said: str, tmp_path: Path
) -> None:
    made = Calling("A\ndu: F;", "F")
    draw(made)
    for one in made.refused(tmp_path):
        assert said in one


@pytest.mark.parametrize("word", ["after(1, sec)", "duration(i > 0) > 1", "elapsed(msec) > 10"])
def test_seconds_of_a_called_chart_are_refused(word: str, tmp_path: Path) -> None:
    made = Calling("A\ndu: F; F;", "F")
    block, chart = called_chart(made.root, "D", "P")
    state = chart.state("S")
    chart.transition(None, state)
    chart.transition(state, chart.state("T"), word if word.startswith("after") else f"[{word}]")
    made.root.line(made.event(1), f"{block}#trigger")
    runner = made.runner(tmp_path)
    said = "of a chart that function calls wake up: count its calls with tick, or the time in the chart"
    with pytest.raises(NotLowered, match=said):
        lowered_model(runner.model, "one.slx")
    with pytest.raises(DrawnFault, match=said):
        for _ in range(3):
            runner.step({"u": 0})


def test_a_call_before_the_first_step_is_refused(tmp_path: Path) -> None:
    made = Calling("A\nen: F;", "F", executeAtInitialization=1)
    made.root.line(made.event(1), f"{summing(made.root)}#trigger")
    for one in made.refused(tmp_path):
        assert one.endswith("F is a function call, sent before the first step: send it in a step")
