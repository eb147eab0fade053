"""The possible next steps are those that trying all inputs finds; the interpreter takes each as it says."""

from collections.abc import Mapping
from itertools import product
from math import prod

import pytest
from hypothesis import assume, given

from rovercheck.checker.explore.by_hand import next_steps
from rovercheck.checker.explore.by_hand.next_steps import NextSteps, StepFinder, innermost
from rovercheck.checker.explore.by_hand.session import Session
from rovercheck.checker.explore.by_hand.value_syntax import RefusedInput
from rovercheck.checker.system.instrument.goals import GoalKind
from rovercheck.checker.system.instrument.watch import watched
from rovercheck.spec_model.lang.action import assign
from rovercheck.spec_model.lang.chart import Block
from rovercheck.spec_model.lang.domain import integer
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.evaluate import admissible, step
from rovercheck.spec_model.lang.expr import flag, var
from rovercheck.spec_model.lang.lower import lower
from rovercheck.spec_model.lang.system import Assumption, System, in_order
from rovercheck.spec_model.rover import systems
from tests.explore.test_simulation import system
from tests.profiles import examples
from tests.strategies import input_blocks
from tests.strategies import systems as random_systems

MOST = 300
"""Combinations of inputs that are tried in a state."""


def tried(of: System, at: Mapping[str, int]) -> set[tuple[str, str]]:
    """Every reaction of every chart that can react in several ways, by trying every input."""
    seen = watched(of, (GoalKind.TRANSITIONS,))
    lowered = lower(seen.system)
    before = {**{v.name: v.init for v in (*lowered.variables, *lowered.frozen)}, **at}
    found: dict[str, set[str]] = {}
    for values in product(*(v.domain.values for v in lowered.inputs)):
        inputs = dict(zip([v.name for v in lowered.inputs], values, strict=True))
        if admissible(lowered, before, inputs):
            after = step(lowered, before, inputs)
            if any(after[check.name] for check, _ in lowered.checks):
                continue
            for chart in of.charts:
                own = [g for g in seen.goals if g.part == chart.name and after[g.flag.name]]
                numbers = sorted(int(g.id.rpartition(".")[2]) for g in own)
                found.setdefault(chart.name, set()).add(",".join(map(str, numbers)))
    return {(chart, way) for chart, ways in found.items() if len(ways) > 1 for way in ways}


def listed(steps: NextSteps) -> list[tuple[str, str]]:
    return [(s.of, s.key.partition(":")[2]) for s in steps.steps]


system_and_inputs = random_systems().flatmap(lambda s: input_blocks(s, 3, 8).map(lambda i: (s, i)))


@given(system_and_inputs)
@examples(60)
def test_the_reactions_are_those_that_trying_finds(drawn: tuple[System, list[dict[str, int]]]) -> None:
    of, blocks = drawn
    assume(of.charts and prod(len(v.domain) for v in of.inputs.values()) <= MOST)
    session = Session(of)
    for inputs in blocks:
        if session.simulation.at:
            steps = session.next_steps()
            ways = listed(steps)
            assert len(ways) == len(set(ways)), "each once"
            several = {way for way in ways if sum(of == way[0] for of, _ in ways) > 1}
            assert several == tried(of, session.simulation.state())
        try:
            session.follow({}, [inputs])
        except (ModelError, RefusedInput):
            return


@given(system_and_inputs)
@examples(60)
def test_the_interpreter_takes_each_step_as_listed(drawn: tuple[System, list[dict[str, int]]]) -> None:
    of, blocks = drawn
    session = Session(of)
    for inputs in blocks:
        at = session.simulation.at
        for one in session.next_steps().steps:
            session.goto(at)
            session.take(one)  # raises where the interpreter does otherwise
            if one.becomes is None:
                chart = next(c for c in of.charts if c.name == one.of)
                now = tuple(".".join(p) for p in innermost(chart, session.simulation.state()))
                assert now == one.states
        session.goto(at)
        try:
            session.follow({}, [inputs])
        except (ModelError, RefusedInput):
            return


def test_before_the_first_tick_a_step_may_choose_frozen_values() -> None:
    session = Session(system())
    top, high = var("top", integer(0, 9)), flag("high")
    session = Session(in_order("plain", Block("B", [assign(high, top > 5)]), frozen=[top]))
    assert {s.title for s in session.next_steps().steps} == {"high = false", "high = true"}
    [rise] = [s for s in session.next_steps().steps if s.moves]
    assert rise.changed == ("top",) and rise.frozen["top"] > 5
    session.take(rise)
    assert session.next_steps().steps == (), "from now on it is chosen"


def test_the_inputs_that_a_step_changes_are_few_and_named() -> None:
    session = Session(system())
    session.advance(1)
    [rise] = [s for s in session.next_steps().steps if s.moves]
    assert rise.title == "Tank: Low → High" and rise.changed == ("level",) and rise.inputs == {"level": 300}
    [stay] = [s for s in session.next_steps().steps if not s.moves]
    assert stay.standing and stay.changed == () and stay.title == "Tank: no transition"


def test_two_reactions_happen_in_one_tick_or_it_is_said_that_they_cannot() -> None:
    session = Session(systems()["relay_links"])
    session.advance(1)
    named = {s.title: s for s in session.next_steps().steps}
    slow, late = named["Monitor_heartbeat: Sup_OK → Sup_DEG"], named["Monitor_reception: Rx_OK → Rx_DEG"]
    both = session.both([slow, late])
    session.take(both, [slow, late])
    assert session.holds(session.condition("Monitor_heartbeat.Sup_DEG and Monitor_reception.Rx_DEG"))
    session.goto(1)
    with pytest.raises(RefusedInput, match=r"No inputs lead to .* Sup_DEG and .* Sup_OK in one tick"):
        session.both([slow, named["Monitor_heartbeat: Sup_OK → Sup_OK"]])


def test_of_a_system_without_charts_the_values_are_listed() -> None:
    level, high = var("level", integer(0, 9)), flag("high")
    session = Session(in_order("plain", Block("B", [assign(high, level > 5)])))
    assert {s.title for s in session.next_steps().steps} == {"high = false", "high = true"}
    session.take(next(s for s in session.next_steps().steps if s.moves))
    assert session.simulation.state()["high"] == 1


def test_more_possibilities_than_are_listed_are_not_concealed(monkeypatch: pytest.MonkeyPatch) -> None:
    level, double = var("level", integer(0, 9)), var("double", integer(0, 18))
    session = Session(in_order("plain", Block("B", [assign(double, level + level)])))
    monkeypatch.setattr(next_steps, "MOST", 4)
    steps = session.next_steps()
    assert len(steps.steps) == 4
    assert steps.bounded == ("Of double the first 4 possibilities are listed; there are more.",)


def test_where_no_inputs_are_admissible_it_is_said() -> None:
    ping = flag("ping")
    never = Assumption("NEVER", "Both.", ping & ~ping)
    session = Session(in_order("stuck", Block("B", [assign(flag("pong"), ping)]), assumptions=[never]))
    [problem] = session.next_steps().problems
    assert problem.startswith("No inputs are admissible in this tick") and not session.next_steps().steps


def test_inputs_that_lead_out_of_a_domain_are_left_out_and_named() -> None:
    add, total = var("add", integer(0, 3)), var("total", integer(0, 2))
    session = Session(in_order("sum", Block("B", [assign(total, total + add)])))
    steps = session.next_steps()
    assert {s.title for s in steps.steps} == {"total = 0", "total = 1", "total = 2"}
    assert len(steps.problems) == 1 and "the model has no meaning for them" in steps.problems[0]


def test_the_whole_rover_lists_what_every_chart_can_do() -> None:
    of = systems()["rover"]
    steps = StepFinder(of).find(Session(of).simulation.before, Session(of).standing, first=True)
    assert len({s.of for s in steps.steps}) >= 16
    assert not steps.bounded and not steps.problems
