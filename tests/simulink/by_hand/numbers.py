"""Numbers, functions and diagrams: models by hand."""

from collections.abc import Iterator
from itertools import pairwise

from rovercheck.checker.simulink.writer.charts import WrittenChart
from rovercheck.checker.simulink.writer.packages import WrittenModel
from tests.simulink.by_hand.models import ByHand, Given, Told, held, nearest, one_chart, tell

_KINDS = {"a": "uint8", "b": "int8", "q": "int16"}


def _matlab(c: WrittenChart) -> None:
    c.transition(None, c.state("A\nen, du: a = a + uint8(90) - uint8(u); b = b - u; q = int16(b) / 4;"))


def _saturated_by_hand(given: Given) -> Iterator[tuple[float, ...]]:
    a = b = 0
    for u in given:
        a = held(held(a + 90, 0, 255) - held(u, 0, 255), 0, 255)
        b = held(b - u, -128, 127)
        yield a, b, nearest(b, 4)


def _c_language(c: WrittenChart) -> None:
    c.language, c.saturates = "C with bit operations", False
    c.data("list", "local", "int8", "[5 6 7]", "[1 3]")
    text = "a = (a << 1) ^ (u & 7); b = b / 2 - u; q = -7 %% 3 + list[1] + (u > 0);"
    c.transition(None, c.state(f"A\nen: {text}\ndu: {text}"))


def _c_by_hand(given: Given) -> Iterator[tuple[float, ...]]:
    a = b = 0
    for u in given:
        a = ((a << 1) & 255) ^ (u & 7)
        half = abs(b) // 2
        b = ((half if b >= 0 else -half) - u + 128) % 256 - 128
        yield a, b, -1 + 6 + (u > 0)


_SCRIPT = """function y = next(x)
persistent n
if isempty(n)
  n = 0;
end
n = mod(n + 1, 5);
y = n + x;
end
"""


def _persistent(c: WrittenChart) -> None:
    """Both regions call a function that remembers, which it does once in a chart."""
    c.parallel = True
    for number in (1, 2):
        c.state(f"R{number}\ndu: t = mod(t * 7 + next({number}), 9973);", order=number)
    c.function("y = next(x)", script=_SCRIPT)


def _persistent_by_hand(given: Given) -> Iterator[tuple[float, ...]]:
    say, n = Told(), 0
    for step, _ in enumerate(given):
        for x in (1, 2) if step else ():
            n = (n + 1) % 5
            say(n + x)
        yield (say.t,)


def _graphical(c: WrittenChart) -> None:
    """A flow chart as a function: its data begin anew, and transition actions run at once."""
    c.transition(None, c.state("A\nen, du: t = f(u);"))
    f = c.function("r = f(v)")
    c.data("v", "function input", "int8", holder=f)
    c.data("r", "function output", "uint32", holder=f)
    c.data("n", "local", "uint8", 0, holder=f)
    start, turn, end = c.junction(f), c.junction(f), c.junction(f)
    c.transition(None, start, holder=f)
    c.transition(start, turn, "[v > 0]/r = uint32(5);", 1, holder=f)
    c.transition(start, end, "{r = uint32(100);}", 2, holder=f)
    c.transition(turn, turn, "[n < v]{n = n + 1; r = r * 2;}", 1, holder=f)
    c.transition(turn, end, "[r > 11]{r = r + 1;}", 2, holder=f)


def _graphical_by_hand(given: Given) -> Iterator[tuple[float, ...]]:
    for u in given:
        found = 5 * 2**u if u > 0 else 100
        if u > 0:  # where nothing goes on from the turn, the way back is tried: with 100
            found = found + 1 if found > 11 else 100
        yield (found,)


def _flow(c: WrittenChart) -> None:
    """A chart without states, whose outputs begin anew in every step."""
    first, end = c.junction(), c.junction()
    c.data("n", "local", "uint8")
    c.transition(None, first, "[u > 0]{n = mod(n + 1, 10); t = uint32(n);}", 1)
    c.transition(first, end, "[u == 2]{t = t + 50;}", 1)


def _flow_by_hand(given: Given) -> Iterator[tuple[float, ...]]:
    n = 0
    for u in given:
        n = (n + 1) % 10 if u > 0 else n
        yield (n + 50 * (u == 2) if u > 0 else 0,)


def _triggered() -> WrittenModel:
    """Events by their edges: each of a step runs the chart once, in their order."""
    model = WrittenModel("one", step="0.1")
    u, both = (
        model.root.inport("u", 1, OutDataTypeStr="int8"),
        model.root.block("Mux", "m", {"in": 2, "out": 1}),
    )
    less = model.root.block("Gain", "g", {"in": 1, "out": 1}, Gain="-1")
    block, chart = model.root.chart("C")
    chart.data("t", "output", "uint32")
    chart.event("UP", "INPUT_EVENT", "RISING_EDGE_EVENT")
    chart.event("ANY", "INPUT_EVENT", "EITHER_EDGE_EVENT")
    chart.transition(
        None, chart.state(f"A\nen: {tell(1)}\ndu: {tell(2)}\non UP: {tell(3)}\non ANY: {tell(4)}")
    )
    for source, target in ((u, f"{both}/1"), (u, less), (less, f"{both}/2"), (both, f"{block}#trigger")):
        model.root.line(source, target)
    model.root.line(block, model.root.outport("t", 1))
    return model


def _triggered_by_hand(given: Given) -> Iterator[tuple[float, ...]]:
    say, begun = Told(), False
    yield (0,)
    for before, u in pairwise(given):
        occur = [3] * (before <= 0 < u) + [4] * ((before < 0) != (u < 0))
        for one in occur:
            say(*((2, one) if begun else (1,)))
            begun = True
        yield (say.t,)


def _enabled() -> WrittenModel:
    """A subsystem that runs while u is above 0, a delay behind it, and a wire without ink."""
    model = WrittenModel("one", step="0.1")
    root = model.root
    u = root.inport("u", 1, OutDataTypeStr="int8")
    block, inside = root.subsystem("Sub", 1, 1, "enable")
    inside.block("EnablePort", "Enable", {}, {})
    port = inside.inport("i", 1)
    counter, chart = inside.chart("Count")
    chart.data("i", "input", "int8")
    chart.data("n", "output", "uint8", 7)
    chart.transition(None, chart.state("A\nen: n = uint8(1);\ndu: n = mod(n + uint8(i), 100);"))
    inside.line(port, counter)
    inside.line(counter, inside.outport("n", 1))
    to, back = root.block("Goto", "to", {"in": 1}, GotoTag="n"), root.block("From", "from", GotoTag="n")
    delay = root.block("UnitDelay", "d", {"in": 1, "out": 1}, InitialCondition="uint8(9)")
    for source, target in ((u, block), (u, f"{block}#enable"), (block, to), (back, delay)):
        root.line(source, target)
    root.line(block, root.outport("now", 1))
    root.line(delay, root.outport("before", 2))
    return model


def _enabled_by_hand(given: Given) -> Iterator[tuple[float, ...]]:
    n, begun, delay = 7, False, 9
    for u in given:
        if u > 0:
            n, begun = (n + u) % 100 if begun else 1, True
        yield n, delay
        delay = n


NUMBERS = (
    ByHand(
        "saturated", one_chart(_matlab, _KINDS),
        _saturated_by_hand, (-100, -3, 0, 1, 5, 120),
    ),
    ByHand("c", one_chart(_c_language, _KINDS), _c_by_hand,
        (-100, -3, 0, 1, 5, 120)),
    ByHand("persistent", one_chart(_persistent), _persistent_by_hand),
    ByHand("graphical", one_chart(_graphical), _graphical_by_hand),
    ByHand(
        "flow", one_chart(_flow, initializeOutput=1),
        _flow_by_hand,
    ),
    ByHand("triggered", _triggered, _triggered_by_hand, (-1, 0, 1, 2, -2)),
    ByHand("enabled", _enabled, _enabled_by_hand),
)  # fmt: skip

__all__ = ["NUMBERS"]
