"""A memory of a memory was renewed after the inner one, so that previous(previous(x)) was previous(x)."""

from rovercheck.properties.forms import Always, Property
from rovercheck.properties.reduce import reduce
from rovercheck.spec_model.lang.action import Assign
from rovercheck.spec_model.lang.evaluate import step
from rovercheck.spec_model.lang.expr import flag
from rovercheck.spec_model.lang.system import TransitionSystem
from rovercheck.spec_model.lang.words import previous

p, x = flag("p"), flag("x")
FREE = TransitionSystem("free", (p,), (), (x,), (), (Assign(x, p),))


def test_the_value_two_ticks_ago() -> None:
    question = reduce(FREE, [Property("TWO", "", Always(previous(previous(p))), ("B2-OBS-01",), "free")])
    at: dict[str, int] = {**question.system.init}
    seen = []
    for value in (1, 0, 1, 1, 0):
        at = step(question.system, at, {"p": value})
        seen.append(1 - at["TWO"])
    assert seen == [0, 0, 1, 0, 1]
