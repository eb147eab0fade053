"""Arrays and functions of charts."""

from collections.abc import Callable
from typing import Any

import pytest

from rovercheck.checker.process.isolate import pickled
from rovercheck.spec_model.lang.action import assign, when
from rovercheck.spec_model.lang.array import array
from rovercheck.spec_model.lang.chart import Block, Chart, State, to
from rovercheck.spec_model.lang.domain import boolean, enumeration, fixed, integer
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.evaluate import evaluate, run
from rovercheck.spec_model.lang.expr import Expr, const, flag, var
from rovercheck.spec_model.lang.function import function
from rovercheck.spec_model.lang.words import modulo

WHEELS = enumeration("Wheel", ["FL", "FR", "RL"])
gap, speed = (
    array("gap", 3, integer(0, 9), doc="gap {key}"),
    array("speed", ["FL", "FR", "RL"], integer(0, 9)),
)
ring = array("ring", range(1, 4), fixed(0, 1, "0.5"))
at, wheel, far, half = (
    var("at", integer(0, 2)),
    var("wheel", WHEELS),
    var("far", integer(0, 5)),
    var("h", fixed(0, 2, "0.5")),
)
on = flag("on")


def test_names_and_texts() -> None:
    assert [v.name for v in gap] == ["gap0", "gap1", "gap2"]
    assert [v.name for v in speed] == ["speed_FL", "speed_FR", "speed_RL"]
    assert [v.name for v in ring] == ["ring1", "ring2", "ring3"]
    assert gap.one(1).doc == "gap 1"
    assert len(gap) == 3


@pytest.mark.parametrize("index", range(3))
def test_an_index_that_a_variable_says(index: int) -> None:
    values = {"gap0": 4, "gap1": 5, "gap2": 6, "at": index, "wheel": index, "far": index + 3}
    values |= {"speed_FL": 7, "speed_FR": 8, "speed_RL": 9}
    assert evaluate(gap[at], values) == 4 + index
    assert evaluate(speed[wheel], values) == 7 + index
    assert evaluate(gap[modulo(far, 3)], values) == 4 + index
    run([gap.set(at, 1), speed.set(wheel, 2)], values)
    assert [values[f"gap{k}"] for k in range(3)] == [1 if k == index else 4 + k for k in range(3)]
    assert values[f"speed_{['FL', 'FR', 'RL'][index]}"] == 2


def test_a_shift_register() -> None:
    values = {"gap0": 1, "gap1": 2, "gap2": 3}
    run(gap.push(9), values)
    assert values == {"gap0": 9, "gap1": 1, "gap2": 2}
    assert evaluate(gap.sum(), values) == 12


WRONG: dict[str, tuple[Callable[[], Any], str]] = {
    "too far": (lambda: gap[3], r"gap has no element 3; it has gap\[0\], gap\[1\], gap\[2\]."),
    "before the first": (lambda: gap[-1], "gap has no element -1"),
    "a truth value": (lambda: gap[True], "gap has no element True"),
    "another name": (lambda: speed["XX"], "speed has no element XX"),
    "a constant": (lambda: ring[const(0)], "ring has no element 0"),
    "a variable that may be more": (lambda: gap[far], "`far` may be 3; gap has"),
    "a remainder that may be more": (lambda: gap[modulo(far, 5)], "may be 3; gap has"),
    "a half": (lambda: gap[half], "`h` may be 1/2; gap has"),
    "a flag": (lambda: gap[on], "an index is a number, a name, a variable"),
    "a formula": (lambda: gap[at + 1], "an index is a number, a name, a variable"),
    "another enumeration": (lambda: gap[wheel], "may be FL; gap has"),
    "no elements": (lambda: array("x", 0, boolean), "has no elements; write how many, at least 1"),
    "no keys": (lambda: array("x", [], boolean), "write its keys, numbers or names, each once"),
    "a key twice": (lambda: array("x", ["a", "a"], boolean), "each once"),
    "a key that is none": (lambda: array("x", [1.5], boolean), "each once"),  # type: ignore[list-item]
    "a text for keys": (lambda: array("x", "ab", boolean), "is one text; write keys="),
    "a value of another sort": (lambda: gap.set(1, on), "cannot take `on`"),
}


@pytest.mark.parametrize("wrong", WRONG)
def test_what_has_no_meaning(wrong: str) -> None:
    make, said = WRONG[wrong]
    with pytest.raises(ModelError, match=said):
        make()


# --- functions -----------------------------------------------------------------------------------


@function
def near(d: Expr) -> Expr:
    return d < 7


@function
def reset(d: Any) -> object:
    return [assign(d, 0), when(on, [assign(on, False)])]


def test_a_formula_is_named_like_the_call() -> None:
    assert str(near(far)) == "near(far)"
    assert str(~near(far + 1)) == "!near(far + 1)"
    assert evaluate(near(far), {"far": 6}) == 1
    assert near.call == "near(d)"


def test_actions_are_the_actions() -> None:
    assert list(map(str, reset(far))) == ["far := 0", "if on {on := false}"]


MISUSED: dict[str, tuple[Callable[[], Any], str]] = {
    "too few": (near, r"near\(\) takes 1 argument, not 0; write near\(d\)."),
    "too many": (lambda: near(far, far), "takes 1 argument, not 2"),
    "no function": (lambda: function(5), "function.5. takes a definition"),  # type: ignore[arg-type]
    "a default": (lambda: function(lambda a=1: a), "has the parameter `a=1`; write plain names"),
    "any number": (lambda: function(lambda *a: a), "write plain names"),
    "nothing returned": (function(lambda: None), "returns None, a NoneType"),
    "no actions": (function(lambda: []), "returns nothing"),
    "a number": (function(lambda: 5), "returns 5, an int; return a formula, or a list of actions"),
    "an action for a formula": (lambda: reset.formula(far), "does something and has no value"),
    "a formula for an action": (lambda: near.actions(far), "has a value and does nothing"),
}


@pytest.mark.parametrize("wrong", MISUSED)
def test_a_function_misused(wrong: str) -> None:
    make, said = MISUSED[wrong]
    with pytest.raises(ModelError, match=said):
        make()


def test_a_chart_with_functions_goes_to_another_process() -> None:
    """Its labels are read; what they were read with stays."""
    chart = Chart("C", [State("A", "en: reset(far)", transitions=[to("A", "[near(far)]")])], default="A",
                  data=[near, reset, far, on])  # fmt: skip
    assert chart.label_faults == ()
    assert pickled(chart)
    assert [str(a) for a in chart.states["A",].entry] == ["far := 0", "if on {on := false}"]
    assert str(Block("b", reset(far)).do[0]) == "far := 0"
