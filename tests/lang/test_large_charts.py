"""Charts of many states and transitions: lowered flat enough for any walk, and with the same meaning."""

import sys
from collections.abc import Sequence

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from rovercheck.checker.encode.paths import path_program
from rovercheck.checker.encode.symbolic import transition
from rovercheck.checker.engines import Limits, explicit, quiet
from rovercheck.checker.results.verdict import Reached
from rovercheck.checker.system.partition import partitions
from rovercheck.checker.system.slice import sliced
from rovercheck.properties.forms import Never, Property
from rovercheck.properties.reduce import reduce
from rovercheck.spec_model.lang.action import If, assign, send
from rovercheck.spec_model.lang.chart import Chart, Junction, State, to
from rovercheck.spec_model.lang.domain import integer
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.expr import flag, var
from rovercheck.spec_model.lang.lower import flow, lower
from rovercheck.spec_model.lang.system import System, in_order
from rovercheck.spec_model.lang.time import ticks
from rovercheck.spec_model.lang.wellformed import check_system
from rovercheck.spec_model.lang.words import after, minimum
from tests.profiles import examples
from tests.strategies import frozen_values, input_blocks, systems
from tests.test_lowering import compare

MANY = 1_500
go, number, seen = flag("go"), var("number", integer(0, MANY)), var("seen", integer(0, 9))


def ring(n: int) -> Chart:
    """States one after the other, each with a timer, and a hub with a transition to every one of them."""
    spokes = [to(f"S{i}", when=go & (number == i), then=[assign(seen, i % 10)]) for i in range(n)]
    states = [
        State(
            f"S{i}",
            entry=[assign(seen, minimum(seen + 1, 9))],
            transitions=[to("Hub", when=number == n), to(f"S{(i + 1) % n}", when=after(2 * ticks))],
        )
        for i in range(n)
    ]
    return Chart("Ring", [State("Hub", transitions=spokes), *states], default="Hub")


def depth(program: Sequence[object]) -> int:
    """How deeply conditionals are nested."""
    found, level = 0, list(program)
    while level := [s for s in level if isinstance(s, If)]:
        found, level = found + 1, [a for s in level for a in (*s.then, *s.otherwise)]
    return found


def test_a_step_is_nested_much_less_than_its_chart_has_states_and_transitions() -> None:
    for n in (150, MANY):
        assert depth(lower(in_order("ring", ring(n))).step) < 40


def test_what_reads_a_large_step_needs_no_deep_stack() -> None:
    assert sys.getrecursionlimit() <= 1_000  # what Python grants at first, less than there are states
    system = lower(in_order("ring", ring(MANY)))
    part = sliced(system, [v for v in system.variables if v.name == "seen"])
    cells = partitions(part)
    assert len(cells["number"].cells) == MANY + 1
    assert path_program(part, cells)
    assert set(transition(part).next) == {v.name for v in part.variables}


def test_the_location_of_a_level_is_one_variable() -> None:
    chart = ring(3)
    assert chart.location() is chart.location() is chart.locations[0]


def test_a_large_chart_steps_as_the_interpreter_does() -> None:
    n = 40
    moves = [(1, 7), (0, 0), (0, 0), (0, 0), (0, n), (1, 39), (0, 3), (0, 3), (1, n), (1, 0), (0, n), (0, 5)]
    system = in_order("ring", ring(n))
    compare(system, [{"go": go_now, "number": at} for go_now, at in moves])


tries = [
    to("J", when=number == 3, do=[assign(seen, 1)]),
    *(to(f"S{i}", when=number == i, do=[assign(seen, minimum(seen + 1, 9))]) for i in range(20)),
    to("S0", when=number > 25),
    *(to(f"S{i}", when=(number == i) | (number == i + 1)) for i in range(20, 25)),
]
BACKTRACKING = Chart(
    "Tries",
    [State("Hub", transitions=tries), *(State(f"S{i}", transitions=[to("Hub")]) for i in range(25))],
    junctions=[Junction("J", [to("S1", when=go)])],
    default="Hub",
)


@pytest.mark.parametrize("go_now", [0, 1])
def test_many_transitions_are_tried_in_order_also_after_one_that_completes_no_path(go_now: int) -> None:
    moves = [at for n in range(30) for at in (n, 0)]
    compare(in_order("tries", BACKTRACKING), [{"go": go_now, "number": at} for at in moves])


@settings(examples(150), suppress_health_check=list(HealthCheck))
@given(st.data())
def test_levels_that_are_halved_step_as_the_interpreter_does(data: st.DataObject) -> None:
    """The charts of the tests are small, so that here the smallest levels are halved."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(flow, "FEW", 1)
        system = data.draw(systems())
        compare(system, data.draw(input_blocks(system)), data.draw(frozen_values(system)))


def sends(n: int, hears: bool) -> System:
    """A region that sends an event from each of its states, and one that waits for it or not."""
    senders = [
        State(f"A{i}", transitions=[to(f"A{(i + 1) % n}", when=go, then=[send("e", "Two")])])
        for i in range(n)
    ]
    waiting = [
        State(f"B{i}", transitions=[to(f"B{(i + 1) % n}", on="e" if hears else "f")]) for i in range(n)
    ]
    two = [State("One", states=senders, default="A0"), State("Two", states=waiting, default="B0")]
    return in_order("sends", Chart("Sends", two, parallel=True))


def test_each_send_and_each_event_of_a_large_chart_is_looked_at() -> None:
    n = 300
    check_system(sends(n, hears=True))
    with pytest.raises(ModelError) as told:
        check_system(sends(n, hears=False))
    lines = str(told.value).splitlines()
    assert sum("waits for the event f, which is never sent" in line for line in lines) == n
    assert sum("no transition inside Two waits for the event e" in line for line in lines) == n


def test_long_names_of_nested_states_are_told_apart_in_compiled_code() -> None:
    """LLVM cuts names, and took two variables for one: no engine was asked any more."""
    lamp = flag("lamp")
    inner = State("x" * 60 + "24", entry=[assign(lamp, True)], transitions=[to("Off", when=go)])
    for level in range(23, -1, -1):
        inner = State("x" * 60 + str(level), states=[inner], default="x" * 60 + str(level + 1))
    off = State("Off", entry=[assign(lamp, False)], transitions=[to("x" * 60 + "0", when=~go)])
    system = in_order("deep", Chart("Deep", [off, inner], default="Off"))
    question = reduce(lower(system), [Property("P", "t", Never(lamp), ("R",), "deep")])
    [goal] = question.goals
    found = explicit.check(question.system, [goal.var], Limits(), quiet)[goal.var.name]
    assert isinstance(found, Reached) and len(found.run) == 2
