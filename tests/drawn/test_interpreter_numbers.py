"""Functions of charts, and the numbers of MATLAB and of C."""

from pathlib import Path

import pytest

from rovercheck.checker.drawn.faults import DrawnFault
from rovercheck.checker.simulink.writer.charts import WrittenChart
from tests.drawn.charts import LOG, logged, running

ADD = """function [y, calls] = add(x)
persistent n
if isempty(n)
    n = 0;
end
n = n + 1;
total = 0;
for k = 1:3
    if k == 2, continue; end
    total = total + k * x;
end
while total > 100
    total = total - 100;
end
switch n
    case {1, 2}
        y = total;
    otherwise
        y = -total;
end
calls = twice(n) / 2;
end
function z = twice(a)
z = 2 * a;
end
"""


def test_a_matlab_function_keeps_its_persistent_variables_once_in_a_chart(tmp_path: Path) -> None:
    def draw(c: WrittenChart) -> None:
        r = [c.state("R1\ndu: [log, n1] = add(u);", order=1), c.state("R2\ndu: [~, n2] = add(u);", order=2)]
        function = c.function("[y, calls] = add(x)", script=ADD)
        c.data("x", "function input", holder=function)
        c.data("y", "function output", holder=function)
        c.data("calls", "function output", holder=function)
        assert r

    outs = {**LOG, "n1": "double", "n2": "double"}
    runner = running(tmp_path, draw, outs=outs, parallel=True)
    assert [tuple(runner.step({"u": 2}).values()) for _ in range(3)] == [(0, 0, 0), (8, 1, 2), (-8, 3, 4)]


def test_a_graphical_function_has_its_own_data_in_every_call(tmp_path: Path) -> None:
    def draw(c: WrittenChart) -> None:
        a = c.state("A\ndu: log = largest(u, 3);")
        f = c.function("m = largest(p, q)")
        for name in "pq":
            c.data(name, "function input", "double", holder=f)
        c.data("m", "function output", "double", holder=f)
        c.data("calls", "local", "double", 0, holder=f)
        start, end = c.junction(f), c.junction(f)
        c.transition(None, a)
        c.transition(None, start, "{calls = calls + 1;}", holder=f)
        c.transition(start, end, "[p > q && calls == 1]{m = p;}", 1, holder=f)
        c.transition(start, end, "{m = q;}", 2, holder=f)

    assert logged(running(tmp_path, draw), [0, 1, 7]) == [0, 3, 7]


def test_in_a_graphical_function_transition_actions_run_at_once(tmp_path: Path) -> None:
    def draw(c: WrittenChart) -> None:
        a = c.state("A\ndu: log = f();")
        f = c.function("m = f()")
        c.data("m", "function output", "double", holder=f)
        start, middle, end = c.junction(f), c.junction(f), c.junction(f)
        c.transition(None, a)
        c.transition(None, start, holder=f)
        c.transition(start, middle, "/ m = 5;", 1, holder=f)
        c.transition(middle, end, "[m == 5]{m = m + 2;}", 1, holder=f)
        c.transition(start, end, "{m = 9;}", 2, holder=f)

    assert logged(running(tmp_path, draw), [0, 0]) == [0, 7]


# --- numbers ------------------------------------------------------------------------------------------------

MATLAB = {
    "int8(2.5)": 3, "int8(-2.5)": -3, "int8(300)": 127, "uint8(-4)": 0, "uint32(700) / uint32(1000)": 1,
    "uint32(400) / uint32(1000)": 0, "uint32(3) - uint32(5)": 0, "uint8(200) + uint8(100)": 255,
    "int16(7) / int16(2)": 4, "int16(-7) / int16(2)": -4, "int32(5) * 0.5": 3, "uint8(5) / 0": 255,
    "double(single(0.1) == 0.1)": 1, "double(single(0.1)) == 0.1": 0, "1 / 0": float("inf"), "mod(-1, 3)": 2,
    "rem(-1, 3)": -1, "mod(5.5, 2)": 1.5, "bitand(uint8(12), uint8(10))": 8, "bitor(uint8(12), 3)": 15,
    "bitxor(uint8(6), uint8(3))": 5, "bitshift(uint8(255), 1)": 254, "bitshift(uint8(12), -2)": 3,
    "bitcmp(uint8(1))": 254, "bitget(uint8(4), 3)": 1, "bitset(uint8(0), 2)": 2, "floor(-1.5)": -2,
    "fix(-1.5)": -1, "round(-2.5)": -3, "ceil(1.2)": 2, "sign(-3)": -1, "abs(int8(-128))": 127,
    "min(3, 2)": 2, "max([1 7 3])": 7, "sum(sum([1 2; 3 4]))": 10, "numel(zeros(1, 4))": 4,
    "pick([1 -2])": -2,
    "any([0 0 1]) && all([1 1])": 1, "2 ^ 10": 1024, "-2 ^ 2": -4, "~1 == 0": 1, "all(1:3 == 1:3)": 1,
    "isequal([1 2], [1 2])": 1, "3 + true": 4, "cast(3.7, 'int8')": 4, "1e3": 1000, "0x1F": 31,
}  # fmt: skip

NOT_LOWERED = ("1 / 0", "~0 & 0xF", "double(single(0.1)) == 0.1")
"""What is refused there, infinity and all bits of a number without a type, or has a computer's digits."""


@pytest.mark.parametrize(("text", "value"), MATLAB.items())
def test_numbers_are_those_of_matlab(tmp_path: Path, text: str, value: float) -> None:
    def draw(c: WrittenChart) -> None:
        a = c.state(f"A\nen: log = double({text});")
        c.function("y = pick(v)", script="function y = pick(v)\ny = v(2);\nend\n")
        c.transition(None, a)

    assert logged(running(tmp_path, draw), [0], lowers=text not in NOT_LOWERED) == [value]


C = {
    "7 / 2": 3, "-7 / 2": -3, "7 %% 4": 3, "(5 & 4) | 1": 5, "6 ^ 3": 5, "1 << 4": 16, "0x80 >> 3": 16,
    "7.0 / 2": 3.5, "!(3 > 2)": 0, "~0 & 0xF": 15, "v[1] + v[0]": 30, "3 == 3 && 2 != 1": 1,
}  # fmt: skip


@pytest.mark.parametrize(("text", "value"), C.items())
def test_numbers_are_those_of_c_where_a_chart_says_so(tmp_path: Path, text: str, value: float) -> None:
    def draw(c: WrittenChart) -> None:
        a = c.state(f"A\nen: log = {text};")
        c.data("v", "local", "int16", "[10 20]", size="[1 2]")
        c.transition(None, a)

    runner = running(tmp_path, draw, language="C with bit operations")
    assert logged(runner, [0], lowers=text not in NOT_LOWERED) == [value]


def test_integers_stop_at_their_ends_or_wrap_as_the_chart_says(tmp_path: Path) -> None:
    def draw(c: WrittenChart) -> None:
        a = c.state("A\nen: n = uint8(250); log = double(n);\ndu: n = n + 10; log = double(n);")
        c.data("n", "local", "uint8")
        c.transition(None, a)

    assert logged(running(tmp_path, draw), [0, 0]) == [250, 255]
    assert logged(running(tmp_path, draw, saturates=False), [0, 0]) == [250, 4]


@pytest.mark.parametrize(
    ("action", "why"),
    [
        ("log = nothing(1);", "nothing is not known here"),
        ("log = int8(1) + int16(1);", "MATLAB takes integers of one type only"),
        ("other = 1;", "there is no datum other to write to"),
        ("log = [1 2];", r"log is of 1x1, and its value of 1x2"),
        ("while true, log = 1; end", "a loop of more than 1,000,000 turns"),
        ("log = f(1);", "calls itself, or more than 100 functions call each other"),
    ],
)
def test_what_has_no_meaning_is_told_with_its_chart(tmp_path: Path, action: str, why: str) -> None:
    def draw(c: WrittenChart) -> None:
        a = c.state(f"A\nen: {action}")
        c.function("y = f(x)", script="function y = f(x)\ny = f(x);\nend\n")
        c.transition(None, a)

    with pytest.raises(DrawnFault, match=f"^C: .*{why}"):
        logged(running(tmp_path, draw), [0])
