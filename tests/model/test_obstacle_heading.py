"""The free predicate turned_45 stands for the measured heading: every measured run is a run of it."""

from random import Random

import pytest

from rovercheck.spec_model.ambiguity import fixed
from rovercheck.spec_model.board2.heading import angleCalculator, headings, measured
from rovercheck.spec_model.board2.obstacles import obstacles_n
from rovercheck.spec_model.lang.evaluate import evaluate
from rovercheck.spec_model.lang.interpret import Interpreter
from rovercheck.spec_model.lang.system import in_order
from rovercheck.spec_model.signals.board2 import B2Decision

yaw, target = headings(15)
as_read = fixed({})
heading = measured(yaw, target)
turned = as_read.expr(heading.turned)
half_right = as_read.expr(angleCalculator(yaw, B2Decision))
exact = as_read.system(in_order("measured", obstacles_n(heading)))
free = as_read.system(in_order("free", obstacles_n()))


@pytest.mark.parametrize("seed", range(5))
def test_a_measured_run_is_a_run_with_the_free_predicate(seed: int) -> None:
    """turned_45 is given the value that the test has for the heading of the step and the stored target."""
    random = Random(seed)
    one, other = Interpreter(exact), Interpreter(free)
    decisions = set()
    distances = dict.fromkeys(("d1", "d2", "d3"), 301)
    heading_now = 0
    for _ in range(1500):
        if random.random() < 0.5:
            distances[random.choice(["d1", "d2", "d3"])] = random.choice(
                [70, 100, 200, 200, 200, 301, 301, 301]
            )
        heading_now = random.choice([heading_now, random.choice(list(yaw.domain.values))])
        prevDEG = int(random.random() < 0.01)
        before = one.valuation()
        is_turned = evaluate(turned, {**before, "yaw": heading_now})
        one.step({**distances, "prevDEG_B1": prevDEG, "yaw": heading_now})
        other.step({**distances, "prevDEG_B1": prevDEG, "turned_45": is_turned})
        assert one.valuation()["B2Decision"] == other.valuation()["B2Decision"]
        decisions.add(one.valuation()["B2Decision"])
    assert decisions == {0, 1, 2, 3, 4}


@pytest.mark.parametrize("at", target.domain.values)
@pytest.mark.parametrize("decision", [2, 4])
def test_for_every_target_the_test_can_come_out_either_way(decision: int, at: int) -> None:
    outcomes = {
        evaluate(turned, {"B2Decision": decision, "targetAngle": at, "yaw": now}) for now in yaw.domain.values
    }
    assert outcomes == {0, 1}


@pytest.mark.parametrize("now", yaw.domain.values)
@pytest.mark.parametrize("decision", [2, 4])
def test_in_the_step_of_entry_the_test_is_false(decision: int, now: int) -> None:
    at = {"B2Decision": decision, "yaw": now}
    at["targetAngle"] = evaluate(half_right, at)
    assert evaluate(turned, at) == 0
