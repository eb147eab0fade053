"""The combination of buttons that switches backward driving: its order, its second, its memory of edges."""

from itertools import permutations
from math import nan

import pytest

from rovercheck.supervisor.backward import BackwardToggle, Combo

NONE, BTN1, BTN2, BOTH = (0, 0), (1, 0), (0, 1), (1, 1)


def run(toggle, *buttons, x=0.0, y=0.0):
    for btn1, btn2 in buttons:
        toggle.step(x, y, btn1, btn2)
    return toggle.state


def waiting(*presses):
    """A toggle after its first execution and the presses, each one step long, buttons released."""
    toggle = BackwardToggle()
    run(toggle, NONE, *(b for press in presses for b in (press, NONE)))
    return toggle


def test_whole_combination_toggles_both_ways():
    toggle = BackwardToggle()
    press = (BTN1, NONE, BTN1, NONE, BTN2, NONE)
    run(toggle, NONE, *press)
    assert not toggle.backward_enabled
    run(toggle, BTN2)
    assert toggle.backward_enabled
    run(toggle, NONE, *press, BTN2)
    assert not toggle.backward_enabled
    assert toggle.state is Combo.STARTING_POINT


@pytest.mark.parametrize("order", sorted({*permutations([BTN1, BTN1, BTN2, BTN2])}))
def test_only_the_right_order_toggles(order):
    toggle = waiting(*order)
    assert toggle.backward_enabled == (order == (BTN1, BTN1, BTN2, BTN2))


def test_no_edge_in_the_first_execution():
    toggle = BackwardToggle()
    assert run(toggle, BTN1, BTN1) is Combo.STARTING_POINT
    assert run(toggle, NONE, BTN1) is Combo.STEP2


def test_a_held_button_is_one_press():
    toggle = waiting()
    assert run(toggle, *[BTN1] * 10) is Combo.STEP2


def test_both_buttons_at_once_count_once_per_step():
    toggle = waiting()
    run(toggle, BOTH, NONE, BOTH, NONE, BOTH, NONE)
    assert toggle.state is Combo.STEP4
    assert not toggle.backward_enabled
    run(toggle, BOTH)
    assert toggle.backward_enabled


@pytest.mark.parametrize("presses", [[BTN1], [BTN1, BTN1], [BTN1, BTN1, BTN2]])
def test_a_second_without_press_starts_anew(presses):
    toggle = waiting(*presses)  # the state was entered one step ago
    entered = toggle.state
    assert run(toggle, *[NONE] * 48) is entered
    assert run(toggle, NONE) is Combo.STARTING_POINT


@pytest.mark.parametrize(
    "presses, press, reached",
    [
        ([BTN1], BTN1, Combo.STEP3),
        ([BTN1, BTN1], BTN2, Combo.STEP4),
        ([BTN1, BTN1, BTN2], BTN2, Combo.STARTING_POINT),
    ],
)
def test_a_press_in_the_step_of_the_timeout_counts(presses, press, reached):
    toggle = waiting(*presses)
    run(toggle, *[NONE] * 48)
    assert run(toggle, press) is reached
    assert toggle.backward_enabled == (reached is Combo.STARTING_POINT)


def test_each_state_has_a_whole_second():
    toggle = waiting()
    for press in (BTN1, BTN1, BTN2, BTN2):
        run(toggle, *[NONE] * 49, press)
    assert toggle.backward_enabled


@pytest.mark.parametrize("axes", [{"x": 0.1}, {"x": -0.1}, {"y": 0.1}, {"y": -0.1}, {"x": nan}, {"y": nan}])
def test_moving_the_joystick_starts_anew(axes):
    toggle = waiting(BTN1)
    assert run(toggle, BTN1, **axes) is Combo.STARTING_POINT
    assert run(toggle, NONE, BTN1, **axes) is Combo.STARTING_POINT


def test_an_edge_is_remembered_while_it_is_not_asked_for():
    toggle = waiting()
    run(toggle, BTN1, x=1.0)
    assert run(toggle, BTN1) is Combo.STARTING_POINT
    assert run(toggle, NONE, BTN2, BTN1) is Combo.STEP2
    run(toggle, (0, 1), (1, 1))
    assert toggle.state is Combo.STEP3
    assert run(toggle, (0, 1)) is Combo.STEP3
