"""Systems without their dead branches: in every tick they do what the whole ones do."""

from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rovercheck.checker.encode import values as known_values
from rovercheck.checker.encode.dead_branches import narrowed
from rovercheck.checker.encode.value_sets import FEW, Values, joined
from rovercheck.checker.encode.values import values
from rovercheck.checker.system.intervals import Interval
from rovercheck.checker.system.text import SystemText
from rovercheck.spec_model.lang.action import Assign, If, assign
from rovercheck.spec_model.lang.domain import integer
from rovercheck.spec_model.lang.expr import FALSE, TRUE, Expr, Var, all_of, any_of, flag, ite, var
from rovercheck.spec_model.lang.system import TransitionSystem
from tests import naive
from tests.profiles import examples
from tests.strategies_timed import timed_systems
from tests.strategies_ts import transition_systems

level, fault, other = var("level", integer(0, 9)), flag("fault"), flag("other")
on = flag("on")


def toy(*step: Assign | If, assume: Expr = TRUE) -> TransitionSystem:
    return TransitionSystem("toy", (on,), (), (level, fault, other), (), step, assume)


def same(system: TransitionSystem) -> None:
    least = narrowed(system)
    assert least.system.variables == system.variables
    whole, less = naive.search(system, system.variables), naive.search(least.system, system.variables)
    assert whole.states == less.states
    assert whole.reached == less.reached
    assert least.values == values(system)
    again = narrowed(system, [least.values])
    assert again.values == least.values and written(again.system) == written(least.system)


def written(system: TransitionSystem) -> str:
    text = SystemText()
    text.system(system)
    return text.digest


@given(transition_systems())
def test_the_states_and_the_ticks_to_them_stay_the_same(system: TransitionSystem) -> None:
    same(system)


@given(transition_systems())
def test_also_where_every_input_is_held(system: TransitionSystem) -> None:
    """As in a scene: most branches are dead there."""
    same(replace(system, inputs=tuple(map(held, system.inputs))))


def held(free: Var) -> Var:
    return replace(free, domain=replace(free.domain, values=(free.init,)))


@examples(40)
@given(timed_systems())
def test_also_of_charts_with_timers(system: TransitionSystem) -> None:
    same(system)


@given(transition_systems(), st.data())
def test_also_with_wrong_guesses_of_what_variables_are_worth(
    system: TransitionSystem, data: st.DataObject
) -> None:
    """Values are left out, added, or of another system; one guess may be right."""
    fewer, more = (
        {
            v.name: data.draw(some_values(v), label=v.name)
            for v in system.variables
            if data.draw(st.booleans())
        }
        for _ in range(2)
    )
    right = values(system)
    guesses = data.draw(st.permutations([{**right, **fewer}, {**right, **more}, fewer, {}]))
    least = narrowed(system, guesses)
    whole, less = naive.search(system, system.variables), naive.search(least.system, system.variables)
    assert whole.states == less.states
    assert whole.reached == less.reached
    held = {v.name for v in system.frozen}
    for name, found in right.items():
        assert name in held or joined(found, least.values[name]) == least.values[name]


def some_values(of: Var) -> st.SearchStrategy[Values]:
    low, high = of.domain.low, of.domain.high
    ends = st.tuples(st.integers(low - 1, high + 1), st.integers(low - 1, high + 1))
    return st.one_of(
        st.frozensets(st.integers(low, high), min_size=1, max_size=FEW), ends.map(lambda two: Interval(*two))
    )


# --- what is left ----------------------------------------------------------------------------------------


def left(*step: Assign | If, assume: Expr = TRUE) -> str:
    return "; ".join(map(str, narrowed(toy(*step, assume=assume)).system.step))


def test_of_two_branches_only_the_one_that_is_taken_is_left() -> None:
    assert left(If(fault, (assign(level, 7),), (assign(level, 3),))) == "level := 3"
    assert left(If(~fault, (assign(level, 7),), (assign(level, 3),))) == "level := 7"
    assert left(If(fault, (assign(level, 7),)), assign(other, on)) == "other := on"


def test_a_branch_that_another_way_makes_possible_stays() -> None:
    step = If(fault, (assign(level, 7),), (assign(level, 3),)), assign(fault, on)
    assert left(*step) == "; ".join(map(str, step))
    assert left(*step, assume=~on) == "level := 3; fault := false"


def test_what_is_decided_of_a_condition_is_left_out_of_it() -> None:
    assert left(assign(other, all_of(~fault, on))) == "other := on"
    assert left(assign(other, any_of(fault, on))) == "other := on"
    assert left(assign(other, any_of(~fault, on))) == "other := true"
    assert left(assign(level, ite(fault & on, 7, ite(on, 4, 5)))) == "level := on ? 4 : 5"


def test_within_a_branch_its_condition_is_known() -> None:
    again = If(on, (If(on, (assign(level, 7),), (assign(level, 3),)),), (assign(level, 5),))
    assert left(again) == str(If(on, (assign(level, 7),), (assign(level, 5),)))


def test_a_choice_with_nothing_left_in_it_is_gone() -> None:
    assert left(If(on, (If(fault, (assign(level, 7),)),)), assign(other, FALSE)) == "other := false"


def test_where_no_tick_is_possible_all_stays() -> None:
    step = If(fault, (assign(level, 7),), (assign(level, 3),))
    assert left(step, assume=level > 7) == str(step)


def test_of_a_step_that_takes_too_long_nothing_is_said(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(known_values, "_EFFORT", 10)
    step = If(fault, (assign(level, 7),), (assign(level, 3),))
    assert left(step) == str(step)
    assert narrowed(toy(step)).values == {}
