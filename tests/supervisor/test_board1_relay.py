"""The relay and the safety state of Board 1, arc by arc."""

from itertools import product

import pytest

from rovercheck.supervisor.board1.limits import LIMITS, Limits
from rovercheck.supervisor.board1.relay import Relay
from rovercheck.supervisor.board1.safety import Safety
from rovercheck.supervisor.types import Level, SafetyState

OK, DEGRADED, CRITICAL = Level.OK, Level.DEGRADED, Level.CRITICAL
SAFE, CARE, STOP = SafetyState.SAFETY_OK, SafetyState.SAFETY_DEGRADED, SafetyState.SAFETY_CRITICAL


def given_away():
    relay = Relay()
    relay.step(OK, OK)
    assert relay.step(CRITICAL, OK)
    return relay


def last(relay, steps, rx=OK, sup=OK):
    return [relay.step(rx, sup) for _ in range(steps)][-1]


@pytest.mark.parametrize("rx, sup", [*product(Level, Level)])
def test_the_first_step_keeps_actuation_and_the_next_decides(rx, sup):
    relay = Relay()
    assert not relay.step(rx, sup)
    assert relay.step(rx, sup) == (CRITICAL in (rx, sup))


@pytest.mark.parametrize("rx, sup", [*product((OK, DEGRADED), (OK, DEGRADED))])
def test_actuation_returns_after_more_than_three_seconds(rx, sup):
    assert last(given_away(), 150, rx, sup)
    assert last(given_away(), 151, rx, sup)
    assert not last(given_away(), 152, rx, sup)


def test_the_count_starts_at_the_end_of_the_first_sound_step():
    relay = given_away()  # the cause lasts until its end, so sound steps are j = 1, 2, ...
    outputs = [relay.step(OK, OK) for _ in range(152)]
    assert outputs == [True] * 151 + [False]


@pytest.mark.parametrize("rx, sup", [(CRITICAL, OK), (OK, CRITICAL), (CRITICAL, CRITICAL)])
def test_one_critical_step_restarts_the_count(rx, sup):
    relay = given_away()
    last(relay, 151)
    assert relay.step(rx, sup)
    assert last(relay, 151)
    assert not relay.step(OK, OK)


def test_actuation_is_given_again_at_once():
    relay = given_away()
    assert not last(relay, 152)
    assert relay.step(OK, CRITICAL)
    assert last(relay, 151)
    assert not relay.step(OK, OK)


def in_state(state):
    safety = Safety()
    safety.step(False, False)
    if state is not SAFE:
        safety.step(state is STOP, state is CARE)
    assert safety.state is state
    return safety


@pytest.mark.parametrize("critical, degraded", [*product((False, True), repeat=2)])
def test_the_first_step_is_safe(critical, degraded):
    assert Safety().step(critical, degraded) is SAFE


@pytest.mark.parametrize(
    "state, critical, degraded, following",
    [
        (SAFE, False, False, SAFE),
        (SAFE, False, True, CARE),
        (SAFE, True, False, STOP),
        (SAFE, True, True, STOP),
        (CARE, False, False, SAFE),
        (CARE, False, True, CARE),
        (CARE, True, False, SAFE),
        (CARE, True, True, STOP),
        (STOP, False, False, SAFE),
        (STOP, False, True, CARE),
        (STOP, True, False, STOP),
        (STOP, True, True, STOP),
    ],
)
def test_safety_arcs(state, critical, degraded, following):
    assert in_state(state).step(critical, degraded) is following


def test_limits():
    assert LIMITS == {
        SAFE: Limits(1.0, 1.0, 0.8, 0.4, -0.4),
        CARE: Limits(0.5, 0.5, 0.4, 0.2, -0.2),
        STOP: Limits(0.0, 0.0, 0.0, 0.0, 0.0),
    }
