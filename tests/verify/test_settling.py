"""Loops far too long for an unrolling are found by letting inputs settle, and none where there is none."""

from rovercheck.checker.encode.bits import circuit
from rovercheck.checker.encode.bits.simulate import BitSimulation
from rovercheck.checker.engines import quiet
from rovercheck.checker.verify.liveness.loops import LoopQuery, loop_query, looped
from rovercheck.checker.verify.liveness.repetition import repeating_loop
from rovercheck.properties.forms import settles
from rovercheck.properties.reduce import reduce
from rovercheck.spec_model.lang.action import assign
from rovercheck.spec_model.lang.chart import Block
from rovercheck.spec_model.lang.domain import integer
from rovercheck.spec_model.lang.expr import Expr, flag, ite, var
from rovercheck.spec_model.lang.lower import lower
from rovercheck.spec_model.lang.system import in_order

DAYS = 365
day, rain, wet, locked = var("day", integer(0, DAYS - 1)), flag("rain"), flag("wet"), flag("locked")
pressed = flag("pressed")

calendar = in_order(
    "calendar",
    Block(
        "Calendar",
        [
            assign(day, ite(day == DAYS - 1, 0, day + 1)),
            assign(locked, locked | (rain & pressed)),
            assign(wet, rain | (locked & wet)),
        ],
    ),
)
"""A year that goes round; once locked, what is wet stays wet."""


def loop_of(then: Expr) -> LoopQuery:
    prop = settles("DRY", "It dries.", premise=~rain & (day >= 0), then=then, covers=["X"], on="calendar")
    question = reduce(lower(calendar), [prop])
    return loop_query(question, question.goals[0])


def test_a_loop_of_a_year_is_found_and_replays() -> None:
    found = repeating_loop(loop_of(~wet), quiet, runs=64)
    assert found is not None and not found.shortest
    trace = looped(loop_of(~wet), found.run)
    assert trace.loop is not None and len(trace) - trace.loop == DAYS


def test_the_same_question_has_the_same_answer() -> None:
    assert repeating_loop(loop_of(~wet), quiet, runs=64) == repeating_loop(loop_of(~wet), quiet, runs=64)


def test_nothing_is_found_where_there_is_no_loop() -> None:
    assert repeating_loop(loop_of(~wet | locked), quiet, runs=32) is None


def test_runs_of_a_simulation_are_independent() -> None:
    system = lower(calendar)
    simulation = BitSimulation(circuit(system, ["wet"]), 4)
    assert simulation.given({"rain": [0, 1, 0, 1], "pressed": [0, 0, 1, 1]}) == 0b1111
    assert simulation.value(simulation.circuit.goals["wet"]) == 0b1010
    simulation.advance()
    simulation.given({"rain": [0, 0, 0, 0], "pressed": [0, 0, 0, 0]})
    assert simulation.value(simulation.circuit.goals["wet"]) == 0b1000
