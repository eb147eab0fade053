"""The obstacle chart with free timers stands for the counted one: every run as drawn is a run of it."""

from random import Random

import pytest

from rovercheck.spec_model.ambiguity import fixed
from rovercheck.spec_model.board2.obstacles import WINDOWS, obstacles_n
from rovercheck.spec_model.lang.evaluate import step
from rovercheck.spec_model.lang.expiry import free_timers
from rovercheck.spec_model.lang.lower import lower
from rovercheck.spec_model.lang.system import in_order

drawn = fixed({}).system(in_order("counted", obstacles_n()))
counted, free = lower(drawn), lower(free_timers(drawn))
TIMED = (*WINDOWS, "MoveToS2")

COUNTERS = {
    name: counter.name
    for name in TIMED
    for counter in counted.variables
    if counter.name.endswith(f"{name}.after") or counter.name.endswith(f"{name}.Fall1Detected.after")
}
"""The counter of each timed stay, increased at the start of a step."""


def _end(counter: str) -> str:
    """The free end that stands for a counter."""
    return counter.removesuffix("after") + "over1"


@pytest.mark.parametrize("seed", range(4))
def test_a_counted_run_is_a_run_with_free_ends(seed: int) -> None:
    """Each free end is given the value that after(...) has for a state that was active before the step."""
    random = Random(seed)
    one, other = dict(counted.init), dict(free.init)
    inputs = dict(d1=301, d2=301, d3=301, prevDEG_B1=0, turned_45=0)
    ended: set[str] = set()
    for _ in range(1500):
        if random.random() < 0.05:
            inputs[random.choice(["d1", "d2", "d3"])] = random.choice([70, 100, *3 * [200, 301]])
        inputs["turned_45"] = int(random.random() < 0.05)
        high = {name: counted.var(counter).domain.high for name, counter in COUNTERS.items()}
        over = {_end(counter): int(one[counter] + 1 >= high[name]) for name, counter in COUNTERS.items()}
        ended |= {name for name, value in over.items() if value}
        one, other = step(counted, one, inputs), step(free, other, {**inputs, **over})
        same = [v.name for v in free.variables if not v.name.endswith(".after")]
        assert {n: one[n] for n in same} == {n: other[n] for n in same}
    assert len(COUNTERS) == len(TIMED)
    assert ended
