"""Charts that call blocks: by function calls, as Simulink functions, and atomic subcharts."""

from collections.abc import Iterator

from rovercheck.checker.simulink.writer.packages import WrittenModel
from rovercheck.checker.simulink.writer.systems import WrittenSystem
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


def _split() -> WrittenModel:
    """A call that splits hand on to a subsystem, a chart and a subsystem again, in the order of outputs."""
    model = WrittenModel("one", step="0.1")
    root = model.root
    block, chart = root.chart("C")
    chart.data("u", "input", "int8")
    chart.data("back", "input", "int16")
    chart.data("m", "output", "int16")
    chart.event("F", "OUTPUT_EVENT", CALL)
    state = chart.state("A\ndu: m = int16(u); F; m = back; if u == 2, F; end")
    chart.transition(None, state)
    first, last = _adding(root, "First", 10), _adding(root, "Last", 100)
    other, called = root.chart("D")
    called.data("i", "input", "int16")
    called.data("t", "output", "uint32")
    called.event("P", "INPUT_EVENT", CALL)
    one, two = called.state(f"S\nen: {tell(1)}\ndu: {tell(2)}"), called.state(f"T\nen: {tell(3)}")
    called.transition(None, one)
    called.transition(one, two, "P[i > 25]")
    called.transition(two, one, "[i < 20]")
    outer = root.block("FunctionCallSplit", "outer", {"in": 1, "out": 2}, {})
    inner = root.block("FunctionCallSplit", "inner", {"in": 1, "out": 2}, {}, OutputPortLayout="default")
    root.line(root.inport("u", 1, OutDataTypeStr="int8"), block)
    for source, target in (
        (f"{block}/2", outer), (f"{outer}/2", f"{last}#trigger"), (outer, inner),
        (inner, f"{first}#trigger"), (f"{inner}/2", f"{other}#trigger"), (block, first), (first, other),
        (first, last), (last, f"{block}/2"), (block, root.outport("m", 1)), (other, root.outport("t", 2)),
        (last, root.outport("s", 3)),
    ):  # fmt: skip
        root.line(source, target)
    return model


def _adding(root: WrittenSystem, name: str, number: int) -> str:
    """A called subsystem that gives what comes in, a number, and what it gave before, modulo 2 ** 16."""
    sub, inside = root.subsystem(name, 1, 1, "trigger")
    inside.block("TriggerPort", "call", {}, {}, TriggerType="function-call")
    delay = inside.block("UnitDelay", "last", {"in": 1, "out": 1}, {}, InitialCondition="int16(0)")
    bias = inside.block("Constant", "bias", {"out": 1}, {}, Value=f"int16({number})")
    add = inside.block("Sum", "add", {"in": 3, "out": 1}, {}, Inputs="+++", OutDataTypeStr="int16")
    for source, target in (
        (inside.inport("i", 1, OutDataTypeStr="int16"), add), (delay, f"{add}/2"), (bias, f"{add}/3"),
        (add, delay), (add, inside.outport("o", 1)),
    ):  # fmt: skip
        inside.line(source, target)
    return sub


def _wrapped(value: int) -> int:
    return (value + 2**15) % 2**16 - 2**15


def _split_by_hand(given: Given) -> Iterator[tuple[float, ...]]:
    say, entered, state, m, first, last = Told(), False, "", 0, 0, 0
    for u in given:
        for number in range(2 if u == 2 else 1) if entered else ():
            m = m if number else u
            first = _wrapped(first + m + 10)
            if not state or (state == "T" and first < 20):
                say(1)
                state = "S"
            elif state == "S" and first > 25:
                say(3)
                state = "T"
            elif state == "S":
                say(2)
            last = _wrapped(last + first + 100)
            m = m if number else last
        entered = True
        yield (m, say.t, last)


def _generator() -> WrittenModel:
    """A generator that calls a subsystem and a chart three times in each step, beside one that calls once."""
    model = WrittenModel("one", step="0.1")
    root = model.root
    library = "simulink/Ports & Subsystems/Function-Call Generator"
    kind = {"SourceBlock": library, "SourceType": "Function-Call Generator", "sample_time": "0.1"}
    thrice = root.block("Reference", "thrice", {"out": 1}, {}, **kind, numberOfIterations="3")
    once = root.block("Reference", "once", {"out": 1}, {}, **kind)
    split = root.block("FunctionCallSplit", "split", {"in": 1, "out": 2}, {})
    adds, more = _adding(root, "Adds", 1), _adding(root, "More", 2)
    block, chart = root.chart("D")
    chart.data("i", "input", "int16")
    chart.data("t", "output", "uint32")
    chart.event("P", "INPUT_EVENT", CALL)
    one, two = chart.state(f"S\nen: {tell(1)}\ndu: {tell(2)}"), chart.state(f"T\nen: {tell(3)}")
    chart.transition(None, one)
    chart.transition(one, two, "[mod(i, int16(3)) == 0]")
    chart.transition(two, one, "[after(2, tick)]")
    given = root.inport("u", 1, OutDataTypeStr="int16")
    for source, target in (
        (thrice, split), (split, f"{adds}#trigger"), (f"{split}/2", f"{block}#trigger"), (adds, block),
        (once, f"{more}#trigger"), (given, adds), (adds, more), (block, root.outport("t", 1)),
        (adds, root.outport("a", 2)), (more, root.outport("b", 3)),
    ):  # fmt: skip
        root.line(source, target)
    return model


def _generator_by_hand(given: Given) -> Iterator[tuple[float, ...]]:
    say, state, calls, adds, more = Told(), "", 0, 0, 0
    for u in given:
        for _ in range(3):
            adds, calls = _wrapped(adds + u + 1), calls + 1
            if not state or (state == "T" and calls >= 2):
                say(1)
                state = "S"
            elif state == "S" and adds % 3 == 0:
                say(3)
                state, calls = "T", 0
            elif state == "S":
                say(2)
        more = _wrapped(more + adds + 2)
        yield (say.t, adds, more)


CALLS = (
    ByHand("split", _split, _split_by_hand),
    ByHand("generator", _generator, _generator_by_hand),
    ByHand("calls", _calls, _calls_by_hand),
    ByHand("function", _function, _function_by_hand),
    ByHand("atomic", _atomic, _atomic_by_hand),
)

__all__ = ["CALLS"]
