"""A run made by hand: exact in both directions, a new branch after going back, and nothing inadmissible."""

from collections.abc import Mapping
from random import Random
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rovercheck.checker.explore.by_hand import simulation
from rovercheck.checker.explore.by_hand.admissible_inputs import broken, drawn
from rovercheck.checker.explore.by_hand.simulation import HandSimulation
from rovercheck.checker.explore.by_hand.value_syntax import RefusedInput, value
from rovercheck.checker.verify.runs.replay import ReplayError
from rovercheck.spec_model.lang.action import assign
from rovercheck.spec_model.lang.chart import Block, Chart, State, to
from rovercheck.spec_model.lang.domain import chosen, enumeration, fixed, integer
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.evaluate import admissible, step
from rovercheck.spec_model.lang.expr import flag, var
from rovercheck.spec_model.lang.system import Assumption, System, in_order
from rovercheck.spec_model.lang.time import ms
from rovercheck.spec_model.lang.words import duration, minimum

level = var("level", integer(0, 300))
pump = flag("pump")
count = var("count", integer(0, 5))
top = var("top", integer(100, 102), 100)

tank = Chart(
    "Tank",
    [
        State("Low", entry=[assign(pump, True)], transitions=[to("High", when=(level >= top) & pump)]),
        State("High", entry=[assign(pump, False)], transitions=[
            to("Low", when=duration(level < 5) > 60 * ms),
        ]),
    ],
    default="Low",
)  # fmt: skip
counting = Block("Counting", [assign(count, minimum(count + 1, 5))])
CALM = Assumption("CALM", "The level does not jump while the pump is off.", pump | (level < 200))


def system() -> System:
    return in_order("tank", tank, counting, frozen=[top], assumptions=[CALM])


def ran(*levels: int) -> HandSimulation:
    sim = HandSimulation(system())
    for one in levels:
        sim.step({"level": one})
    return sim


def test_a_tick_is_the_one_of_the_lowered_system() -> None:
    sim = ran(0, 150, 3)
    at: Mapping[str, int] = sim.before
    for number, one in enumerate((0, 150, 3), start=1):
        at = {n: v for n, v in step(sim.lowered, at, {"level": one}).items() if n != "level"}
        assert sim.state(number) == at


@given(st.lists(st.integers(0, 199), min_size=1, max_size=8), st.data())
def test_back_and_on_again_is_the_same_run_as_without(levels: list[int], data: Any) -> None:
    sim = ran(*levels)
    cut = data.draw(st.integers(0, len(levels)))
    sim.goto(cut)
    for one in levels[cut:]:
        sim.step({"level": one})
    assert [sim.state(t) for t in range(len(sim) + 1)] == [ran(*levels).state(t) for t in range(len(sim) + 1)]


def test_a_new_input_after_back_begins_a_new_branch() -> None:
    sim = ran(0, 150, 150, 150)
    sim.goto(1)
    assert sim.given(sim.at + 1) == {"level": 150}
    sim.step({"level": 7})
    assert len(sim) == 2 and sim.given() == {"level": 7}
    assert sim.state()["Tank"] == sim.variables["Tank"].domain.raw("Low")


def test_frozen_values_are_chosen_before_the_first_tick() -> None:
    sim = ran(0, 100)
    with pytest.raises(RefusedInput, match="before the first tick; write goto 0"):
        sim.fix("top", 101)
    sim.goto(0)
    sim.fix("top", 101)
    assert len(sim) == 0
    sim.step({"level": 0})
    sim.step({"level": 100})
    assert sim.state()["Tank"] == sim.variables["Tank"].domain.raw("Low")


def test_what_an_assumption_forbids_is_refused_with_its_name() -> None:
    sim = ran(0, 150)
    with pytest.raises(RefusedInput, match=r"In tick 3 .*assumption CALM \(The level does not jump"):
        sim.step({"level": 250})
    assert sim.at == 2


def test_there_is_no_tick_that_was_not_executed() -> None:
    with pytest.raises(RefusedInput, match="There is no tick 4; the run has 2"):
        ran(0, 1).goto(4)


def test_a_disagreement_of_the_two_readings_is_our_bug(monkeypatch: pytest.MonkeyPatch) -> None:
    sim = ran(0)
    monkeypatch.setattr(simulation, "step", lambda *a: {**step(*a), "pump": 0})
    with pytest.raises(ReplayError, match="tick 2: pump is 1 in the interpreter and 0 when lowered"):
        sim.step({"level": 0})


def test_after_a_value_left_its_domain_the_run_goes_on_from_before() -> None:
    small = var("small", integer(0, 2))
    sim = HandSimulation(in_order("narrow", Block("B", [assign(small, var("push", integer(0, 5)) * 1)])))
    sim.step({"push": 2})
    with pytest.raises(ModelError, match="leaves its domain"):
        sim.step({"push": 5})
    sim.step({"push": 1})
    assert sim.state()["small"] == 1 and len(sim) == 2


def test_tested_tells_what_was_true_when_the_transition_was_tested() -> None:
    sim = ran(0, 150)
    [one] = sim.tested()
    assert one.source == ("Low",) and one.valid
    assert [(str(part), true) for part, true in one.conjuncts] == [("level >= top", True), ("pump", True)]
    assert sim.state()["pump"] == 0, "which is false afterwards"


def test_tested_knows_temporal_words() -> None:
    sim = ran(0, 150, 3, 3, 3, 3)
    [waiting] = sim.tested()
    assert [true for _, true in waiting.conjuncts] == [False]
    sim.step({"level": 3})
    assert [true for _, true in sim.tested()[0].conjuncts] == [True]
    assert sim.tested()[0].valid


def test_the_trace_holds_the_run_up_to_the_tick_looked_at() -> None:
    sim = ran(0, 150, 3)
    sim.goto(2)
    trace = sim.trace()
    assert [dict(t.inputs) for t in trace.ticks] == [{"level": 0}, {"level": 150}]
    assert [str(a) for a in trace.ticks[1].transitions] == [
        "Tank: Low -> High (transition 1) [level >= top && pump]"
    ]
    assert [t.number for t in sim.trace(2).ticks] == [2]


@given(st.integers(0, 10_000))
def test_inputs_drawn_are_admissible_and_what_stands_is_kept(seed: int) -> None:
    a, b = var("a", integer(0, 1000)), var("b", chosen([0, 20, 700]))
    keep = flag("keep")
    narrow = in_order(
        "narrow",
        Block("B", [assign(flag("out"), keep)]),
        assume=(a == 417) & (b > 5),
        assumptions=[Assumption("X", "b is as keep says.", keep | (b == 700))],
    )
    sim = HandSimulation(narrow)
    inputs = {n: v.init for n, v in sim.inputs.items()}
    found = drawn(sim.lowered, sim.before, inputs, {"a", "b"}, Random(seed))
    assert found is not None and admissible(sim.lowered, sim.before, found)
    assert found["keep"] == 0 and found["a"] == 417


def test_where_nothing_free_can_help_none_is_drawn() -> None:
    sim = ran(0, 150)
    assert broken(sim.lowered, sim.state(), {"level": 250})[0].id == "CALM"
    assert drawn(sim.lowered, sim.state(), {"level": 250}, set(), Random(0)) is None


mode = var("mode", enumeration("Mode", ["OFF", "ON"]))
speed = var("speed", fixed(-1, 1, 0.1, "m/s"))


@pytest.mark.parametrize(
    ("of", "written", "raw"),
    [
        (mode, "ON", 1),
        (mode, "1", 1),
        (speed, "-0.3", -3),
        (pump, "True", 1),
        (pump, "0", 0),
        (level, "300", 300),
    ],
)
def test_values_are_read_as_people_write_them(of: Any, written: str, raw: int) -> None:
    assert value(of, written) == raw


@pytest.mark.parametrize(
    ("of", "written", "said"),
    [
        (mode, "ONN", "Did you mean 'ON'"),
        (mode, "7", "outside"),
        (speed, "0.33", "outside"),
        (speed, "fast", "no number"),
        (speed, "1/0", "no number"),
        (pump, "maybe", "write true or false"),
        (level, "301", "outside"),
    ],
)
def test_other_values_are_refused_with_what_there_is(of: Any, written: str, said: str) -> None:
    with pytest.raises(RefusedInput, match=said):
        value(of, written)
