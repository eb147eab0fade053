"""The engine ``simulation``: long runs that one would think of are found at once, and nothing is claimed."""

import pytest

from rovercheck.checker.engines import AUTO, Limits, quiet, simulation
from rovercheck.checker.results.trace import Trace
from rovercheck.checker.results.verdict import Open, Proved, Reached
from rovercheck.checker.verify.decide import Task, decide
from rovercheck.checker.verify.portfolio.order import ORDERS
from rovercheck.checker.verify.runs.domains import stray
from rovercheck.properties.forms import Property, Reachable
from rovercheck.spec_model.lang.action import Assign, assign
from rovercheck.spec_model.lang.chart import Block, Chart, State, to
from rovercheck.spec_model.lang.domain import integer
from rovercheck.spec_model.lang.expr import Expr, Var, all_of, flag, ite, var
from rovercheck.spec_model.lang.lower import lower
from rovercheck.spec_model.lang.system import System, TransitionSystem, in_order
from rovercheck.spec_model.lang.time import sec
from rovercheck.spec_model.lang.words import duration, minimum
from tests import naive
from tests.toys import GOAL, counter, overflowing

NOISE = [var(f"noise{n}", integer(0, 199)) for n in range(4)]


def patient(seconds: int = 20) -> System:
    """A lamp that is lit once a key was held for long, beside what anything may be in every tick."""
    key, fast = flag("key"), flag("fast")
    states = [
        State("Off", transitions=[to("On", when=duration(key) > seconds * sec)]),
        State("On", transitions=[to("Off", when=~key)]),
    ]
    kept = [var(f"kept{n}", v.domain) for n, v in enumerate(NOISE)]
    noise = Block("Noise", [assign(k, ite(fast, v, k)) for k, v in zip(kept, NOISE, strict=True)])
    return in_order("patient", Chart("Lamp", states, default="Off"), noise)


def reached(system: TransitionSystem, goal: Expr, depth: int | None = None) -> Reached | Open:
    step = (*system.step, Assign(GOAL, goal))
    made = TransitionSystem(
        system.name, system.inputs, system.frozen, (*system.variables, GOAL), system.temps, step,
        assume=system.assume, checks=system.checks,
    )  # fmt: skip
    found = simulation.check(made, [GOAL], Limits(depth=depth), quiet)[GOAL.name]
    assert isinstance(found, Reached | Open)
    if isinstance(found, Reached):
        assert naive.replay(made, found.run)[-1][GOAL.name]
    return found


@pytest.mark.parametrize("seconds", [20, 120])
def test_a_witness_of_a_thousand_ticks_is_found_by_holding_the_inputs(seconds: int) -> None:
    """A breadth-first search visited 68 million states on the way, in eleven minutes."""
    system = patient(seconds)
    lit = system.charts[0].active("On")
    noise = [v for v in system.written.values() if v.name.startswith("kept")]
    wanted = Property("P", "t", Reachable(all_of(lit, *(v == 0 for v in noise))), ("R",), system.name)
    [found] = decide(Task(system, (wanted,)), {system.name: system}, "simulation", Limits())
    assert isinstance(found.verdict, Proved) and isinstance(found.verdict.because, Trace)
    assert 1 <= len(found.verdict.because) - 50 * seconds < 100


BIG = Var("big", integer(0, 4_000_000_000), 3037000500)
PUSH = flag("push")


@pytest.mark.parametrize(
    ("condition", "ticks"),
    [(BIG * BIG < 5, None), (BIG * BIG * BIG > 10**20, 5), (BIG * BIG - BIG * BIG * BIG < 0, 5)],
    ids=["more than 64 bits", "a constant of more than 64 bits", "differences of such"],
)
def test_what_needs_more_than_64_bits_is_computed_as_the_reference_does(
    condition: Expr, ticks: int | None
) -> None:
    """Products that wrapped were told as runs that do not replay, and as engines that disagree."""
    count = var("count", integer(0, 7))
    step = (
        Assign(count, ite(condition, minimum(count + 1, 7), 0)),
        Assign(BIG, ite(PUSH, 3037000500, 3037000501)),
    )
    system = TransitionSystem("big", (PUSH,), (), (count, BIG), (), step)
    found = reached(system, count == 5)
    assert (len(found.run) if isinstance(found, Reached) else None) == ticks


def test_frozen_values_are_drawn_from_a_domain_of_any_size() -> None:
    given, count = var("given", integer(0, 4_000_000_000)), var("count", integer(0, 7))
    step = (Assign(count, ite(given > 1_000_000_000, minimum(count + 1, 7), 0)),)
    found = reached(TransitionSystem("given", (), (given,), (count,), (), step), count == 5)
    assert isinstance(found, Reached)


def test_it_has_a_turn_before_the_long_searches() -> None:
    for kind in ("narrow", "broad", "wide", "vast"):
        names = [turn.engine for turn in ORDERS[kind] if turn.seconds is None or turn.seconds > 60]
        proofs = [number for number, name in enumerate(names) if name in ("kinduction", "pdr")]
        assert proofs and names.index("simulation") < min(proofs)


def test_blocks_find_what_no_constant_input_does() -> None:
    """The goal wants the key to have been up for 30 ticks and then down for 30."""
    key, up, down = flag("key"), var("up", integer(0, 30)), var("down", integer(0, 30))
    step = (
        Assign(down, ite(key & (up == 30), minimum(down + 1, 30), 0)),
        Assign(up, ite(key, up, minimum(up + 1, 30))),
    )
    system = TransitionSystem("blocks", (key,), (), (up, down), (), step)
    assert isinstance(reached(system, down == 30), Reached)


def test_an_assumption_and_inputs_outside_the_cone_are_respected() -> None:
    a, b, other = flag("a"), flag("b"), flag("other")
    count = var("count", integer(0, 50))
    step = (Assign(count, ite(a, minimum(count + 1, 50), 0)),)
    system = TransitionSystem("assumed", (a, b, other), (), (count,), (), step, assume=all_of(a == b, other))
    found = reached(system, count == 50)
    assert isinstance(found, Reached)
    assert all(tick["a"] == tick["b"] and tick["other"] for tick in found.run.inputs)


def test_no_run_goes_on_after_a_domain_is_left() -> None:
    count, hold = var("x", integer(0, 3)), flag("hold")
    made = lower(in_order("leaves", Block("B", [assign(count, ite(hold, count + 1, count))])))
    [(check, _)] = made.checks
    found = simulation.check(made, [check], Limits(), quiet)[check.name]
    assert isinstance(found, Reached)
    assert (at := stray(made, found.run)) is not None and at.tick == len(found.run)
    assert isinstance(simulation.check(overflowing(5), [GOAL], Limits(), quiet)[GOAL.name], Open)


@pytest.mark.parametrize("depth", [3, 7])
def test_no_run_is_longer_than_it_may_be(depth: int) -> None:
    system = counter(8, top=9)
    assert isinstance(simulation.check(system, [GOAL], Limits(depth=depth), quiet)[GOAL.name], Open)


def test_what_cannot_be_reached_is_open_and_soon() -> None:
    """Nothing new appears: the batch ends long before its effort is spent."""
    left, right = var("left", integer(0, 3)), flag("right")
    step = (Assign(left, ite(right, minimum(left + 1, 2), 0)),)
    system = TransitionSystem("small", (right,), (), (left,), (), step)
    found = reached(system, left == 3)
    assert isinstance(found, Open) and found.depth == 0 and "none of 256 runs" in found.reason


def test_the_same_question_has_the_same_answer() -> None:
    system = lower(patient())
    goal = next(v for v in system.variables if v.name == "kept0")
    assert reached(system, goal == 7) == reached(system, goal == 7)


def test_auto_is_not_content_with_a_long_run_where_a_short_one_is_soon_found() -> None:
    system = in_order("counter", Block("B", [assign(v := var("n", integer(0, 200)), minimum(v + 1, 200))]))
    wanted = Property("P", "t", Reachable(v == 150), ("R",), system.name)
    [found] = decide(Task(system, (wanted,)), {system.name: system}, AUTO, Limits())
    assert isinstance(found.verdict, Proved) and isinstance(found.verdict.because, Trace)
    assert len(found.verdict.because) == 150
