"""Data stores: blocks and charts that share a memory, in the order that signals, calls and priorities say."""

from collections.abc import Iterator

from rovercheck.checker.simulink.writer.packages import WrittenModel
from tests.simulink.by_hand.models import ByHand, Given

CALL = "FUNCTION_CALL_EVENT"


def _shared() -> WrittenModel:
    """A chart that reads and writes a memory, calls a subsystem that does, too, and blocks around it."""
    model = WrittenModel("one", step="0.1")
    root = model.root
    root.block("DataStoreMemory", "Memory", {}, {}, DataStoreName="A", InitialValue="int16(5)")
    before = root.block("DataStoreRead", "before", {"out": 1}, {}, DataStoreName="A", Priority="1")
    block, chart = root.chart("C")
    chart.data("u", "input", "int16")
    chart.data("r", "input", "int16")
    chart.data("t", "output", "int16")
    chart.data("m", "output", "int16")
    chart.data("A", "data store", "Inherit: Same as Simulink")
    chart.event("F", "OUTPUT_EVENT", CALL)
    one = chart.state("One\ndu: A = A + u; F; t = A; m = r;")
    two = chart.state("Two\nen: A = A - r;\ndu: m = A;")
    chart.transition(None, one)
    chart.transition(one, two, "[u == 3]")
    chart.transition(two, one, "[A > 0 && u == 1]{A = int16(2);}")
    called, inside = root.subsystem("X", 0, 0, "trigger")
    inside.block("TriggerPort", "call", {}, {}, TriggerType="function-call")
    read = inside.block("DataStoreRead", "read", {"out": 1}, {}, DataStoreName="A")
    twice = inside.block("Gain", "twice", {"in": 1, "out": 1}, {}, Gain="2", OutDataTypeStr="int16")
    inside.line(read, twice)
    inside.line(twice, inside.block("DataStoreWrite", "write", {"in": 1}, {}, DataStoreName="A"))
    less = root.block("Sum", "less", {"in": 2, "out": 1}, {}, Inputs="+-", OutDataTypeStr="int16")
    write = root.block("DataStoreWrite", "write", {"in": 1}, {}, DataStoreName="A", Priority="3")
    after = root.block("DataStoreRead", "after", {"out": 1}, {}, DataStoreName="A", Priority="4")
    given = root.inport("u", 1, OutDataTypeStr="int16")
    for source, target in (
        (given, block), (before, f"{block}/2"), (f"{block}/3", f"{called}#trigger"), (f"{block}/1", less),
        (given, f"{less}/2"), (less, write), (f"{block}/1", root.outport("t", 1)),
        (f"{block}/2", root.outport("m", 2)), (before, root.outport("b", 3)), (after, root.outport("a", 4)),
    ):  # fmt: skip
        root.line(source, target)
    root.say(block, Priority="2")
    return model


def _wrapped(value: int) -> int:
    return (value + 2**15) % 2**16 - 2**15


def _shared_by_hand(given: Given) -> Iterator[tuple[float, ...]]:
    store, state, t, m = 5, "", 0, 0
    for u in given:
        r = store
        if not state:
            state = "One"
        elif state == "One" and u == 3:
            state, store = "Two", _wrapped(store - r)
        elif state == "Two" and store > 0 and u == 1:
            state, store = "One", 2
        elif state == "One":
            store = _wrapped(_wrapped(store + u) * 2)  # the second in the subsystem that is called
            t, m = store, r
        else:
            m = store
        store = _wrapped(t - u)
        yield (t, m, r, store)


def _hidden() -> WrittenModel:
    """A memory in an enabled subsystem hides the one around it; what was read stays while it is disabled."""
    model = WrittenModel("one", step="0.1")
    root = model.root
    root.block("DataStoreMemory", "A", {}, {}, DataStoreName="A", InitialValue="int8(7)")
    root.block("DataStoreMemory", "B", {}, {}, DataStoreName="B", OutDataTypeStr="int8", InitialValue="1")
    given = root.inport("u", 1, OutDataTypeStr="int8")
    sub, inside = root.subsystem("S", 1, 2, "enable")
    inside.block("EnablePort", "on")
    inside.block("DataStoreMemory", "A", {}, {}, DataStoreName="A", InitialValue="int8(3)")
    read = inside.block("DataStoreRead", "old", {"out": 1}, {}, DataStoreName="A")
    add = inside.block("Sum", "add", {"in": 2, "out": 1}, {}, Inputs="++", OutDataTypeStr="int8")
    inside.line(read, add)
    inside.line(inside.inport("i", 1, OutDataTypeStr="int8"), f"{add}/2")
    inside.line(add, inside.block("DataStoreWrite", "new", {"in": 1}, {}, DataStoreName="A"))
    inside.line(add, inside.block("DataStoreWrite", "out", {"in": 1}, {}, DataStoreName="B"))
    inside.line(read, inside.outport("o", 1))
    inside.line(add, inside.outport("sum", 2))
    outer = root.block("DataStoreRead", "outer", {"out": 1}, {}, DataStoreName="A")
    both = root.block("Sum", "both", {"in": 2, "out": 1}, {}, Inputs="++", OutDataTypeStr="int8")
    write = root.block("DataStoreWrite", "keep", {"in": 1}, {}, DataStoreName="A")
    last = root.block("DataStoreRead", "last", {"out": 1}, {}, DataStoreName="B", Priority="1")
    root.say(sub, Priority="2")
    for source, target in (
        (given, sub), (given, f"{sub}#enable"), (outer, both), (f"{sub}/2", f"{both}/2"), (both, write),
        (sub, root.outport("o", 1)), (outer, root.outport("a", 2)), (last, root.outport("b", 3)),
    ):  # fmt: skip
        root.line(source, target)
    return model


def _hidden_by_hand(given: Given) -> Iterator[tuple[float, ...]]:
    outer, inner, other, out, total = 7, 3, 1, 0, 0
    for u in given:
        last, a = other, outer
        if u > 0:
            out, inner = inner, (inner + u + 128) % 256 - 128
            total = other = inner
        outer = (outer + total + 128) % 256 - 128
        yield (out, a, last)


STORES = (
    ByHand("shared store", _shared, _shared_by_hand),
    ByHand("hidden store", _hidden, _hidden_by_hand),
)

__all__ = ["STORES"]
