"""An assumption that nothing meets is said, instead of proving everything."""

import pytest
from hypothesis import given

from rovercheck.checker.engines import AUTO, Limits
from rovercheck.checker.system import initial as starting
from rovercheck.checker.system.initial import has_initial_tick, require_initial_tick
from rovercheck.checker.verify.decide import Task, decide
from rovercheck.properties.forms import never
from rovercheck.spec_model.lang.action import assign
from rovercheck.spec_model.lang.chart import Block
from rovercheck.spec_model.lang.domain import integer
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.expr import FALSE, TRUE, Expr, flag, var
from rovercheck.spec_model.lang.system import TransitionSystem, in_order
from tests.naive import successors, vectors
from tests.strategies_ts import transition_systems

X, Y, COUNT = var("x", integer(0, 300)), var("y", integer(0, 300)), var("count", integer(0, 9), 5)


def system(assume: Expr) -> TransitionSystem:
    return TransitionSystem("toy", (X, Y), (), (COUNT,), (), (), assume)


@pytest.mark.parametrize("assume", [TRUE, (X == 301 - Y) & (Y > 299), (COUNT == 5) & (X < Y), X + Y == 600])
def test_some_first_tick_is_found(assume: Expr) -> None:
    assert has_initial_tick(system(assume)) is True


@pytest.mark.parametrize(
    "assume", [FALSE, (X < 5) & (X > 5), COUNT == 6, (COUNT < 9) & (X < 3) & (Y < 3) & (X + Y == 5)]
)
def test_that_there_is_none_is_found(assume: Expr) -> None:
    assert has_initial_tick(system(assume)) is False
    with pytest.raises(ModelError, match="allows no first tick"):
        require_initial_tick(system(assume))


def test_what_is_not_found_out_is_no_error(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(starting, "TRIED", 1000)
    assert has_initial_tick(system(X + Y == 601)) is None
    require_initial_tick(system(X + Y == 601))


@given(transition_systems())
def test_first_ticks_by_definition(drawn: TransitionSystem) -> None:
    ticks = (any(successors(drawn, {**drawn.init, **frozen})) for frozen in vectors(drawn.frozen))
    assert has_initial_tick(drawn) is any(ticks)


def test_nothing_is_proved_of_a_system_without_a_run() -> None:
    on, off = flag("on"), flag("off")
    empty = in_order("empty", Block("copy", [assign(off, on)]), assume=on & ~on)
    task = Task(empty, (never("P", "It is never off.", that=off, covers=["R"], on="empty"),))
    with pytest.raises(ModelError, match="allows no first tick"):
        list(decide(task, {"empty": empty}, AUTO, Limits()))
