"""Numbers of both languages, functions, and tables of truth: models by hand."""

from collections.abc import Iterator
from itertools import pairwise
from math import trunc

from rovercheck.checker.simulink.writer.charts import WrittenChart, WrittenTable
from rovercheck.checker.simulink.writer.packages import WrittenModel
from tests.simulink.by_hand.models import ByHand, Given, Told, held, nearest, one_chart, tell


def _integers(c: WrittenChart) -> None:
    """An integer with a double is computed in double, rounded to the nearest, and stops at its ends."""
    text = "a = uint8(u) / 4 + uint8(700 / 1000); b = uint8(3) - uint8(u);"
    c.transition(None, c.state(f"A\nen, du: {text}\nd = int8(u) * 1.5; e = int16(u) / int16(2);"))


def _integers_by_hand(given: Given) -> Iterator[tuple[float, ...]]:
    for u in given:
        above, more = max(u, 0), held(nearest(3 * u, 2), -128, 127)
        yield nearest(above, 4) + 1, max(3 - above, 0), more, nearest(u, 2)


def _wrapping(c: WrittenChart) -> None:
    """Where a chart says that integers wrap, what is assigned does; a datum may take its type from that."""
    c.saturates = False
    c.data("p", "local")
    text = "p = p + uint8(3); a = p; b = int16(u) * 5; d = u > 0;"
    c.transition(None, c.state(f"A\nen: p = uint8(250); a = p;\ndu: {text}"))


def _wrapping_by_hand(given: Given) -> Iterator[tuple[float, ...]]:
    """The types of outputs are uint8, int8 and boolean."""
    p = 250
    for number, u in enumerate(given):
        if number == 0:
            yield 250, 0, 0
            continue
        p = (p + 3) % 256
        yield p, (u * 5 + 128) % 256 - 128, u > 0


def _numbers_of_c(c: WrittenChart) -> None:
    """Integers of C: quotients towards 0, the larger type, and stops at the ends where the chart says so."""
    c.language = "C with bit operations"
    text = "a = u / 2; b = a + int16(100) * u; d = uint8(u + 3) + 250; e = b / 7 * 2.0; "
    c.transition(None, c.state(f"A\nen: {text}\ndu: {text}"))


def _numbers_of_c_by_hand(given: Given) -> Iterator[tuple[float, ...]]:
    """The types of outputs are int8, int16, uint8 and int16."""
    for u in given:
        a = trunc(u / 2)
        b = a + 100 * u
        yield a, b, held(held(u + 3, 0, 255) + 250, 0, 255), trunc(b / 7) * 2


def _bits(c: WrittenChart) -> None:
    text = (
        "v = uint8(u); a = bitor(bitand(v, uint8(6)), bitshift(v, 3));\n"
        "b = bitxor(bitcmp(v), bitshift(v, -1));\n"
        "d = bitget(v, 2) + bitget(v, 1) * 2; e = int16(bitset(v, 8));"
    )
    c.data("v", "local", "uint8")
    c.transition(None, c.state(f"A\nen, du: {text}"))


def _bits_by_hand(given: Given) -> Iterator[tuple[float, ...]]:
    for u in given:
        yield (u & 6) | ((u << 3) & 255), (255 - u) ^ (u >> 1), (u >> 1 & 1) + 2 * (u & 1), u | 128


_FUNCTIONS = """
a = mod(u, 5) + 10 * rem(u, 5);
b = sign(u) * abs(u) + max(u, 3) - min(u, int8(2));
g = double(u) / 4;
d = int16(floor(g) + 10 * round(g) + 100 * fix(g));
v = [u 0 3];
w = zeros(1, 3, 'int8'); w(2) = u; w(end) = cast(3, 'int8');
e = int16(all(v) + 2 * any(w)) + int16(sum(w)) * 4 + int16(isequal(w, [0 u 3])) * 100;
"""


def _functions(c: WrittenChart) -> None:
    c.data("g", "local", "double")
    c.data("v", "local", "int8", size="[1 3]")
    c.data("w", "local", "int8", size="[1 3]")
    c.transition(None, c.state(f"A\nen, du:{_FUNCTIONS}"))


def _functions_by_hand(given: Given) -> Iterator[tuple[float, ...]]:
    for u in given:
        remainder = abs(u) % 5 * (1 if u >= 0 else -1)
        x = u / 4
        yield (
            u % 5 + 10 * remainder, u + max(u, 3) - min(u, 2), u // 4 + 10 * nearest(u, 4) + 100 * trunc(x),
            2 + (u + 3) * 4 + 100,
        )  # fmt: skip


def _truths(c: WrittenChart) -> None:
    """A number is true when it is not 0, an array when all in it are; what is not needed is not computed."""
    c.function("y = counted(x)", script="function y = counted(x)\nt = t + 10;\ny = x;\nend\n")
    text = "if u, t = t + 1; end\nif [u 1 2], t = t + 1; end\n"
    text += "if u > 1 && counted(u > 2) || counted(false), t = t + 2; end"
    c.transition(None, c.state(f"A\ndu: t = uint32(u ~= 0) + true;\n{text}"))


def _truths_by_hand(given: Given) -> Iterator[tuple[float, ...]]:
    for number, u in enumerate(given):
        calls = (u > 1) + (u <= 2)
        yield ((3 if u else 0) + 1 + 10 * calls + 2 * (u > 2) if number else 0,)


def _singles(c: WrittenChart) -> None:
    """With a single a double is rounded to single before anything is computed."""
    c.transition(None, c.state("A\nen, du: s = single(u) * 0.25 + 1; a = single(0.1) == 0.1;"))


def _singles_by_hand(given: Given) -> Iterator[tuple[float, ...]]:
    for u in given:
        yield u / 4 + 1, 1


_BLOCK = """function [low, high] = of_block(second, u)
persistent n
if isempty(n)
  n = uint8(250);
end
n = n + 3;
high = more(n) + second;
low = uint8(u);
end
function y = more(x)
y = x - 200;
end
"""


def _matlab_block() -> WrittenModel:
    """A MATLAB function as a block: its data have the names of the function's, in an order of their own."""
    model = WrittenModel("one", step="0.1")
    block, function = model.root.chart("F", "MATLAB Function", _BLOCK)
    function.data("u", "input")
    function.data("high", "output")
    function.data("second", "input")
    function.data("low", "output")
    seven = model.root.block("Constant", "seven", {"out": 1}, Value="uint8(7)")
    model.root.line(model.root.inport("u", 1, OutDataTypeStr="int8"), block)
    model.root.line(seven, f"{block}/2")
    for number, name in enumerate(("high", "low"), 1):
        model.root.line(f"{block}/{number}", model.root.outport(name, number))
    return model


def _matlab_block_by_hand(given: Given) -> Iterator[tuple[float, ...]]:
    """Integers of such a block stop at their ends."""
    n = 250
    for u in given:
        n = min(n + 3, 255)
        yield n - 200 + 7, max(u, 0)


_BANDS = WrittenTable(
    ["LOW: v < 2", "v == 3 || u == 0"], ["TT HIGH", "TF 1;3", "FT 2", "-- 3"],
    ["r = uint8(1);", "HIGH: r = uint8(20) + uint8(v);", "r = r + uint8(100);"],
)  # fmt: skip
_OF_TABLE = """function r = f(v)
if v < 2 && (v == 3 || u == 0)
  r = uint8(20) + uint8(v);
elseif v < 2
  r = uint8(101);
elseif v == 3 || u == 0
  r = uint8(20) + uint8(v);
else
  r = uint8(100);
end
end
"""


def _table(c: WrittenChart, made: bool = False) -> None:
    """A truth table that is a function; with ``made`` Stateflow left the script that it made of it."""
    table = c.truth_table("r = f(v)", _BANDS)
    table.script = _OF_TABLE if made else ""
    c.data("v", "function input", "int8", holder=table)
    c.data("r", "function output", "uint8", holder=table)
    c.transition(None, c.state("A\nen: t = uint32(0);\ndu: t = uint32(f(u)) + 1000;"))


def _table_by_hand(given: Given) -> Iterator[tuple[float, ...]]:
    for number, u in enumerate(given):
        found = 20 + u if u in (0, 3) else 101 if u < 2 else 100
        yield (1000 + found if number else 0,)


def _table_of_c(c: WrittenChart) -> None:
    """A truth table in C, which keeps what no action writes at the value of its result."""
    c.language = "C"
    grid = WrittenTable(["v > 2", "v & 4"], ["TF 1", "-T 2"], ["r = 3;", "r = v * 2;"])
    table = c.truth_table("r = f(v)", grid)
    c.data("v", "function input", "int8", holder=table)
    c.data("r", "function output", "int8", holder=table)
    c.transition(None, c.state("A\nen: t = 0;\ndu: t = f(u) + 1;"))


def _table_of_c_by_hand(given: Given) -> Iterator[tuple[float, ...]]:
    for number, u in enumerate(given):
        yield (1 + (2 * u if u else 0) if number else 0,)


def _table_flow(c: WrittenChart) -> None:
    """A truth table beside which the flow chart stands that Stateflow made of it."""
    c.language = "C"
    table = c.truth_table("r = f(v)", WrittenTable(["v > 2"], ["T 1", "- 2"], ["r = 3;", "r = v * 2;"]))
    c.data("v", "function input", "int8", holder=table)
    c.data("r", "function output", "int8", holder=table)
    start, first, end = c.junction(table), c.junction(table), c.junction(table)
    made = [
        c.transition(None, start, holder=table),
        c.transition(start, first, "[v > 2]{r = 3;}", 1, holder=table),
        c.transition(start, end, "{r = v * 2;}", 2, holder=table),
        c.transition(first, end, holder=table),
    ]
    for one in made:
        one.inside = {"autogen": {"isAutoCreated": 1}}
    c.transition(None, c.state("A\nen: t = 0;\ndu: t = f(u) + 1;"))


def _table_flow_by_hand(given: Given) -> Iterator[tuple[float, ...]]:
    for number, u in enumerate(given):
        yield (1 + (3 if u > 2 else 2 * u) if number else 0,)


def _table_block() -> WrittenModel:
    """A truth table as a block, and the table of a state machine, which is read as a chart."""
    model = WrittenModel("one", step="0.1")
    first, chart = model.root.chart("T", "Truth Table")
    chart.data("u", "input", "int8")
    chart.data("r", "output", "uint8")
    kernel = WrittenTable(["u > 1", "u == 3"], ["TT 1", "T- 2", "-- 3"], ["r = 5;", "r = 6;", "r = 7;"])
    chart.truth_table("truth_table_kernel()", kernel)
    chart.transition(None, chart.junction(), "{truth_table_kernel();}")
    second, table = model.root.chart("S", "State Transition Table")
    table.data("r", "input", "uint8")
    table.data("t", "output", "uint32")
    a, b = table.state(f"A\nen: {tell(1)}"), table.state(f"B\nen: {tell(2)}\ndu: {tell(3)}")
    table.transition(None, a)
    table.transition(a, b, f"[r == 5]{{{tell(4)}}}", 1)
    table.transition(a, a, f"[r == 6]{{{tell(5)}}}", 2)
    table.transition(b, a, "[r == 7]")
    u = model.root.inport("u", 1, OutDataTypeStr="int8")
    for source, target in (
        (u, first), (first, second), (second, model.root.outport("t", 1)), (first, model.root.outport("r", 2))
    ):  # fmt: skip
        model.root.line(source, target)
    return model


def _table_block_by_hand(given: Given) -> Iterator[tuple[float, ...]]:
    say, state = Told(), ""
    for u in given:
        r = 5 if u == 3 else 6 if u > 1 else 7
        if not state:
            say(1)
            state = "A"
        elif state == "A" and r < 7:
            say(*((4, 2) if r == 5 else (5, 1)))
            state = "B" if r == 5 else "A"
        elif state == "B":
            say(*((1,) if r == 7 else (3,)))
            state = "A" if r == 7 else "B"
        yield say.t, r


def _reaching(c: WrittenChart) -> None:
    """A function of MATLAB in a chart of C reads and writes the data of the chart; its signature is long."""
    c.language, c.saturates = "C", False
    c.data("n", "local", "int8", 2)
    script = "function [p, q] = far(x)\nn = n + 1;\nif n > 100\n  n = int8(0);\nend\np = n / 4; q = x;\nend\n"
    function = c.function("[p, q] ...\n = far(x)", script=script)
    for name, scope in {"x": "function input", "p": "function output", "q": "function output"}.items():
        c.data(name, scope, "int8", holder=function)
    c.data("i", "temporary", "int8")
    c.data("k", "constant", "int8", 3)
    c.transition(None, c.state("A\ndu: [i, t] = far(u); t = t * 7 + i + k + n;"))


def _reaching_by_hand(given: Given) -> Iterator[tuple[float, ...]]:
    n = 2
    for number, u in enumerate(given):
        if not number:
            yield (0,)
            continue
        n = n + 1 if n < 100 else 0
        yield (u * 7 + nearest(n, 4) + 3 + n,)


def _counted_edges() -> WrittenModel:
    """A chart with one input event, at its falling edge; its data are frozen between."""
    model = WrittenModel("one", step="0.1")
    block, chart = model.root.chart("C")
    chart.data("x", "input", "int8")
    chart.data("t", "output", "uint32", 5)
    chart.event("DOWN", "INPUT_EVENT", "FALLING_EDGE_EVENT")
    a, b = chart.state(f"A\nen: {tell(1)}"), chart.state(f"B\ndu: {tell(2)}\non DOWN: {tell(3)}")
    chart.transition(None, a)
    chart.transition(a, b, f"DOWN[x == -1]/{tell(4)}")
    chart.transition(b, a, "after(2, DOWN)")
    u = model.root.inport("u", 1, OutDataTypeStr="int8")
    model.root.line(u, block)
    model.root.line(u, f"{block}#trigger")
    model.root.line(block, model.root.outport("t", 1))
    return model


def _counted_edges_by_hand(given: Given) -> Iterator[tuple[float, ...]]:
    say, state, seen = Told(), "", 0
    say.t = 5
    yield (say.t,)
    for before, u in pairwise(given):
        if before > 0 >= u:
            seen += 1
            if not state or (state == "B" and seen >= 2):
                say(1)
                state = "A"
            elif state == "A" and u == -1:
                say(4)
                state, seen = "B", 0
            elif state == "B":
                say(2, 3)
        yield (say.t,)


_INTEGERS = {"a": "uint8", "b": "uint8", "d": "int8", "e": "int16"}
VALUES = (
    ByHand(
        "integers", one_chart(_integers, _INTEGERS), _integers_by_hand,
        (-100, -7, -3, 0, 1, 2, 5, 6, 90, 127),
    ),
    ByHand(
        "wrapping", one_chart(_wrapping, {"a": "uint8", "b": "int8", "d": "boolean"}), _wrapping_by_hand,
        (-100, -3, 0, 1, 25, 26, 127),
    ),
    ByHand(
        "numbers_of_c", one_chart(_numbers_of_c, {"a": "int8", "b": "int16", "d": "uint8", "e": "int16"}),
        _numbers_of_c_by_hand, (-7, -3, -1, 0, 1, 2, 3, 9),
    ),
    ByHand(
        "bits", one_chart(_bits, {"a": "uint8", "b": "uint8", "d": "uint8", "e": "int16"}), _bits_by_hand,
        (0, 1, 2, 5, 7, 77, 127),
    ),
    ByHand(
        "functions", one_chart(_functions, {"a": "int8", "b": "int8", "d": "int16", "e": "int16"}),
        _functions_by_hand, (-9, -6, -2, -1, 0, 1, 2, 3, 6, 7, 9),
    ),
    ByHand("truths", one_chart(_truths), _truths_by_hand),
    ByHand("singles", one_chart(_singles, {"s": "single", "a": "boolean"}), _singles_by_hand),
    ByHand("matlab_block", _matlab_block, _matlab_block_by_hand, (-3, 0, 1, 100)),
    ByHand("table", one_chart(_table), _table_by_hand, (0, 1, 2, 3)),
    ByHand("table_made", one_chart(lambda c: _table(c, made=True)), _table_by_hand, (0, 1, 2, 3)),
    ByHand("table_of_c", one_chart(_table_of_c), _table_of_c_by_hand, (0, 1, 2, 3, 4)),
    ByHand("table_flow", one_chart(_table_flow), _table_flow_by_hand, (0, 1, 2, 3, 4)),
    ByHand("table_block", _table_block, _table_block_by_hand),
    ByHand("reaching", one_chart(_reaching, {"t": "int16"}), _reaching_by_hand, (-3, 0, 2, 9)),
    ByHand("counted_edges", _counted_edges, _counted_edges_by_hand, (-2, -1, -1, 0, 1, 2, 3)),
)  # fmt: skip

__all__ = ["VALUES"]
