"""Charts that call blocks: by function calls, as Simulink functions, and atomic subcharts."""

from collections.abc import Iterator

from rovercheck.checker.simulink.writer.packages import WrittenModel
from tests.simulink.by_hand.models import ByHand, Given, Told, tell

CALL = "FUNCTION_CALL_EVENT"


def _calls() -> WrittenModel:
    """Calls in all kinds of actions, of a chart that sees an output of the one that calls it."""
    model = WrittenModel("one", step="0.1")
    block, chart = model.root.chart("C")
    chart.data("u", "input", "int8")
    chart.data("m", "output", "int8")
    for name in "FG":
        chart.event(name, "OUTPUT_EVENT", CALL)
    idle, run = chart.state("Idle"), chart.state("Run\nen: F;\ndu: m = u; send(G);\nex: F;")
    chart.transition(None, idle)
    chart.transition(idle, run, "[u == 1]{F;}/G;")
    chart.transition(run, idle, "[u == 0]")
    other, called = model.root.chart("D")
    called.data("i", "input", "int8")
    called.data("t", "output", "uint32")
    for name in "PQ":
        called.event(name, "INPUT_EVENT", CALL)
    one = called.state(f"S\nen: {tell(9)}\ndu: {tell(1)}\non P: {tell(2)}\non Q: {tell(3)}")
    two = called.state(f"T\nen: {tell(4)}\ndu: {tell(6)}")
    called.transition(None, one)
    called.transition(one, two, "P[i == 3]")
    called.transition(two, one, f"after(2, tick){{{tell(5)}}}")
    mux = model.root.block("Mux", "calls", {"in": 2, "out": 1}, {}, Inputs="2")
    model.root.line(model.root.inport("u", 1, OutDataTypeStr="int8"), block)
    for source, target in (
        (f"{block}/2", f"{mux}/1"), (f"{block}/3", f"{mux}/2"), (mux, f"{other}#trigger"), (block, other),
        (block, model.root.outport("m", 1)), (other, model.root.outport("t", 2)),
    ):  # fmt: skip
        model.root.line(source, target)
    return model


def _calls_by_hand(given: Given) -> Iterator[tuple[float, ...]]:
    say, states, calls, m = Told(), {"C": "", "D": ""}, 0, 0

    def call(event: str) -> None:
        nonlocal calls
        calls += 1
        if not states["D"] or (states["D"] == "T" and calls >= 2):
            say(*((5, 9) if states["D"] else (9,)))
            states["D"], calls = "S", 0
        elif states["D"] == "T":
            say(6)
        elif event == "P" and m == 3:
            say(4)
            states["D"], calls = "T", 0
        else:
            say(1, 2 if event == "P" else 3)

    for u in given:
        if not states["C"]:
            states["C"] = "Idle"
        elif states["C"] == "Idle" and u == 1:
            for event in "PQP":  # the condition action, the transition action, the entry action
                call(event)
            states["C"] = "Run"
        elif states["C"] == "Run" and u == 0:
            call("P")
            states["C"] = "Idle"
        elif states["C"] == "Run":
            m = u
            call("Q")
        yield (m, say.t)


def _function() -> WrittenModel:
    """A Simulink function with a delay, called in guards, in actions and in a MATLAB function."""
    model = WrittenModel("one", step="0.1")
    block, chart = model.root.chart("C")
    chart.data("u", "input", "uint8")
    chart.data("t", "output", "uint32")
    inside = model.root.simulink_function(chart, "y = f(a, b)")
    delay = inside.block("UnitDelay", "sum", {"in": 1, "out": 1}, {}, InitialCondition="uint8(0)")
    add = inside.block("Sum", "add", {"in": 3, "out": 1}, {}, Inputs="+-+")
    inside.line(inside.inport("b", 1, OutDataTypeStr="uint8"), f"{add}/2")
    inside.line(inside.inport("a", 2, OutDataTypeStr="uint8"), f"{add}/1")
    inside.line(delay, f"{add}/3")
    inside.line(add, delay)
    inside.line(delay, inside.outport("y", 1))
    chart.function("y = g(x)", script="function y = g(x)\ny = uint32(f(x, uint8(0))) + 1;\nend\n")
    one = chart.state("A\ndu: t = uint32(f(u, uint8(1))) * 3 + uint32(f(uint8(4), u));")
    two = chart.state("B\nen: t = g(u);")
    chart.transition(None, one)
    chart.transition(one, two, "[f(uint8(2), u) > 100]")
    chart.transition(two, one, "[u == 2]")
    model.root.line(model.root.inport("u", 1, OutDataTypeStr="uint8"), block)
    model.root.line(block, model.root.outport("t", 1))
    return model


def _function_by_hand(given: Given) -> Iterator[tuple[float, ...]]:
    total, state, t = 0, "", 0

    def call(a: int, b: int) -> int:
        nonlocal total
        before, total = total, (total + a - b) % 256
        return before

    for u in given:
        if not state:
            state = "A"
        elif state == "A" and call(2, u) > 100:
            state, t = "B", call(u, 0) + 1
        elif state == "A":
            t = call(u, 1) * 3
            t += call(4, u)
        elif u == 2:
            state = "A"
        yield (t,)


def _atomic() -> WrittenModel:
    """An atomic subchart whose data have other names, beside a state that is commented out."""
    model = WrittenModel("one", step="0.1")
    block, chart = model.root.chart("C")
    chart.data("u", "input", "int8")
    chart.data("t", "output", "uint32")
    state, part = model.root.atomic_subchart(chart, "Part", binding="1 u\n2 t")
    out = chart.state(f"Out\nen: {tell(1)}", more={"isExplicitlyCommented": 1})
    off = chart.state(f"Off\nen: {tell(2)}")
    chart.transition(None, off)
    chart.transition(off, out, "[u == 1]", 1)
    chart.transition(off, state, "[u == 1]", 2)
    chart.transition(state, off, "[u == 3]")
    part.data("x", "input", "int8")
    part.data("said", "output", "uint32")
    said = {digit: f"said = mod(said * 7 + {digit}, 9973);" for digit in (3, 4, 5, 6)}
    one = part.state(f"One\nen: {said[3]}\ndu: {said[4]}\nex: {said[5]}")
    two = part.state(f"Two\nen: {said[6]}")
    part.transition(None, one)
    part.transition(one, two, "[x == 2]")
    model.root.line(model.root.inport("u", 1, OutDataTypeStr="int8"), block)
    model.root.line(block, model.root.outport("t", 1))
    return model


def _atomic_by_hand(given: Given) -> Iterator[tuple[float, ...]]:
    say, state = Told(), ""
    for u in given:
        if not state or (state in ("One", "Two") and u == 3):
            say(*([5] if state == "One" else []), 2)
            state = "Off"
        elif state == "Off" and u == 1:
            say(3)
            state = "One"
        elif state == "One" and u == 2:
            say(5, 6)
            state = "Two"
        elif state == "One":
            say(4)
        yield (say.t,)


CALLS = (
    ByHand("calls", _calls, _calls_by_hand),
    ByHand("function", _function, _function_by_hand),
    ByHand("atomic", _atomic, _atomic_by_hand),
)

__all__ = ["CALLS"]
