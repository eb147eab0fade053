"""No engine that works on formulas overlooks a variable that leaves its domain, or hides why none does.

Formulas are simplified on the assumption that variables stay in their domains, and then speak of fewer.
"""

import pytest

from rovercheck.checker.certify.certificate import certificates
from rovercheck.checker.certify.check import check
from rovercheck.checker.certify.outcome import Accepted
from rovercheck.checker.encode.cone import as_written, folded, straying
from rovercheck.checker.encode.symbolic import transition
from rovercheck.checker.engines import Limits, engines, quiet
from rovercheck.checker.results.verdict import Answer, Open
from rovercheck.spec_model.lang.action import Assign
from rovercheck.spec_model.lang.domain import Bool, Domain, chosen, integer
from rovercheck.spec_model.lang.expr import Expr, Var, flag, ite, var
from rovercheck.spec_model.lang.system import TransitionSystem
from rovercheck.spec_model.lang.words import minimum
from tests.certifying import SOLVER
from tests.toys import GOAL

FORMULAS = ("bdd", "bmc", "kinduction", "pdr")
PROVERS = ("bdd", "kinduction", "pdr")


pytestmark = pytest.mark.usefixtures("engines_in_this_process")


def answer(name: str, system: TransitionSystem) -> Answer:
    return engines()[name].check(system, [GOAL], Limits(depth=20), quiet)[GOAL.name]


def followed() -> TransitionSystem:
    """An input follows ``y``, which leaves its domain in tick 6; the goal, true in tick 9, reads neither."""
    y, count, key = var("y", integer(0, 5)), var("count", integer(0, 9)), var("key", integer(0, 5))
    step = (Assign(y, ite(y < 7, y + 1, y)), Assign(count, minimum(count + 1, 9)), Assign(GOAL, count == 9))
    return TransitionSystem("followed", (key,), (), (y, count, GOAL), (), step, key == y)


@pytest.mark.parametrize("name", FORMULAS)
def test_a_variable_that_only_the_assumption_reads(name: str) -> None:
    """Beyond its domain no input follows it: what had no more runs was proved never to reach the goal."""
    assert isinstance(found := answer(name, followed()), Open)
    assert found.reason == "y may leave its domain in tick 6" and found.depth < 6


@pytest.mark.parametrize("name", FORMULAS)
def test_a_value_between_two_members(name: str) -> None:
    """The goal is true where the place is 15, which is no member: such a run has no meaning."""
    place = var("place", chosen([0, 10, 20]))
    step = (Assign(GOAL, place == 15), Assign(place, minimum(place + 5, 20)))
    found = answer(name, TransitionSystem("gaps", (), (), (place, GOAL), (), step))
    assert isinstance(found, Open) and "place may leave its domain" in found.reason


@pytest.mark.parametrize("name", FORMULAS)
def test_a_truth_value_that_may_only_be_false(name: str) -> None:
    """It has no order, so that it is not compared with the ends of its domain."""
    never, go = Var("never", Domain(Bool(), range(1)), 0), flag("go")
    step = (Assign(GOAL, never), Assign(never, go))
    found = answer(name, TransitionSystem("never", (go,), (), (never, GOAL), (), step))
    assert found == Open("never may leave its domain in tick 1", 0)


@pytest.mark.parametrize("name", PROVERS)
def test_a_proof_says_why_a_variable_stays_that_was_simplified_away(name: str) -> None:
    """``x`` stays because ``raised`` never changes; as long as it does, the goal depends on neither."""
    x, raised, go = var("x", integer(0, 5)), flag("raised"), flag("go")
    step = (Assign(GOAL, go & (x > 5)), Assign(x, ite(raised, x + 1, x)))
    system = TransitionSystem("still", (go,), (), (x, raised, GOAL), (), step)
    [made] = certificates(system, [GOAL], {GOAL.name: answer(name, system)}, name)
    assert isinstance(check(made, system, SOLVER), Accepted)


def test_a_deep_case_distinction_is_looked_through_once() -> None:
    """Cases that share their parts are few, and the ways to them are many."""
    keys = tuple(flag(f"key{i}") for i in range(60))
    place = var("place", chosen([0, 10, 20]))
    value: Expr = place
    other = ite(keys[0], 10, 20)
    for key in keys[1:]:
        value, other = ite(key, value, other), ite(key, other, value)
    step = (Assign(GOAL, place == 0), Assign(place, value))
    system = TransitionSystem("deep", keys, (), (place, GOAL), (), step)
    assert not straying(folded(transition(system)), as_written(system, [GOAL.name]))
