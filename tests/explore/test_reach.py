"""A run to a condition from where a session stands: found, shown not to exist, or left open with a reason."""

from contextlib import closing

import pytest

from rovercheck.checker.engines import Limits
from rovercheck.checker.explore.by_hand.session import Session
from rovercheck.checker.explore.reach import NeverReached, NotDecided, ReachAnswer, RunFound, reach
from rovercheck.spec_model.lang.action import assign
from rovercheck.spec_model.lang.chart import Block
from rovercheck.spec_model.lang.domain import integer
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.expr import flag, var
from rovercheck.spec_model.lang.system import in_order
from rovercheck.spec_model.rover import systems
from tests.explore.test_simulation import system


def answered(session: Session, written: str, limits: Limits | None = None) -> ReachAnswer:
    sim = session.simulation
    formula = session.condition(written)
    found = list(reach(sim.system, sim.state(), formula, limits or Limits(), first=not sim.at))
    assert isinstance(found[-1], ReachAnswer)
    return found[-1]


def test_a_run_begins_where_the_session_stands_and_is_a_shortest_one() -> None:
    session = Session(systems()["relay"])
    session.set([("rx_status", "RX_CRITICAL")])
    session.advance(3)
    assert session.holds(session.condition("Relay.B2_actuating"))
    found = answered(session, "Relay.B1_actuating")
    assert isinstance(found, RunFound) and found.shortest
    session.follow(found.run.frozen, found.run.inputs)
    assert session.holds(session.condition("Relay.B1_actuating"))
    assert session.simulation.at == 3 + len(found.run) == 155, "more than 3 s without a critical link"


def test_that_there_is_none_from_here_is_shown() -> None:
    count = var("count", integer(0, 5))
    up = flag("up")
    session = Session(in_order("up", Block("B", [assign(count, count + 1)]), assume=up & (count < 5)))
    assert isinstance(answered(session, "count == 1"), RunFound)
    session.set([("up", "true")])
    session.advance(2)
    none = answered(session, "count == 1")
    assert isinstance(none, NeverReached) and none.how


def test_frozen_values_are_chosen_before_the_first_tick_and_stay_afterwards() -> None:
    session = Session(system())
    found = answered(session, "top == 102 and Tank.High")
    assert isinstance(found, RunFound) and found.run.frozen["top"] == 102
    session.advance(1)
    assert isinstance(answered(session, "top == 102"), NeverReached)


def test_the_time_is_kept_and_said() -> None:
    answer = answered(Session(systems()["rover"]), "Relay.B2_actuating", Limits(seconds=0.01))
    assert isinstance(answer, NotDecided) and "time" in answer.reason


def test_a_search_ends_when_nobody_listens_any_more() -> None:
    sim = (session := Session(systems()["rover"])).simulation
    search = reach(sim.system, sim.state(), session.condition("Relay.B2_actuating"), Limits(), first=True)
    with closing(search):
        while next(search) is None:
            pass  # the process has not begun yet
    assert list(search) == []


def test_a_model_that_leaves_a_domain_is_no_answer() -> None:
    add, total = var("add", integer(0, 3)), var("total", integer(0, 2))
    session = Session(in_order("sum", Block("B", [assign(total, total + add)])))
    with pytest.raises(ModelError, match="outside integer in 0"):
        answered(session, "total == 1 and add == 3")
