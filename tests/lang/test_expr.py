"""Formulas: sorts, units, exact arithmetic, labels, and the errors for what has no meaning."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rovercheck.spec_model.lang.action import assign, send, when
from rovercheck.spec_model.lang.domain import boolean, enumeration, fixed, integer
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.evaluate import evaluate
from rovercheck.spec_model.lang.expr import all_of, any_of, const, flag, implies, ite, var
from rovercheck.spec_model.lang.label import text
from rovercheck.spec_model.lang.time import ms, sec, ticks
from rovercheck.spec_model.lang.walk import structure
from rovercheck.spec_model.lang.words import (
    absolute,
    after,
    bit,
    duration,
    held,
    maximum,
    minimum,
    modulo,
    named,
    quotient,
    rising,
    sign,
    wrap,
)

a, b = flag("a"), flag("b")
mode = var("mode", enumeration("Mode", ["IDLE", "BUSY"]))
other_mode = var("other", enumeration("Other", ["IDLE", "BUSY"]))
count = var("count", integer(0, 20))
yaw = var("yaw", integer(-720, 720, "deg"))
charge = var("charge", fixed(0, 100, 0.1, "%"))
ratio = var("ratio", fixed(-2, 2, 0.25))


@pytest.mark.parametrize(("make", "message"), [
    (lambda: bool(count > 3), "`count > 3` is a formula, not a Python truth value. Write & | ~ for and, or, "
                              "not; ite(), minimum(), maximum() for if, min, max; and "
                              "`(a < x) & (x < b)` for `a < x < b`."),
    (lambda: count & a, "`count` is an integer; `and` needs a condition, such as a comparison. "
                        "Python reads `a & x > 0` as `(a & x) > 0`, and `~` and `|` alike: "
                        "write `a & (x > 0)`."),
    (lambda: mode == "BUZY", "'BUZY' is no member of Mode. Did you mean 'BUSY'?"),
    (lambda: mode == other_mode, "`mode` is a Mode and `other` an Other; compare values of one sort."),
    (lambda: mode < "BUSY", "`mode < BUSY`: a Mode has no order; compare with == or !=."),
    (lambda: charge + yaw, "`+` mixes `charge` in % and `yaw` in deg; "
                           "convert with a factor that has a unit."),
    (lambda: -mode, "`mode` is a Mode; `-` needs a number."),
    (lambda: count / 0, "`count / 0` divides by no constant; divide by a non-zero number."),
    (lambda: modulo(count, -3), "mod by -3 has no meaning; write a positive constant."),
    (lambda: quotient(ratio, 2), "quotient() needs a whole number; `ratio` is a number in steps of 0.25."),
    (lambda: ite(a, mode, const(True)), "`mode` is a Mode and `true` a boolean; "
                                        "both branches need one sort."),
    (lambda: assign(a, count), "a is a boolean and cannot take `count`, an integer."),
    (lambda: assign(count, yaw), "count is in no unit and `yaw` in deg; "
                                 "convert with a factor that has a unit."),
    (lambda: assign(count, ratio), "count has steps of 1 and `ratio` steps of 0.25; give count a resolution "
                                   "that divides both."),
    (lambda: var("x", integer(5, 9), 3), "3 is outside integer in 5..9."),
])  # fmt: skip
def test_slips_are_named(make, message: str) -> None:
    with pytest.raises(ModelError) as error:
        make()
    assert str(error.value) == message


LABELS = [
    ((count > 3) & ~a | b, "count > 3 && !a || b"),
    ((a | b) & (mode == "BUSY"), "(a || b) && mode == BUSY"),
    (charge < 15.5, "charge < 15.5"),
    (minimum(ratio + 1, 2) == ratio * 2, "min(ratio + 1, 2) == ratio*2"),
    (named("stale", count > 3) & a, "stale && a"),
    (ite(a, count, 0) == 2, "(a ? count : 0) == 2"),
    (after(1 * sec) | (duration(a) > 3 * sec), "after(1 s) || duration(a) > 3 s"),
    (rising(count) & held(b, 500 * ms), "rising(count > 0) && held(b, 500 ms)"),
    (duration(a) >= 2 * ticks, "duration(a) >= 2 ticks"),
    (bit(count, 2) & (absolute(ratio) > 1), "bit(count, 2) && abs(ratio) > 1"),
    (modulo(count, 3) - (ratio - 1) == 0, "count mod 3 - (ratio - 1) == 0"),
]


@pytest.mark.parametrize(("formula", "label"), LABELS)
def test_labels(formula, label: str) -> None:
    assert text(formula) == str(formula) == label


def test_labels_of_actions() -> None:
    shown = when(a, [assign(count, count + 1), send("e", "R")], [assign(mode, "BUSY")])
    assert str(shown) == "if a {count := count + 1; send(e, R)} else {mode := BUSY}"


@pytest.mark.parametrize(("formula", "at", "value"), [
    (charge + 0.25 > 15.5, {"charge": 153}, 1),
    (charge + 0.25 > 15.5, {"charge": 152}, 0),
    (ratio * ratio == 0.5625, {"ratio": 3}, 1),
    (ratio / 2 < -0.3, {"ratio": -3}, 1),
    (sign(ratio) == -1, {"ratio": -1}, 1),
    (sign(ratio) == 0, {"ratio": 0}, 1),
    (implies(a, b), {"a": 1, "b": 0}, 0),
    (all_of(), {}, 1),
    (any_of(), {}, 0),
    (maximum(count, 4) == 4, {"count": 3}, 1),
    (quotient(count, 3) == 2, {"count": 8}, 1),
])  # fmt: skip
def test_values(formula, at: dict[str, int], value: int) -> None:
    assert evaluate(formula, at) == value


@given(st.integers(-720, 720))
def test_wrap_keeps_angles_within_half_a_turn(angle: int) -> None:
    wrapped = evaluate(wrap(yaw), {"yaw": angle})
    assert -180 <= wrapped < 180
    assert (wrapped - angle) % 360 == 0


@given(st.integers(-8, 8), st.integers(0, 20))
def test_arithmetic_between_resolutions_is_exact(quarters: int, whole: int) -> None:
    at = {"ratio": quarters, "count": whole}
    assert evaluate(ratio + count < count * ratio, at) == (quarters / 4 + whole < whole * quarters / 4)
    assert evaluate(ratio >= count - 1.75, at) == (quarters / 4 >= whole - 1.75)


def test_structure_sees_through_names_and_objects() -> None:
    assert structure(named("x", count > 3)) == structure(count > 3)
    assert structure(count > 3) != structure(count > 4)
    assert structure(var("count", integer(0, 20)) > 3) == structure(count > 3)


def test_initial_values() -> None:
    assert var("x", integer(5, 9)).init == 5
    assert var("x", integer(-5, 9)).init == 0
    assert var("x", fixed(0, 1, 0.5), 0.5).init == 1
    assert var("x", boolean, True).init == 1


x_, b_ = var("x", integer(0, 9)), flag("b")


class Whole:
    """A whole number of somebody else's."""

    def __index__(self) -> int:
        return 3


@pytest.mark.parametrize("three", [np.int64(3), np.uint8(3), np.float32(3), Whole()])
def test_numbers_of_others_are_numbers_on_either_side(three: Any) -> None:
    """NumPy's integers were refused beside a formula."""
    left = [x_ < three, x_ == three, x_ + three, x_ - three, x_ * three, x_ / three]
    right = [three > x_, three == x_, three + x_, three - x_, three * x_]
    assert [str(f) for f in left] == ["x < 3", "x == 3", "x + 3", "x - 3", "x*3", "x*1/3"]
    if not isinstance(three, Whole):
        assert [str(f) for f in right] == ["x < 3", "x == 3", "3 + x", "3 - x", "3*x"]
    assert type(const(three).value) is int and structure(const(three)) == structure(const(3))


def test_truth_values_of_others_are_truth_values_and_no_numbers() -> None:
    yes: Any = np.bool_(True)
    assert [str(f) for f in (b_ & yes, yes & b_, b_ == yes, const(yes))] == [
        "b && true", "true && b", "b == true", "true",
    ]  # fmt: skip
    with pytest.raises(ModelError, match="has no meaning beside an integer"):
        x_ + yes


def test_small_numbers_of_others_do_not_overflow() -> None:
    assert str(const(np.uint8(200)) + np.uint8(100)) == "200 + 100"
    assert evaluate(x_ * np.int8(100) * np.int8(100), {"x": 9}) == 90_000


def test_what_is_quoted_keeps_its_parentheses() -> None:
    """`(x + 1) % 7` was told as `x + 1 % 7`."""
    for make, said in (
        (lambda: (x_ + 1) % 7, r"`\(x \+ 1\) % 7`: write modulo\(x \+ 1, 7\)"),
        (lambda: (x_ + 1) // (x_ - 1), r"`\(x \+ 1\) // \(x - 1\)`: write quotient"),
        (lambda: (x_ * 2) % (x_ * 3), r"`x\*2 % \(x\*3\)`: write"),
        (lambda: (x_ + 1) / 0, r"`\(x \+ 1\) / 0` divides"),
        (lambda: (b_ | ~b_) < b_, r"`\(b \|\| !b\) < b`: a boolean has no order"),
    ):
        with pytest.raises(ModelError, match=said):
            make()
