"""What a verdict rests on, in words: the right noun for what is looked for, one tick and two ticks."""

import pytest

from rovercheck.checker.render.verdict_text import evidence, in_short, recorded
from rovercheck.checker.results.verdict import Unknown
from rovercheck.checker.verify.result import Result
from rovercheck.properties.expected import Expected
from rovercheck.properties.forms import Property, never, reachable
from rovercheck.spec_model.lang.expr import flag

THERE = flag("there")
REACHED = reachable("T-1", "It can be reached.", that=THERE, covers=["R"], on="toy")
AVOIDED = never("T-2", "It is never reached.", that=THERE, covers=["R"], on="toy")


@pytest.mark.parametrize(
    ("prop", "depth", "said"),
    [
        (REACHED, 1, "bmc on toy, no run to it within 1 tick: late"),
        (REACHED, 2, "bmc on toy, no run to it within 2 ticks: late"),
        (AVOIDED, 1, "bmc on toy, no counterexample within 1 tick: late"),
        (AVOIDED, 0, "bmc on toy, no counterexample within 0 ticks: late"),
    ],
)
def test_what_is_not_decided_says_what_was_looked_for(prop: Property, depth: int, said: str) -> None:
    assert evidence(Result(prop, Unknown("late", depth, "bmc"), "toy")) == said


def test_one_tick_is_no_plural() -> None:
    assert in_short(Result(REACHED, Unknown("late", 1, "bmc"), "toy")) == "after 1 tick of toy: late"
    assert recorded(Expected("violated", 1)) == "violated after 1 tick"
    assert recorded(Expected("violated", 8)) == "violated after 8 ticks"
