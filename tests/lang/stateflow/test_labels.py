"""Labels that people write: what they mean, and what is told of those that mean nothing."""

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rovercheck.spec_model.lang.action import Action, assign, send, when
from rovercheck.spec_model.lang.array import array
from rovercheck.spec_model.lang.chart import Chart, Junction, State, to
from rovercheck.spec_model.lang.domain import enumeration, integer
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.expr import Expr, const, flag, ite, member, var
from rovercheck.spec_model.lang.function import function
from rovercheck.spec_model.lang.stateflow.message import LabelError, LabelText
from rovercheck.spec_model.lang.stateflow.names import LabelNames
from rovercheck.spec_model.lang.stateflow.statements import actions_of, errors_of, state_of, transition_of
from rovercheck.spec_model.lang.stateflow.syntax import DEEPEST, LONGEST
from rovercheck.spec_model.lang.time import ms, sec, ticks
from rovercheck.spec_model.lang.walk import structure
from rovercheck.spec_model.lang.wellformed import check_chart
from rovercheck.spec_model.lang.words import after, duration, maximum, modulo, named, quotient, rising
from tests.lang.stateflow.test_printed_labels import built

MODE = enumeration("Mode", ["BAKE", "GRILL", "OFF"])
LAMP = enumeration("Lamp", ["OFF", "LIT"])
mode, lamp = var("mode", MODE), var("lamp", LAMP)
start, door = flag("start"), flag("door_open")
minutes, left = var("minutes", integer(0, 9, "min")), var("left", integer(0, 540, "s"))
age, level, count = (
    var("age", integer(0, 900, "ms")),
    var("level", integer(0, 100, "%")),
    var("n", integer(0, 9)),
)
speed = array("speed", ["FL", "FR"], integer(0, 50, "rpm"))
gap = array("gap", 3, integer(0, 9))
which = var("which", integer(0, 2))


@function
def near(d: Expr) -> Expr:
    return d < 7


@function
def reset() -> object:
    return [assign(count, 0), assign(left, 0)]


DATA = (mode, lamp, start, door, minutes, left, age, level, count, speed, gap, which, near, reset)
fast = named("much too fast", speed["FL"] > 40)
motor = Chart("Motor", [State("On"), State("Off")], default="On")


def names() -> LabelNames:
    known = LabelNames()
    for datum in (*DATA, fast, motor):
        known.add(datum)
    return known


NAMES = names()

MEANT = {
    "[start && !door_open]": start & ~door,
    "[start & ~door_open]": start & ~door,
    "[start || door_open && start]": start | (door & start),
    "[start | door_open && start]": (start | door) & start,
    "[mode == GRILL]": mode == "GRILL",
    "[mode == Mode.GRILL]": mode == "GRILL",
    "[OFF == mode]": member(MODE, "OFF") == mode,
    "[mode == OFF || lamp ~= OFF]": (mode == "OFF") | (lamp != "OFF"),
    "[age > 300]": age > 300,
    "[age > 0.3 s]": age > 300,
    "[age >= 0x1F]": age >= 31,
    "[level > 80 %]": level > 80,
    "[level > 80 % && start]": (level > 80) & start,
    "[level > 80.]": level > 80,
    "[after(3 s)]": after(3 * sec),
    "[after(3, sec)]": after(3 * sec),
    "[after(250, msec) && start]": after(250 * ms) & start,
    "[after(2, tick)]": after(2 * ticks),
    "after(3, sec)[start]": after(3 * sec) & start,
    "[duration(start) > 3 s]": duration(start) > 3 * sec,
    "[duration(start, msec) >= 300]": duration(start) >= 300 * ms,
    "[duration(level > 80) < 2]": ~(duration(level > 80) >= 2 * sec),
    "[rising(start)]": rising(start),
    "[60 * minutes > left]": const(60, "s/min") * minutes > left,
    "[left / 60 < minutes]": left * const("1/60", "min/s") < minutes,
    "[n % 3 == 1]": modulo(count, 3) == 1,
    "[n mod 3 == 1]": modulo(count, 3) == 1,
    "[n div 3 == 1]": quotient(count, 3) == 1,
    "[max(n, 3) > 4]": maximum(count, 3) > 4,
    "[(start ? n : 3) > 4]": ite(start, count, 3) > 4,
    "[speed[FL] > 10]": speed["FL"] > 10,
    "[speed_FR > 10]": speed["FR"] > 10,
    "[gap[2] == 1]": gap[2] == 1,
    "[gap[which] == 1]": gap[which] == 1,
    "[near(n)]": near(count),
    "[much too fast]": fast,
    "[!(much too fast) && start]": ~fast & start,
    "[in(Motor.On)]": motor.active("On"),
    "[Motor == On]": motor.active("On"),
    "/* why */ [start] // so": start & True,
    "[start ...\n && door_open]": start & door,
    "[xor(start, door_open)]": start != door,
}


@pytest.mark.parametrize("label", MEANT)
def test_a_condition(label: str) -> None:
    guard = transition_of(label, NAMES).guard
    assert guard is not None
    meant = start if "why" in label else MEANT[label]
    assert structure(guard) == structure(meant)


DONE: dict[str, list[Action]] = {
    "left = 60 * minutes": [assign(left, const(60, "s/min") * minutes)],
    "left := 60 s/min * minutes": [assign(left, const(60, "s/min") * minutes)],
    "n = 1; left = 0": [assign(count, 1), assign(left, 0)],
    "n = 1, left = 0": [assign(count, 1), assign(left, 0)],
    "n = 1\nleft = 0": [assign(count, 1), assign(left, 0)],
    "n++": [assign(count, count + 1)],
    "n--;": [assign(count, count + -1)],
    "n += 2": [assign(count, count + 2)],
    "n -= 2;": [assign(count, count - 2)],
    "mode = OFF": [assign(mode, "OFF")],
    "lamp = OFF;": [assign(lamp, "OFF")],
    "lamp = start ? OFF : LIT": [assign(lamp, ite(start, member(LAMP, "OFF"), member(LAMP, "LIT")))],
    "send(stop, Motor.Left)": [send("stop", "Motor.Left")],
    "reset()": [assign(count, 0), assign(left, 0)],
    "gap[1] = 4": [assign(gap.one(1), 4)],
    "gap[which] = 4": [gap.set(which, 4)],
    "push(gap, n)": [*gap.push(count)],
    "if start {n = 1} else {n = 2}": [when(start, [assign(count, 1)], [assign(count, 2)])],
    "if start\n  n = 1\nelse\n  n = 2\nleft = 0": [
        when(start, [assign(count, 1)], [assign(count, 2)]), assign(left, 0),
    ],
    "if start, n = 1; elseif door_open, n = 2; else n = 3; end; left = 0": [
        when(start, [assign(count, 1)], [when(door, [assign(count, 2)], [assign(count, 3)])]),
        assign(left, 0),
    ],
    "if start\n  if door_open\n    n = 1\n  left = 0\nn = 2": [
        when(start, [when(door, [assign(count, 1)]), assign(left, 0)]), assign(count, 2),
    ],
}  # fmt: skip


@pytest.mark.parametrize("text", DONE)
def test_actions(text: str) -> None:
    assert built(actions_of(text, NAMES)) == built(tuple(DONE[text]))
    assert built(transition_of(f"{{{text}}}", NAMES).do) == built(tuple(DONE[text]))
    assert built(transition_of(f"/ {text}", NAMES).then) == built(tuple(DONE[text]))
    assert built(state_of(f"exit: {text}", NAMES).exit) == built(tuple(DONE[text]))


def test_a_whole_label() -> None:
    read = transition_of("stop [start] {n = 1;} / left = 60 * minutes; n = 2", NAMES)
    assert (read.event, built(read.guard)) == ("stop", built(start))
    assert built(read.do) == built((assign(count, 1),))
    assert built(read.then) == built((assign(left, const(60, "s/min") * minutes), assign(count, 2)))


@pytest.mark.parametrize("label", ["", " ", "[]", "\n"])
def test_a_label_that_says_nothing(label: str) -> None:
    read = transition_of(label, NAMES)
    assert (read.event, read.guard, read.do, read.then) == (None, None, (), ())


def test_sections_of_a_state() -> None:
    read = state_of("n = 1\nen, du: n = 2;\nex: n = 3; during: n = start ? 4 : 5", NAMES)
    assert [len(read.entry), len(read.during), len(read.exit)] == [2, 2, 1]


WRONG = {
    "[dor_open]": ("`dor_open` is unknown here. Did you mean 'door_open'?", "dor_open"),
    "[start && ]": ("`]` has no meaning here; expected a value, such as a signal or a number.", "]"),
    "[start": ("the label ends too early; expected `]`", ""),
    "[start = 1]": ("`=` assigns: compare with `==`", "="),
    "level > 80": ("a condition stands in brackets: `[level > 80]`", ">"),
    "start": ("`start` is a datum, no event; a condition stands in brackets: `[start]`.", "start"),
    "[start] n = 1": ("`n` has no meaning here; expected `/`, `{` or the end of the label.", "n"),
    "[level]": ("`level` is an integer in %; `[...]` needs a condition, such as a comparison.", "level"),
    "[level && start]": ("`level` is an integer in %; `&&` needs a condition", "level"),
    "[start && level > mode]": ("`level` is an integer in % and `mode` a Mode", "level > mode"),
    "[start > 3]": ("`start` is a boolean", "start > 3"),
    "[age > left]": ("mixes `age` in ms and `left` in s; convert", "age > left"),
    "[mode == BAEK]": ("`BAEK` is unknown here. Did you mean 'BAKE'?", "BAEK"),
    "[mode == LIT]": ("`mode` is a Mode and `LIT` a Lamp; compare values of one sort.", "mode == LIT"),
    "[Mode.BAEK == mode]": ("`BAEK` is no member of Mode. Did you mean 'BAKE'?", "Mode.BAEK"),
    "[OFF == OFF]": ("`OFF` is a member of Mode and of Lamp; write `Mode.OFF`.", "OFF"),
    "[x ^ 2 > 3]": ("a power has no meaning here", "^"),
    "[n ≤ 3]": ("write `<=`", "≤"),
    "[n > 1 > 2]": ("`>` has no meaning here; expected", ">"),
    "[after(3)]": ("`3` has no unit; write `3 s` or `3 ms`.", "3"),
    "[after(3 km)]": ("`km` is no unit of time; write `ms`, `s`, `min` or `ticks`.", "3 km"),
    "[after(3, start)]": ("`start` is no unit of time", "start"),
    "[duration(start)]": ("a duration is compared with a time", "duration(start)"),
    "[before(3, sec)]": ("`before()` is no word of charts here; write `!after(...)`.", "before(3, sec)"),
    "[neear(n)]": ("there is no function `neear`. Did you mean 'near'?", "neear(n)"),
    "[near(n, n)]": ("near() takes 1 argument, not 2; write near(d).", "near(n, n)"),
    "[reset()]": ("reset() does something and has no value", "reset()"),
    "{near(n)}": ("near() has a value and does nothing", "near(n)"),
    "[speed > 3]": ("`speed` is an array; write one of it", "speed"),
    "[speed[XX] > 3]": ("`XX` is unknown here.", "XX"),
    "[gap[3] > 3]": ("gap has no element 3; it has gap[0], gap[1], gap[2].", "gap[3]"),
    "[gap[n] > 3]": ("`n` may be 3; gap has", "gap[n]"),
    "[level[1] > 3]": ("`level` is no array; write `level` alone.", "level[1]"),
    "[n / 0 > 1]": ("a division by 0 has no meaning.", "0"),
    "[n / n > 1]": ("`n` is no constant; divide by a number", "n"),
    "[2 n > 1]": ("an operator is missing; write `2 * n`.", "2 n"),
    "[level > 3 level]": ("an operator is missing; write `3 * level`.", "3 level"),
    "[a b]": ("`b` has no meaning here; expected an operator, such as `&&`, before it.", "b"),
    "E | F [start]": ("two events on one transition; draw a transition for each.", "F"),
    "every(2, E) [start]": ("`every(...)` is no event here", "every(2, E)"),
    "{start = 1}": ("`1` is a number; write `true`.", "1"),
    "{n = start}": ("n is an integer and cannot take `start`, a boolean.", "n = start"),
    "{left = age}": ("left is in s and `age` in ms; convert", "left = age"),
    "{n = 1 left = 0}": ("`=` has no meaning here; write `;` between two actions.", "="),
    "{near = 1}": ("`near` is a function; write `near(d)`.", "near"),
    "{BAKE = 1}": ("`BAKE` is the member of an enumeration and takes no value", "BAKE"),
    "{stop}": ("`stop` does nothing; write an assignment", "stop"),
    "{send(stop)}": ("send() names an event and a state", "send(stop)"),
    "{if start n = 1}": ("the actions of an `if` stand in braces", "n"),
    "{n = 'x'}": ("texts have no meaning here", "'"),
    "[start] → [door_open]": ("write each on its own", "→"),
    "{n /= 2}": ("`/=` has no meaning here", "/="),
    "[start\x00]": ("the sign U+0000 cannot be shown; leave it out.", "\x00"),
    "[start\u202e]": ("the sign U+202E cannot be shown", "\u202e"),
    "[\ue000]": ("the sign U+E000 cannot be shown", "\ue000"),
    "[\ue002ntry]": ("the sign U+E002 cannot be shown", "\ue002"),
}


@pytest.mark.parametrize("label", WRONG)
def test_a_label_without_meaning(label: str) -> None:
    """The message, and the part of the label that it points at."""
    said, part = WRONG[label]
    with pytest.raises(LabelError) as error:
        transition_of(label, NAMES)
    first = errors_of(error.value)[0]
    assert said in first.said
    assert label[first.at.start : first.at.end] == part
    caret = LabelText(label).fault("x", first).splitlines()[-1]
    assert caret.count("^") == max(len(part), 1)


def test_all_that_is_wrong_with_a_label() -> None:
    with pytest.raises(LabelError) as error:
        transition_of("E | F [dor_open] {n = 'x'; } / y = 1", NAMES)
    assert len(errors_of(error.value)) == 1, "what is no text is told alone"
    with pytest.raises(LabelError) as error:
        transition_of("E | F [dor_open] {n = start; if strat {left = mode}} / y = 1", NAMES)
    parts = [e.said.split("`")[1] for e in errors_of(error.value) if "`" in e.said]
    assert len(errors_of(error.value)) == 6
    assert parts[0] == "dor_open"


@given(st.text(max_size=60))
def test_any_text_is_read_or_refused(text: str) -> None:
    for read in (transition_of, state_of, actions_of):
        try:
            read(text, NAMES)
        except LabelError as error:
            for one in errors_of(error):
                assert 0 <= one.at.start <= len(text)
                assert LabelText(text).fault("x", one).strip()


# fmt: off
ALPHABET = ["[", "]", "{", "}", "/", "(", ")", "start", "n", "3", " ", "&&", "!", ">", "=", ";", "if", "else",
            "end", "\n", ",", "mode", "OFF", "after", "s", "?", ":", "-", "*", "%", "gap", "en:",
            "much too fast", "duration", "1/3", "push", "reset"]
# fmt: on


@given(st.lists(st.sampled_from(ALPHABET), max_size=14))
def test_words_in_any_order(words: list[str]) -> None:
    for read in (transition_of, state_of, actions_of):
        try:
            read(" ".join(words), NAMES)
        except LabelError as error:
            assert all(one.said.strip() for one in errors_of(error))


@pytest.mark.parametrize(
    "label",
    [
        f"[{'(' * 5000}start{')' * 5000}]",
        f"[{'(' * (DEEPEST + 1)}start",
        "[" + "x" * (LONGEST + 1) + "]",
        "[" + " && ".join(["strat"] * 3000),
    ],
)
def test_labels_that_nobody_writes(label: str) -> None:
    with pytest.raises(LabelError) as error:
        transition_of(label, NAMES)
    told = LabelText(label).fault("x", errors_of(error.value)[0])
    assert len(told) < 1000


def test_long_labels_that_can_be_read() -> None:
    guard = transition_of("[" + " && ".join(["start"] * 2000) + "]", NAMES).guard
    assert guard is not None
    assert structure(guard) == ("and", *[structure(start)] * 2000)
    assert transition_of(f"[{'(' * 90}start{')' * 90}]", NAMES).guard is start


def test_nesting_that_cannot_be_followed() -> None:
    """Neither can the formula, written in Python, be printed."""
    chart = Chart("C", [State("A", transitions=[to("A", f"[{'!' * 3000}start]")])], default="A", data=[start])
    [fault] = chart.label_faults
    assert "nested too deeply" in fault


# --- in charts -----------------------------------------------------------------------------------


def test_a_chart_of_texts_is_the_chart_of_formulas() -> None:
    texts = Chart("C", [
        State("A", "en: n = 1\ndu: n = min(n + 1, 9)", transitions=[
            to("B", "[start && n > 3] / left = 60 * minutes"), to("j", "stop"),
        ]),
        State("B", transitions=[to("A", "after(3, sec)")]),
    ], default=[to("B", "[start]"), to("A")], junctions=[to_junction("[door_open]")], data=DATA)  # fmt: skip
    written = Chart("C", [
        State("A", entry=[assign(count, 1)], during=[assign(count, ite(count + 1 < 9, 1, 1))], transitions=[
            to("B", when=start & (count > 3), then=[assign(left, const(60, "s/min") * minutes)]),
            to("j", on="stop"),
        ]),
        State("B", transitions=[to("A", when=after(3 * sec))]),
    ], default=[to("B", when=start), to("A")])  # fmt: skip
    assert texts.label_faults == ()
    for one, other in zip(texts.states["A",].transitions, written.states["A",].transitions, strict=True):
        assert built((one.guard, one.do, one.then)) == built((other.guard, other.do, other.then))
        assert (one.event, one.label) == (other.event, None)
    assert built(texts.root.default[0].guard) == built(start)
    assert built(texts.junctions["j",].transitions[0].guard) == built(door)


def to_junction(label: str) -> Junction:
    return Junction("j", [to("A", label), to("B")])


def test_names_of_formulas_in_the_chart_need_no_data() -> None:
    states = [State("A", transitions=[to("B", when=start)]), State("B", transitions=[to("A", "[!start]")])]
    chart = Chart("C", states, default="A")
    assert chart.label_faults == ()


def test_every_fault_has_its_line_and_column(tmp_path: Path) -> None:
    file = tmp_path / "m.py"
    file.write_text(
        "from rovercheck.spec_model.lang.chart import Chart, State, to\n"
        "from rovercheck.spec_model.lang.expr import flag\n"
        "ü, start = flag('ü'), flag('start')\n"
        "C = Chart('C', [\n"
        "    State('A', 'en: strt = true', transitions=[\n"
        "        to('A', '[ü && strt]'), to('A', '[ü && strt]'),\n"
        '        to("A", """[start\n'
        '            && strt]"""),\n'
        "        to('A', f'[{\"strt\"}]'),\n"
        "        to('A', '[\\x73trt]'),\n"
        "    ]),\n"
        "], default='A', data=[start, ü])\n",
        encoding="utf-8",
    )
    scope: dict[str, object] = {"__name__": "m"}
    exec(compile(file.read_text(encoding="utf-8"), str(file), "exec"), scope)
    chart = scope["C"]
    assert isinstance(chart, Chart)
    where = [fault.partition(str(file))[2].split(" ")[0] for fault in chart.label_faults]
    assert where == [":6:24:", ":6:48:", ":8:16:", ":9:", ":10:", ":5:21:"]
    with pytest.raises(ModelError) as error:
        check_chart(chart)
    assert str(error.value).count("^^^^") == len(chart.label_faults)
    assert all("Did you mean 'start'?" in fault for fault in chart.label_faults)


@pytest.mark.parametrize(
    ("data", "said"),
    [
        ([5], "data holds 5; write variables"),
        ([flag("x"), var("x", integer(0, 1))], "two data are named x"),
        ([array("a", 2, integer(0, 1)), array("a", 3, integer(0, 1))], "two data are named a"),
    ],
)
def test_data_that_are_none(data: list[object], said: str) -> None:
    with pytest.raises(ModelError, match=said):
        check_chart(Chart("C", [State("A")], default="A", data=data))


def test_a_text_and_actions_beside_it() -> None:
    with pytest.raises(ModelError, match="write all in the label"):
        to("A", "[start]", then=[assign(count, 1)])
    with pytest.raises(ModelError, match="write all in the text"):
        State("A", "en: n = 1", entry=[assign(count, 1)])
