"""Mutants that do in every tick what the original does: what the one query says, against runs."""

import hypothesis.strategies as st
import pytest
from hypothesis import given

from rovercheck.checker.engines import Limits, quiet
from rovercheck.checker.mutate.fate import EQUAL_STEPS, OVERWRITTEN, Fate, MutantCase, judged
from rovercheck.checker.mutate.mutants import mutants
from rovercheck.checker.mutate.step_equality import equal_in_every_step
from rovercheck.checker.system.lowering_cache import lowered
from rovercheck.spec_model.lang.action import assign
from rovercheck.spec_model.lang.chart import Chart, State, to
from rovercheck.spec_model.lang.domain import integer
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.expr import flag, var
from rovercheck.spec_model.lang.interpret import Interpreter
from rovercheck.spec_model.lang.lower import lower
from rovercheck.spec_model.lang.system import in_order
from rovercheck.spec_model.lang.time import sec
from rovercheck.spec_model.lang.words import after
from tests.profiles import examples
from tests.strategies import frozen_values, input_blocks, systems

level = var("level", integer(0, 3))
patient = Chart(
    "Patient",
    [
        State("Low", transitions=[to("High", when=level > 2), to("Long", when=level < 1)]),
        State("High", transitions=[to("Low", when=after(3600 * sec))]),
        State("Long", transitions=[to("Low", when=after(3600 * sec))]),
    ],
    default="Low",
)
"""Two guards that exclude each other, and an hour to wait: a search counts 180,000 ticks."""


@given(st.data())
@examples(10)
def test_runs_do_not_tell_apart_what_is_equal_in_every_step(data: st.DataObject) -> None:
    system = data.draw(systems())
    frozen = data.draw(frozen_values(system))
    run = data.draw(input_blocks(system))
    for mutant in data.draw(st.lists(st.sampled_from(mutants(system)), min_size=5, max_size=5)):
        try:
            changed = lower(mutant.system)
        except ModelError:
            continue
        if equal_in_every_step(lower(system), changed):
            one, other = Interpreter(system, frozen), Interpreter(mutant.system, frozen)
            for inputs in run:
                one.step(inputs)
                other.step(inputs)
                assert one.data == other.data, mutant.id


def test_timers_cost_nothing() -> None:
    system = in_order("patient", patient)
    [swapped] = [m for m in mutants(system) if m.id == "Patient/arrow/Low.1/priority"]
    found = judged([MutantCase(system, swapped.system, swapped.parts, (), {})], Limits(), quiet)
    assert (found.fate, found.why) == (Fate.EQUIVALENT, EQUAL_STEPS)


@pytest.mark.parametrize("operator", ["limit-up", "guard-negated", "timer-up"])
def test_what_differs_in_some_step_is_not_equal(operator: str) -> None:
    system = in_order("patient", patient)
    wrong = [m for m in mutants(system) if m.operator == operator]
    assert wrong
    for mutant in wrong:
        assert not equal_in_every_step(lowered(system), lowered(mutant.system)), mutant.id


def test_what_the_first_tick_overwrites_may_begin_otherwise() -> None:
    """The entry of the default state assigns `shown`; `seen` keeps what it begins with until `level` is 3."""
    shown, seen = flag("shown"), flag("seen")
    dark = State("Dark", entry=[assign(shown, False)], transitions=[to("Lit", when=level > 2)])
    lit = State("Lit", entry=[assign(shown, True), assign(seen, True)])
    system = in_order("shown", Chart("Shown", [dark, lit], default="Dark"))
    wrong = [m for m in mutants(system) if m.operator == "initial"]
    found = {m.id: judged([MutantCase(system, m.system, m.parts, (), {})], Limits(), quiet) for m in wrong}
    assert {id: judged.fate for id, judged in found.items()} == {
        "Shown/data/shown/initial": Fate.EQUIVALENT,
        "Shown/data/seen/initial": Fate.SURVIVOR,
    }
    assert found["Shown/data/shown/initial"].why == OVERWRITTEN


def test_inputs_that_only_one_of_them_allows_are_a_difference() -> None:
    go = flag("go")
    one = in_order("held", patient, assume=go | (level > 0))
    other = in_order("held", patient, assume=level > 0)
    assert equal_in_every_step(lower(one), lower(one))
    assert not equal_in_every_step(lower(one), lower(other))
