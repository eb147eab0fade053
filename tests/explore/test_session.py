"""What stands, what runs free, where a run stops, and the script that makes it again."""

import pytest

from rovercheck.checker.explore.by_hand import session
from rovercheck.checker.explore.by_hand.session import Session
from rovercheck.checker.explore.by_hand.value_syntax import RefusedInput
from rovercheck.spec_model.lang.action import assign
from rovercheck.spec_model.lang.chart import Block
from rovercheck.spec_model.lang.expr import flag
from rovercheck.spec_model.lang.system import Assumption, in_order
from tests.explore.test_simulation import system


def begun() -> Session:
    return Session(system())


def test_inputs_stand_until_they_are_set() -> None:
    one = begun()
    one.set([("level", "150")])
    one.advance(3)
    assert [one.simulation.given(t)["level"] for t in (1, 2, 3)] == [150] * 3


def test_an_input_against_an_assumption_is_not_taken() -> None:
    one = begun()
    one.set([("level", "150")])
    one.advance(2)
    with pytest.raises(RefusedInput, match=r"assumption CALM .* Set what belongs together"):
        one.set([("level", "250")])
    assert one.standing == {"level": 150}


def test_inputs_that_nobody_set_follow_the_assumptions() -> None:
    ping, pong = flag("ping"), flag("pong")
    turns = in_order(
        "turns",
        Block("B", [assign(pong, ping)]),
        assumptions=[Assumption("TURNS", "In turns.", ping != pong)],
    )
    one = Session(turns)
    one.advance(3)
    assert [one.simulation.given(t)["ping"] for t in (1, 2, 3)] == [1, 0, 1]
    one.set([("ping", "false")])
    one.advance(1)
    with pytest.raises(RefusedInput, match="In tick 5 these inputs are not possible: assumption TURNS"):
        one.advance(1)


def test_free_inputs_are_the_same_with_the_same_seed_and_others_with_another() -> None:
    def levels(seed: int) -> list[int]:
        one = begun()
        one.let_run(["level"], seed)
        one.advance(40)
        return [one.simulation.given(t)["level"] for t in range(1, 41)]

    assert levels(1) == levels(1) != levels(2)
    assert len(set(levels(1))) > 3


def test_until_stops_at_the_first_tick_and_says_when_it_does_not(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(session, "MOST_TICKS", 50)
    one = begun()
    one.set([("level", "150")])
    assert one.advance(50, one.condition("Tank.High")).last == 2
    ran = one.advance(50, one.condition("Tank.Low"))
    assert not ran.met and ran.last == 52
    assert one.advance(1_000).stopped == "stopped after 50 ticks"


def test_a_break_stops_where_it_becomes_true() -> None:
    one = begun()
    one.breaks.append(("count >= 3", one.condition("count >= 3")))
    first = one.advance(100)
    assert (first.last, first.stopped) == (3, "break: count >= 3")
    assert one.advance(5).last == 8, "it is still true, and does not stop again"


def test_after_going_back_inputs_stand_as_then() -> None:
    one = begun()
    one.set([("level", "150")])
    one.advance(2)
    one.set([("level", "3")])
    one.advance(1)
    one.goto(2)
    assert one.standing == {"level": 150}
    assert one.advance(1).forgotten == 1


def test_the_script_makes_the_run_again() -> None:
    one = begun()
    one.fix("top", "101")
    one.let_run(["level"], 5)
    one.advance(30)
    again = begun()
    for line in one.script().splitlines()[1:]:
        word, _, rest = line.partition(" ")
        name, _, written = rest.partition("=")
        if word == "fixed":
            again.fix(name, written)
        elif word == "set":
            again.set([(name, written)])
        else:
            again.advance(int(rest))
    ticks = range(31)
    assert [again.simulation.state(t) for t in ticks] == [one.simulation.state(t) for t in ticks]


def test_a_recorded_run_is_played() -> None:
    one, other = begun(), begun()
    one.let_run(["level"], 9)
    one.advance(10)
    trace = one.simulation.trace()
    other.play(trace.before, [tick.inputs for tick in trace.ticks])
    assert other.simulation.state() == one.simulation.state() and other.simulation.at == 10
