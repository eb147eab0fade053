"""Ticks that last unlike times: ``held`` is measured in ms, the timers of states count executed steps."""

from collections.abc import Sequence

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rovercheck.spec_model.lang.action import assign
from rovercheck.spec_model.lang.chart import Block, Chart, State, to
from rovercheck.spec_model.lang.domain import integer
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.evaluate import step
from rovercheck.spec_model.lang.expr import Temporal, flag, var
from rovercheck.spec_model.lang.interpret import Interpreter
from rovercheck.spec_model.lang.lower import lower
from rovercheck.spec_model.lang.system import System, in_order
from rovercheck.spec_model.lang.time import ms, ticks
from rovercheck.spec_model.lang.words import after, duration, held

a = flag("a")
passed = var("passed", integer(19, 21, "ms"), 20, "how long the tick lasted")


def waiting(word: Temporal) -> System:
    """A chart that goes from A to B when the word is true."""
    chart = Chart("C", [State("A", transitions=[to("B", when=word)]), State("B")], default="A")
    return in_order("waiting", chart, elapsed=passed)


def entered_b(word: Temporal, lengths: Sequence[int], true: Sequence[bool] = ()) -> int | None:
    """The tick in which B is entered, by the interpreter; the lowered system must do the same."""
    system = waiting(word)
    lowered, run = lower(system), Interpreter(system)
    at: dict[str, int] = dict(lowered.init)
    found = None
    for number, length in enumerate(lengths, 1):
        inputs = {"passed": length, "a": int(true[number - 1] if true else True)}
        inputs = {name: raw for name, raw in inputs.items() if name in system.inputs}
        run.step(inputs)
        at = {**step(lowered, at, inputs)}
        (place,) = (c.location(()) for c in system.charts)
        assert at[place.name] == run.valuation()[place.name]
        if found is None and place.domain.show(at[place.name]) == "B":
            found = number
    return found


@pytest.mark.parametrize("length, tick", [(19, 5), (20, 4), (21, 4)])
def test_held_is_true_as_soon_as_so_many_ms_have_passed(length: int, tick: int) -> None:
    assert entered_b(held(a, 60 * ms), [length] * 9) == tick


def test_held_counts_the_ms_from_the_first_true_tick_and_begins_again() -> None:
    true = [True, True, False, True, True, True, True, True]
    assert entered_b(held(a, 60 * ms), [20, 20, 20, 21, 19, 21, 20, 20], true) == 7


@pytest.mark.parametrize("word", [after(3 * ticks), after(60 * ms), held(a, 3 * ticks)])
@pytest.mark.parametrize("length", [19, 21])
def test_ticks_and_timers_of_states_are_counted(word: Temporal, length: int) -> None:
    assert entered_b(word, [length] * 9) == 4


def test_a_duration_counts_executed_steps() -> None:
    assert {entered_b(duration(a) > 60 * ms, [length] * 9) for length in (19, 20, 21)} == {5}


@given(st.lists(st.tuples(st.sampled_from([19, 20, 21]), st.booleans()), min_size=1, max_size=30))
def test_held_is_what_its_words_say(run: list[tuple[int, bool]]) -> None:
    lengths, true = [length for length, _ in run], [holds for _, holds in run]
    clock = [sum(lengths[: i + 1]) for i in range(len(run))]
    starts = [next(j for j in range(k, -1, -1) if j == 0 or not true[j - 1]) for k in range(len(run))]
    over = (k for k in range(1, len(run)) if true[k] and clock[k] - clock[starts[k]] >= 60)
    expected = next(over, None)
    assert entered_b(held(a, 60 * ms), lengths, true) == (None if expected is None else expected + 1)


@pytest.mark.parametrize("elapsed, said", [
    (var("passed", integer(0, 21, "ms")), "write whole milliseconds, at least 1"),
    (var("passed", integer(19, 21, "s")), "write whole milliseconds, at least 1"),
    (flag("passed"), "write whole milliseconds, at least 1"),
])  # fmt: skip
def test_a_length_of_ticks_that_is_none(elapsed, said) -> None:
    with pytest.raises(ModelError, match=said):
        lower(in_order("odd", Block("B", [assign(flag("b"), a)]), elapsed=elapsed))


def test_a_length_of_ticks_is_an_input() -> None:
    with pytest.raises(ModelError, match="is written by a component"):
        lower(in_order("odd", Block("B", [assign(passed, passed)]), elapsed=passed))
